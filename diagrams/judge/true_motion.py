"""Where the robot truly was: its plant replayed over the logged state."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex

from footfall.models.robots.robot import RobotModel, Sole
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector


@dataclass(frozen=True)
class TrueMotion:
    """Poses of what a judge looks at, over n samples."""

    time: Vector
    """(n,), s."""
    com: Vector
    """p_WCom, (n, 3), m."""
    com_velocity: Vector
    """v_WCom, (n, 3), m/s."""
    base: Vector
    """Origin of the floating base, (n, 3), m."""
    torso_up: Vector
    """Cosine of the angle between the torso's z and the vertical, (n,)."""
    sole_corners: Mapping[Foot, Vector]
    """Corners of each sole in W, (n, 4, 3), m: heel right, toe right, toe left, heel
    left."""
    X_WF: Mapping[Foot, Vector]
    """Pose of each sole frame as homogeneous matrices, (n, 4, 4)."""


def sole_corners_F(sole: Sole) -> Vector:
    """Computes the sole's corners in F, (4, 3), m, counter-clockwise from above."""
    heel, toe, half = -sole.heel, sole.toe, sole.half_width
    return np.array(
        [[heel, -half, 0], [toe, -half, 0], [toe, half, 0], [heel, half, 0]]
    )


def true_motion(
    plant: MultibodyPlant,
    instance: ModelInstanceIndex,
    robot: RobotModel,
    time: Vector,
    state: Vector,
) -> TrueMotion:
    """Replays the robot's state on the plant.

    Args:
        plant: the finalised plant.
        instance: the robot in it.
        robot: the names of its parts.
        time: (n,), s.
        state: positions, then velocities of the robot, (n, nq + nv).

    Raises:
        ValueError: the state has another size than the robot's.
    """
    size = plant.num_multibody_states(instance)
    if state.shape != (len(time), size):
        raise ValueError(
            f"state: expected shape ({len(time)}, {size}), got {state.shape}"
        )
    context = plant.CreateDefaultContext()
    base = plant.GetBodyByName(robot.base_body, instance)
    torso = plant.GetBodyByName(robot.torso_body, instance)
    feet = {
        foot: plant.GetBodyByName(robot.foot_bodies[foot], instance) for foot in FEET
    }
    X_AF: Vector = np.eye(4)
    X_AF[2, 3] = -robot.sole.ankle_height
    com, com_velocity, base_positions = np.zeros((3, len(time), 3))
    torso_up = np.zeros(len(time))
    X_WF: dict[Foot, Vector] = {foot: np.zeros((len(time), 4, 4)) for foot in FEET}
    for index, row in enumerate(state):
        plant.SetPositionsAndVelocities(context, instance, row)
        com[index] = plant.CalcCenterOfMassPositionInWorld(context, [instance])
        com_velocity[index] = plant.CalcCenterOfMassTranslationalVelocityInWorld(
            context, [instance]
        )
        base_positions[index] = plant.EvalBodyPoseInWorld(context, base).translation()
        R_WT = plant.EvalBodyPoseInWorld(context, torso).rotation().matrix()
        torso_up[index] = R_WT[2, 2]
        for foot, body in feet.items():
            X_WA = plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()
            X_WF[foot][index] = X_WA @ X_AF
    p_F = sole_corners_F(robot.sole)
    corners: dict[Foot, Vector] = {
        foot: poses[:, None, :3, 3] + np.einsum("nij,kj->nki", poses[:, :3, :3], p_F)
        for foot, poses in X_WF.items()
    }
    return TrueMotion(time, com, com_velocity, base_positions, torso_up, corners, X_WF)
