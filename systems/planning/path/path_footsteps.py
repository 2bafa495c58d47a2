"""Footsteps along a path: as few as get both feet side by side to the goal's pose.

The robot's middle goes along the path's curve; each step puts a foot beside where the
middle is then. Every step is checked, not assumed: within reach of the stance foot,
the feet apart on landing and on the way, and every sole clear of every box.
"""

from collections.abc import Mapping
from math import ceil, degrees

import numpy as np
import shapely  # type: ignore[import-untyped]
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET, Foot, other_foot
from footfall.models.values.geometry import heading
from footfall.models.values.planned import Footstep, FootstepPlan
from footfall.models.values.room import Environment, PathPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import (
    SIDE,
    Refusal,
    min_width,
    sole_outline,
    wrap,
)
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.standing import FLOOR
from footfall.systems.planning.path.path_headings import StepReach
from footfall.systems.planning.path.path_walk import step_centres, walk_curve

SPARE_STEPS = 2
"""More steps that are tried before smaller ones on the curve are."""
TURN_SHARES = (1.0, 0.9, 0.8, 0.65, 0.5)
"""Shares of the largest turn a step that are tried, one after the other."""
SOLE_CLEARANCE = 0.03
"""Least distance of a sole to a box, on the floor and on the way, m."""


def plan_path_footsteps(
    path: PathPlan,
    environment: Environment,
    X_WF_left: RigidTransform,
    X_WF_right: RigidTransform,
    params: FootstepPlannerParams,
    sole: Sole,
) -> FootstepPlan:
    """Plans the steps from where the feet are to the end of a path.

    Args:
        path: from midway between the feet to the goal.
        environment: what the path was planned in.
        X_WF_left: pose of the left sole.
        X_WF_right: pose of the right sole.
        params: what the robot can step; `stance_width`, `max_stance_width`,
            `sole_gap`, `max_step_length`, `max_back_step`, `max_turn`, and the
            tolerances within which a foot stands at the goal already.
        sole: both soles.

    Returns:
        The footsteps, level at the feet's height and on plane -1, the last two side by
        side at the goal's pose; "finished" where the feet stand there already;
        "infeasible" with the reason where there is no path or no steps along it.
    """
    if path.status != "planned":
        return FootstepPlan(status="infeasible", reason=path.reason)
    feet: Mapping[Foot, RigidTransform] = {"left": X_WF_left, "right": X_WF_right}
    start = {f: np.array([*X.translation()[:2], heading(X)]) for f, X in feet.items()}
    start["right"][2] = start["left"][2] + wrap(start["right"][2] - start["left"][2])
    goal = np.array([*path.points[-1], path.goal_yaw])
    if all(_is_at(start[f], _beside(goal, f, params), params) for f in FEET):
        return FootstepPlan(status="finished")
    steps = _search(path, environment, start, params, sole)
    if isinstance(steps, Refusal):
        return FootstepPlan(status="infeasible", reason=steps.reason)
    z = float(np.mean([X_WF.translation()[2] for X_WF in feet.values()]))
    footsteps = tuple(
        Footstep(foot, _level_pose(pose, z), FLOOR) for foot, pose in steps
    )
    return FootstepPlan(footsteps=footsteps, status="planned")


def _search(
    path: PathPlan,
    environment: Environment,
    start: Mapping[Foot, Vector],
    params: FootstepPlannerParams,
    sole: Sole,
) -> list[tuple[Foot, Vector]] | Refusal:
    """The first sequence, from the fewest steps on, that passes every check."""
    boxes = environment.boxes
    feet = shapely.polygons([box.footprint() for box in boxes]) if boxes else None
    refusal = Refusal("no steps")
    yaw = float(start["left"][2] + start["right"][2]) / 2.0
    for share in TURN_SHARES:
        reach = step_reach(params, sole, share)
        curve, effort = walk_curve(
            path.points, yaw, path.goal_yaw, reach, params.stance_width
        )
        least = max(1, ceil(effort[-1] - 1e-6))
        for count in range(least, least + SPARE_STEPS + 1):
            centres = step_centres(curve, effort, count)
            for first in FEET:
                steps = _steps(centres, first, params)
                found = _refuse(steps, start, feet, params, sole)
                if found is None:
                    return steps
                refusal = found
    return refusal


def step_reach(
    params: FootstepPlannerParams, sole: Sole, turn_share: float = 1.0
) -> StepReach:
    """How far the robot's middle gets with a step of either foot.

    Args:
        params: what the robot can step.
        sole: both soles.
        turn_share: share of the largest turn that is used.
    """
    narrowest = min_width(0.0, "left", sole, params.sole_gap)
    wider = params.max_stance_width - params.stance_width
    return StepReach(
        forward=params.max_step_length,
        backward=params.max_back_step,
        sideways=max(min(wider, params.stance_width - narrowest), 0.01),
        turn=params.max_turn * turn_share,
        turn_narrows=max(sole.toe, sole.heel),
    )


def _beside(centre: Vector, foot: Foot, params: FootstepPlannerParams) -> Vector:
    """Pose (x, y, yaw) of a foot beside the robot's middle."""
    x, y, yaw = centre
    side = SIDE[foot] * params.stance_width / 2.0
    return np.array([x - np.sin(yaw) * side, y + np.cos(yaw) * side, yaw])


def _is_at(pose: Vector, place: Vector, params: FootstepPlannerParams) -> bool:
    return bool(
        np.abs(pose[:2] - place[:2]).max() <= params.stand_tolerance
        and abs(wrap(pose[2] - place[2])) <= params.stand_turn_tolerance
    )


def _steps(
    centres: Vector, first: Foot, params: FootstepPlannerParams
) -> list[tuple[Foot, Vector]]:
    """Alternating steps beside the centres, and one that brings the feet together."""
    foot, steps = first, []
    for centre in (*centres, centres[-1]):
        steps.append((foot, _beside(centre, foot, params)))
        foot = other_foot(foot)
    return steps


def _refuse(
    steps: list[tuple[Foot, Vector]],
    start: Mapping[Foot, Vector],
    boxes: np.ndarray[tuple[int], np.dtype[np.object_]] | None,
    params: FootstepPlannerParams,
    sole: Sole,
) -> Refusal | None:
    """Why the steps cannot be made, None where they can."""
    feet = [steps[0][0], other_foot(steps[0][0]), *(foot for foot, _ in steps)]
    poses = np.array([start[feet[0]], start[feet[1]], *(pose for _, pose in steps)])
    # Row k moves the foot of pose k to pose k + 2 beside the foot of pose k + 1.
    for k, (foot, landing) in enumerate(steps):
        stance = poses[k + 1]
        turn = wrap(landing[2] - stance[2])
        c, s = np.cos(stance[2]), np.sin(stance[2])
        x, y = np.array([[c, s], [-s, c]]) @ (landing[:2] - stance[:2])
        width = SIDE[foot] * y
        least = min_width(turn, foot, sole, params.sole_gap)
        if abs(turn) > params.max_turn + 1e-9:
            return Refusal(
                f"step {k + 1} would turn the {foot} foot by {degrees(turn):.0f} deg "
                f"against the other, more than {degrees(params.max_turn):.0f} deg"
            )
        if not -params.max_back_step - 1e-9 <= x <= params.max_step_length + 1e-9:
            return Refusal(
                f"step {k + 1} would set the {foot} foot {x:.2f} m ahead of the other"
            )
        if not least - 1e-9 <= width <= params.max_stance_width + 1e-9:
            return Refusal(
                f"step {k + 1} would set the {foot} foot {width:.2f} m beside the other"
            )
    soles = _soles(poses, sole)
    swept = shapely.convex_hull(
        shapely.multipoints(np.concatenate([soles[:-2], soles[2:]], axis=1))
    )
    stances = shapely.polygons(soles[1:-1])
    crossed = shapely.dwithin(swept, stances, params.sole_gap - 1e-9)
    if crossed.any():
        return Refusal(
            f"step {int(crossed.argmax()) + 1} would bring the feet nearer than "
            f"{params.sole_gap:.2f} m to each other on the way"
        )
    if boxes is not None:
        near = shapely.dwithin(swept[:, None], boxes[None, :], SOLE_CLEARANCE)
        if near.any():
            step = int(near.any(axis=1).argmax())
            return Refusal(
                f"step {step + 1} would bring the sole nearer than "
                f"{SOLE_CLEARANCE:.2f} m to a box"
            )
    return None


def _soles(poses: Vector, sole: Sole) -> Vector:
    """Corners of the soles at poses (x, y, yaw), (n, 4, 2), m."""
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    turn = np.stack([np.stack([c, -s], axis=1), np.stack([s, c], axis=1)], axis=1)
    corners: Vector = np.einsum("nij,kj->nki", turn, sole_outline(sole))
    return corners + poses[:, None, :2]


def _level_pose(pose: Vector, z: float) -> RigidTransform:
    p_WF: Vector = np.array([pose[0], pose[1], z])
    return RigidTransform(RollPitchYaw(0.0, 0.0, wrap(float(pose[2]))), p_WF)
