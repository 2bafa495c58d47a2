"""Quasi-static climbing: segments with straight CoM lines (stair paper, Sec. 6.1).

Every step up is five segments: the CoM goes over the foot that stays; the other foot
goes to its place on the tread; the CoM goes over that foot; it is lifted while the
foot that stayed follows; it goes to the middle. In each segment the contacts rest, so
that its static-stability polygon is one, and a line whose two ends lie in it lies in
it (Sec. 6.2). Where the rear leg is too short to stay flat the third segment has two
parts: the rear heel rises in the second, where the rear foot stands on its toes.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET, Foot, other_foot
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.balance.convex_polygon import signed_margin
from footfall.systems.balance.sole_contacts import carrying_contact
from footfall.systems.balance.stability_polygon import static_polygon
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.motion.toe_off import heading, lift_heel


@dataclass(frozen=True)
class Segment:
    """A stretch of motion whose contacts rest."""

    name: str
    """What it does, in a few words."""
    duration: float
    """s."""
    stance: tuple[Foot, ...]
    """The feet on the ground."""
    swing: Foot | None
    """The foot in the air."""
    com: Vector
    """Both ends of the CoM's line, (2, 3), m."""
    start: Vector
    """Poses of the feet when it begins, (2, 6)."""
    end: Vector
    """Poses when it ends, (2, 6)."""
    lengths: Vector
    """Length of each sole that carries, (2,), m."""
    lean: Vector
    """Pitch of the pelvis at both ends, (2,), rad."""


@dataclass(frozen=True)
class Climb:
    """What is chosen for the climbing steps of a motion."""

    lean: float
    """Forward pitch of the pelvis, rad."""
    toe_off: float
    """Pitch of the rear foot when it leaves the ground, rad."""
    lifted_height: float
    """CoM above the upper tread then, m."""
    forward: float
    """CoM ahead of the upper ankle then, m: far forward the weight takes least torque
    of the bent knee, which comes nearer to the next nosing."""


class _Builder:
    """Lines up segments; each begins where the last one ended."""

    def __init__(
        self, feet: Vector, com: Vector, params: MotionPlannerParams, robot: RobotModel
    ) -> None:
        self.segments: list[Segment] = []
        self.feet, self.com, self.lean = feet, com, 0.0
        self._params, self._robot = params, robot

    def add(
        self,
        name: str,
        com: Vector,
        lean: float,
        swing: Foot | None = None,
        feet: Vector | None = None,
        toes: Foot | None = None,
    ) -> None:
        """One more segment.

        Args:
            name: what it does.
            com: where its line ends, (3,).
            lean: at its end, rad.
            swing: the foot in the air.
            feet: poses at its end, where they change.
            toes: the foot that stands on its toes.
        """
        params = self._params.quasi_static
        feet = self.feet if feet is None else feet
        lengths = np.full(2, self._robot.sole.length)
        if toes is not None:
            lengths[FEET.index(toes)] = self._params.toe_strip
        way = 0.0
        if swing is not None:
            i = FEET.index(swing)
            moved = np.abs(feet[i, :3] - self.feet[i, :3])
            way = float(np.hypot(moved[0], moved[1]) + moved[2])
            way += 2.0 * self._params.swing.apex_clearance
        duration = max(
            params.min_time,
            float(np.linalg.norm(com - self.com)) / params.com_speed,
            way / params.foot_speed,
        )
        self.segments.append(
            Segment(
                name,
                np.ceil(duration / self._params.period) * self._params.period,
                tuple(foot for foot in FEET if foot != swing),
                swing,
                np.array([self.com, com]),
                self.feet,
                feet,
                lengths,
                np.array([self.lean, lean]),
            )
        )
        self.feet, self.com, self.lean = feet, com, lean


def plan_segments(
    task: MotionTask, climb: Climb, walker: Walker
) -> tuple[Segment, ...]:
    """Plans the segments of a quasi-static walk, from standing to standing.

    Args:
        task: start and footsteps.
        climb: what is chosen for climbing steps.
        walker: parameters and robot.

    Returns:
        The segments; none without footsteps.
    """
    footsteps, params, robot = task.footsteps, walker.params, walker.robot
    builder = _Builder(task.feet, task.com, params, robot)
    for k, footstep in enumerate(footsteps):
        i = FEET.index(footstep.foot)
        stance = other_foot(footstep.foot)
        j = FEET.index(stance)
        rpy = footstep.X_WF.rotation().ToRollPitchYaw().vector()
        target = builder.feet.copy()
        target[i] = np.concatenate([footstep.X_WF.translation(), rpy])
        up = target[i, 2] - builder.feet[i, 2]
        follows = builder.feet[j, 2] - builder.feet[i, 2] > params.climb_threshold
        lean = climb.lean if up > params.climb_threshold else 0.0
        over = _over(builder.feet[j], stance, follows, climb, params)
        if follows:
            _push_up(builder, i, over, climb, params, robot)
        else:
            over[2] = builder.com[2]
            builder.add(f"CoM over the {stance} foot", over, lean)
        lifted = over.copy()
        lifted[2] = builder.feet[j, 2] + params.com_height
        name = f"{footstep.foot} foot to its place"
        builder.add(name, lifted, lean, swing=footstep.foot, feet=target)
        level = abs(target[0, 2] - target[1, 2]) <= params.climb_threshold
        last = k + 1 == len(footsteps)
        if level and (last or follows or _rises(footsteps[k + 1], target, params)):
            middle = _middle(target, params)
            builder.add("CoM to the middle", middle, 0.0)
    return tuple(builder.segments)


def _push_up(
    builder: _Builder,
    rear: int,
    over: Vector,
    climb: Climb,
    params: MotionPlannerParams,
    robot: RobotModel,
) -> None:
    """The third segment: level until the toes can carry, then up with the rear heel."""
    name = f"CoM over the {FEET[1 - rear]} foot"
    lifted = builder.feet.copy()
    lifted[rear] = lift_heel(builder.feet[rear], np.array([climb.toe_off]), robot.sole)[
        0
    ]
    share = _reach_of_toes(builder, rear, over, params, robot)
    between = builder.com + share * (over - builder.com)
    between[2] = builder.com[2]
    builder.add(name, between, climb.lean)
    builder.add(
        f"{name}, {FEET[rear]} heel up",
        over,
        climb.lean,
        feet=lifted,
        toes=FEET[rear],
    )


def _reach_of_toes(
    builder: _Builder,
    rear: int,
    over: Vector,
    params: MotionPlannerParams,
    robot: RobotModel,
) -> float:
    """The least share of the way at which the CoM may rest with the rear foot on toes.

    1 where it never may: the check of the segments then tells why.
    """
    lengths = np.full(2, robot.sole.length)
    lengths[rear] = params.toe_strip
    polygon = _polygon(builder.feet, FEET, lengths, params, robot)
    for share in np.linspace(0.0, 1.0, 41):
        point = builder.com + share * (over - builder.com)
        margin = signed_margin(polygon, point[:2])
        if margin >= params.quasi_static.margin:
            return float(share)
    return 1.0


def _over(
    pose: Vector, foot: Foot, up: bool, climb: Climb, params: MotionPlannerParams
) -> Vector:
    """Where the CoM is to be above a foot, (3,)."""
    quasi = params.quasi_static
    left: Vector = heading(pose[5] + np.pi / 2.0)
    inward = -left if foot == "left" else left
    p_WCom = pose[:3].copy()
    forward = climb.forward if up else quasi.forward
    p_WCom[:2] += forward * heading(pose[5]) + quasi.inward * inward
    p_WCom[2] += climb.lifted_height if up else params.com_height
    return p_WCom


def _middle(feet: Vector, params: MotionPlannerParams) -> Vector:
    """The CoM in the middle between two level feet, (3,)."""
    p_WCom: Vector = feet[:, :3].mean(axis=0)
    p_WCom[:2] += params.zmp_forward * heading(feet[:, 5].mean())
    p_WCom[2] = feet[:, 2].min() + params.com_height
    return p_WCom


def _rises(footstep: Footstep, feet: Vector, params: MotionPlannerParams) -> bool:
    height = float(footstep.X_WF.translation()[2])
    return height - float(feet[:, 2].max()) > params.climb_threshold


def _polygon(
    feet: Vector,
    stance: tuple[Foot, ...],
    lengths: Vector,
    params: MotionPlannerParams,
    robot: RobotModel,
) -> Vector:
    contacts = [
        carrying_contact(
            feet[FEET.index(foot)],
            lengths[FEET.index(foot)],
            robot.sole,
            params.quasi_static.friction,
        )
        for foot in stance
    ]
    return static_polygon(contacts).vertices


def unstable_segment(
    segments: tuple[Segment, ...], params: MotionPlannerParams, robot: RobotModel
) -> str:
    """Why a CoM line is not statically stable; empty where all are.

    Both ends of every line are held against the polygon of their segment.
    """
    for number, segment in enumerate(segments, start=1):
        polygon = _polygon(
            segment.start, segment.stance, segment.lengths, params, robot
        )
        what = f"segment {number} ({segment.name})"
        if len(polygon) == 0:
            return f"{what}: its contacts cannot hold the robot, the polygon is empty"
        for end, p_WCom in zip(("starts", "ends"), segment.com, strict=True):
            margin = signed_margin(polygon, p_WCom[:2])
            if margin < params.quasi_static.margin - 1e-9:
                return (
                    f"{what}: its CoM line {end} {margin:.3f} m inside the static-"
                    f"stability polygon, less than {params.quasi_static.margin:.3f} m"
                )
    return ""
