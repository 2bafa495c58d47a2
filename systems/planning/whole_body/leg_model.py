"""A leg for planning: closed-form inverse kinematics and its outline L_1 to L_7.

The obstacle paper (Fig. 1) models the leg below the knee by line segments that connect
the points L_i. Here they come from the robot's own meshes, and its lengths from its
own joints. In the frame of the shank K (at the knee) and of the foot A (at the ankle)
x points forward and z up.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from scipy.spatial import ConvexHull

from footfall.models.robots.robot import RobotModel, Sole
from footfall.models.robots.robot_errors import RobotError
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector

_AXES = np.array(
    [[0, 1, 0], [1, 0, 0], [0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 1, 0]], dtype=float
)
_NAMES = ("hip pitch", "hip roll", "hip yaw", "knee", "ankle roll", "ankle pitch")


@dataclass(frozen=True, eq=False)
class LegOutline:
    """The points L_1 to L_7 about a leg below the knee, in the sagittal plane."""

    foot: Vector
    """L_1 heel, L_2 toe, L_3 top of the toes, L_7 top of the heel, in A, (4, 2), m."""
    shank: Vector
    """L_4 front of the ankle, L_5 front of the shin, the knee cap, L_6 back of the
    calf, in K, (4, 2), m. The paper's outline has no cap; on this robot it is what
    comes nearest to an obstacle when the leg is folded."""

    @property
    def toe(self) -> float:
        """How far the foot reaches ahead of the ankle, m."""
        return float(self.foot[:, 0].max())

    @property
    def heel(self) -> float:
        """How far the foot reaches behind the ankle, m, positive."""
        return float(-self.foot[:, 0].min())


@dataclass(frozen=True, eq=False)
class LegModel:
    """Both legs of one robot; they mirror each other."""

    hips: Mapping[Foot, Vector]
    """Hip in the pelvis' frame, (3,), m."""
    thigh: Vector
    """Knee from the hip with straight joints, (x, z), m."""
    shank: Vector
    """Ankle from the knee, (x, z), m."""
    lower: Vector
    """Joint limits within which is planned, hip to ankle, (2, 6), left first, rad."""
    upper: Vector
    """(2, 6), rad."""
    sole: Sole
    outline: LegOutline

    @property
    def reach(self) -> float:
        """Hip to ankle with the knee as straight as it may be, m."""
        return self.hip_to_ankle(float(self.lower[:, 3].max()))

    def hip_to_ankle(self, knee: float) -> float:
        """Distance at a knee angle, m."""
        return float(np.linalg.norm(self.thigh + _turned(self.shank, knee)))


class LegAngles(NamedTuple):
    """Joint angles of one leg and what of them could not be had."""

    angles: Vector
    """Hip pitch, roll, yaw, knee, ankle roll, pitch, (n, 6), rad."""
    short: Vector
    """How far the ankle is out of the leg's reach, (n,), m; 0 where it is within."""


def leg_outline(foot: Vector, shank: Vector) -> LegOutline:
    """L_1 to L_7 from the meshes of a foot and a shank.

    Args:
        foot: vertices in the frame of the foot's body, at the ankle, (n, 3), m.
        shank: vertices in the frame of the shank's body, at the knee, (m, 3), m.
    """
    hull = foot[:, [0, 2]][ConvexHull(foot[:, [0, 2]]).vertices]
    bottom, back, front = hull[:, 1].min(), hull[:, 0].min(), hull[:, 0].max()
    toes = hull[np.argmax(hull @ [1.0, 1.0]), 1]
    heel = hull[np.argmax(hull @ [-1.0, 1.0]), 1]
    around = np.array([[back, bottom], [front, bottom], [front, toes], [back, heel]])
    leg = shank[:, [0, 2]][ConvexHull(shank[:, [0, 2]]).vertices]
    points = [
        leg[np.argmax(leg @ [1.0, -1.0])],
        leg[np.argmax(leg[:, 0])],
        leg[np.argmax(leg @ [1.0, 1.0])],
        leg[np.argmin(leg[:, 0])],
    ]
    return LegOutline(around, np.array(points))


def leg_model(
    plant: MultibodyPlant, robot: RobotModel, outline: LegOutline
) -> LegModel:
    """Reads lengths and limits of the legs off a robot.

    Args:
        plant: the robot alone, finalised.
        robot: its names.
        outline: of a leg, see `leg_outline`.

    Raises:
        RobotError: the legs are not chains of hip pitch, roll, yaw, knee, ankle roll
            and pitch with hips and ankles in one point, which the closed form needs.
    """
    for foot in FEET:
        if len(robot.leg_joints[foot]) != len(_AXES):
            problem = (
                f"leg_joints.{foot}: must be {len(_AXES)} for the robot to walk, "
                f"got {len(robot.leg_joints[foot])}"
            )
            raise RobotError(robot.name, [problem])
    problems: list[str] = []
    lower, upper = np.zeros((2, 6)), np.zeros((2, 6))
    hips: dict[Foot, Vector] = {}
    offsets = np.zeros((2, 6, 3))
    for i, foot in enumerate(FEET):
        for k, name in enumerate(robot.leg_joints[foot]):
            joint = plant.GetJointByName(name)
            frame = joint.frame_on_parent()
            offsets[i, k] = frame.GetFixedPoseInBodyFrame().translation()
            least, most = robot.working_range.get(name, (-np.inf, np.inf))
            lower[i, k] = max(float(joint.position_lower_limits()[0]), least)
            upper[i, k] = min(float(joint.position_upper_limits()[0]), most)
            axis = joint.revolute_axis()  # type: ignore[attr-defined]
            if not np.allclose(axis, _AXES[k], atol=1e-6):
                problems.append(
                    f"leg_joints.{foot}: {name}, the {_NAMES[k]}, must turn about "
                    f"{_AXES[k].astype(int).tolist()} for the robot to walk, got "
                    f"{np.round(axis, 3).tolist()}"
                )
        hips[foot] = offsets[i, 0]
    joined = offsets[:, [1, 2, 5]]
    lateral = offsets[:, [3, 4], 1]
    if max(np.abs(joined).max(), np.abs(lateral).max()) > 1e-6:
        problems.append(
            "leg_joints: hips and ankles must be points, and the knee must lie in the "
            "plane between them, for the robot to walk"
        )
    if problems:
        raise RobotError(robot.name, problems)
    return LegModel(
        hips,
        offsets[0, 3][[0, 2]],
        offsets[0, 4][[0, 2]],
        lower,
        upper,
        robot.sole,
        outline,
    )


def rotations(rpy: Vector) -> Vector:
    """Rotation matrices of roll, pitch, yaw, (n, 3), as (n, 3, 3)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy.T), np.sin(rpy.T)
    R = np.empty((len(rpy), 3, 3))
    R[:, 0, 0], R[:, 1, 0], R[:, 2, 0] = cy * cp, sy * cp, -sp
    R[:, 0, 1], R[:, 0, 2] = cy * sp * sr - sy * cr, cy * sp * cr + sy * sr
    R[:, 1, 1], R[:, 1, 2] = sy * sp * sr + cy * cr, sy * sp * cr - cy * sr
    R[:, 2, 1], R[:, 2, 2] = cp * sr, cp * cr
    return R


def leg_angles(
    model: LegModel, foot: Foot, waist: Vector, R_WP: Vector, sole: Vector
) -> LegAngles:
    """Joint angles of one leg for pelvis and sole poses, in closed form.

    Args:
        model: the leg.
        foot: which.
        waist: origin of the pelvis in W, (n, 3), m.
        R_WP: its orientation, (n, 3, 3).
        sole: sole frames (x, y, z, roll, pitch, yaw), (n, 6).

    Returns:
        The angles; where the ankle is out of reach those with the knee at its limit
        that point the leg at it.
    """
    reach = model.hip_to_ankle(float(model.lower[FEET.index(foot), 3]))
    return _closed_form(model, waist + R_WP @ model.hips[foot], R_WP, sole, reach)


def both_leg_angles(
    model: LegModel, waist: Vector, R_WP: Vector, soles: Vector
) -> LegAngles:
    """`leg_angles` of both legs in one pass.

    Args:
        model: the legs.
        waist: origin of the pelvis in W, (n, 3), m.
        R_WP: its orientation, (n, 3, 3).
        soles: sole frames, left first, (n, 2, 6).

    Returns:
        The angles, (n, 2, 6), and how far each ankle is out of reach, (n, 2).
    """
    n = len(waist)
    hips = np.array([model.hips[foot] for foot in FEET])
    p_WH = waist[:, None] + hips @ np.swapaxes(R_WP, 1, 2)
    reach = [model.hip_to_ankle(float(knee)) for knee in model.lower[:, 3]]
    found = _closed_form(
        model,
        p_WH.reshape(-1, 3),
        np.repeat(R_WP, 2, axis=0),
        soles.reshape(-1, 6),
        np.tile(reach, n),
    )
    return LegAngles(found.angles.reshape(n, 2, 6), found.short.reshape(n, 2))


def _closed_form(
    model: LegModel, p_WH: Vector, R_WP: Vector, sole: Vector, reach: Vector | float
) -> LegAngles:
    """The legs between hips and soles; see `leg_angles`."""
    R_WA = rotations(sole[:, 3:])
    p_WA = sole[:, :3] + model.sole.ankle_height * R_WA[:, :, 2]
    p_A = np.einsum("nji,nj->ni", R_WA, p_WH - p_WA)
    distance = np.sqrt((p_A**2).sum(axis=1))
    knee = knee_angle(model, np.minimum(distance, reach))
    # The hip seen from the ankle in the frame of the shank.
    v = -(model.shank + _turned(model.thigh, -knee))
    p_A *= (np.sqrt((v**2).sum(axis=1)) / distance)[:, None]
    roll = np.arcsin(np.clip(p_A[:, 1] / v[:, 1], -1.0, 1.0))
    depth = v[:, 1] * np.cos(roll)
    pitch = np.arctan2(p_A[:, 2], p_A[:, 0]) - np.arctan2(depth, v[:, 0])
    pitch = (pitch + np.pi) % (2.0 * np.pi) - np.pi
    # R_KA = Rx(roll) Ry(pitch), and Ry(knee) is the shank's in the thigh.
    x, y, z = np.moveaxis(np.swapaxes(R_WP, 1, 2) @ R_WA, 2, 0)
    x, y, z = _shank_axes(x, y, z, roll, pitch)
    x, z = _pitched_back(x, z, knee)
    # R_PT = Ry(hip pitch) Rx(hip roll) Rz(hip yaw); its columns are x, y, z.
    hip_roll = np.arcsin(np.clip(-z[:, 1], -1.0, 1.0))
    hip_pitch = np.arctan2(z[:, 0], z[:, 2])
    hip_yaw = np.arctan2(x[:, 1], y[:, 1])
    angles = np.stack([hip_pitch, hip_roll, hip_yaw, knee, roll, pitch], axis=1)
    return LegAngles(angles, np.maximum(distance - reach, 0.0))


def knee_angle(model: LegModel, distance: Vector) -> Vector:
    """Knee angle at which hip and ankle are this far apart, (n,), rad."""
    a, b = np.linalg.norm(model.thigh), np.linalg.norm(model.shank)
    # Angle between thigh and shank where the joint is at zero.
    bend = np.arctan2(model.shank[0], -model.shank[1]) - np.arctan2(
        model.thigh[0], -model.thigh[1]
    )
    cosine = (distance**2 - a**2 - b**2) / (2.0 * a * b)
    return np.asarray(np.arccos(np.clip(cosine, -1.0, 1.0)) + bend)


def outline_points(
    model: LegModel, foot: Foot, angles: Vector, sole: Vector
) -> tuple[Vector, Vector]:
    """L_1 to L_7 and the knee in W.

    Args:
        model: the leg.
        foot: which; both have the same outline.
        angles: of the leg, (n, 6), rad.
        sole: sole frames, (n, 6).

    Returns:
        Points around the outline from L_1 to L_7, (n, 8, 3), and the knee, (n, 3), m.
    """
    R_WA = rotations(sole[:, 3:])
    p_WA = sole[:, :3] + model.sole.ankle_height * R_WA[:, :, 2]
    x, y, z = np.moveaxis(R_WA, 2, 0)
    sagittal_A = np.stack([x, z], axis=1)
    x, _, z = _shank_axes(x, y, z, angles[:, 4], angles[:, 5])
    sagittal_K = np.stack([x, z], axis=1)
    p_WK = p_WA - model.shank @ sagittal_K
    feet = model.outline.foot @ sagittal_A + p_WA[:, None]
    shank = model.outline.shank @ sagittal_K + p_WK[:, None]
    points = np.concatenate([feet[:, :3], shank, feet[:, 3:]], axis=1)
    return points, p_WK


def _turned(v: Vector, pitch: Vector | float) -> Vector:
    """(x, z) vectors turned by a pitch about y (from z to x)."""
    c, s = np.cos(pitch), np.sin(pitch)
    return np.stack([c * v[..., 0] + s * v[..., 1], c * v[..., 1] - s * v[..., 0]], -1)


def _pitched_back(x: Vector, z: Vector, pitch: Vector) -> tuple[Vector, Vector]:
    """Axes x and z, (n, 3) each, of a frame that is turned by -pitch about its y."""
    c, s = np.cos(pitch)[:, None], np.sin(pitch)[:, None]
    return c * x + s * z, c * z - s * x


def _shank_axes(
    x: Vector, y: Vector, z: Vector, roll: Vector, pitch: Vector
) -> tuple[Vector, Vector, Vector]:
    """Axes of the shank from those of the foot, (n, 3) each, and the ankle's angles."""
    x, z = _pitched_back(x, z, pitch)
    c, s = np.cos(roll)[:, None], np.sin(roll)[:, None]
    return x, c * y - s * z, c * z + s * y
