"""Motion plans whose climbing posture is chosen by what it will ask of the robot."""

import dataclasses
from collections.abc import Iterator
from functools import partial
from itertools import pairwise, product

import numpy as np

from footfall.models.values.feet import FEET
from footfall.models.values.planned import MotionPlan
from footfall.systems.planning.motion.choice_params import ChoiceParams
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_prediction import (
    TICK,
    MotionPrediction,
    MotionPredictor,
)
from footfall.systems.planning.motion.motion_task import Mode, MotionTask, Walker
from footfall.systems.planning.motion.quasi_static import (
    Climb,
    plan_segments,
    unstable_segment,
)
from footfall.systems.planning.motion.quasi_static_motion import play_segments

QUASI_STATIC_TICK = 0.03
"""Between the postures of a slow motion that are looked at, s."""
GAP_SCALE = 0.01
"""A limb that is this much too near a step is as bad as twice what is allowed, m."""


def choose_motion(
    task: MotionTask, mode: Mode, walker: Walker, predictor: MotionPredictor | None
) -> MotionPlan:
    """Chooses the first motion whose prediction keeps within reach, room and torque.

    Args:
        task: feet, CoM, footsteps and edges.
        mode: how the robot is to move.
        walker: parameters, what is tried among them, and robot.
        predictor: of this robot; None to take the first motion as it is.

    Returns:
        The plan. Where none will do it stands, and its `reason` names the quantity
        that the least bad one violates.
    """
    params = walker.params
    choice = params.choice
    if not task.footsteps:
        return _standing(task, walker, "")
    dynamic = mode == "dynamic"
    window = choice.torque_window if dynamic else choice.quasi_static_torque_window
    plans = _dynamic if dynamic else _quasi_static
    climbs = _climbs(task, params)
    yaw = float(task.footsteps[-1].X_WF.rotation().ToRollPitchYaw().yaw_angle())
    refusals: list[tuple[float, str]] = []
    for plan in plans(task, walker):
        if plan.reason:
            refusals.append((np.inf, plan.reason))
        elif predictor is None or not climbs:
            return plan
        else:
            first = 0.0 if dynamic else _first_rise(plan, params)
            tick = TICK if dynamic else QUASI_STATIC_TICK
            least = min((excess for excess, _ in refusals), default=np.inf)
            prediction = predictor.predict(
                plan,
                task.edges,
                yaw,
                tick,
                first,
                partial(_no_better, least, choice),
            )
            excess, reason = violation(prediction, window, choice)
            if not reason:
                return plan
            refusals.append((excess, reason))
    reason = min(refusals, key=lambda refusal: refusal[0])[1]
    return _standing(task, walker, reason)


def _no_better(
    least: float,
    choice: ChoiceParams,
    miss: float,
    posture_error: float,
    gap: float,
    self_distance: float,
) -> bool:
    """Whether a motion need not be looked at further: one was refused for less."""
    return (
        max(kinematic_excess(miss, posture_error, gap, self_distance, choice)) >= least
    )


def kinematic_excess(
    miss: float,
    posture_error: float,
    gap: float,
    self_distance: float,
    choice: ChoiceParams,
) -> tuple[float, float, float, float]:
    """What postures violate, as multiples of what is allowed; 1 is the limit.

    Args:
        miss: distance by which a sole misses its pose, m.
        posture_error: of a joint above the legs from its posture, rad.
        gap: between a limb and a step, m.
        self_distance: between two bodies of the robot, m.
        choice: what is allowed.

    Returns:
        Of the reach of the legs, of the posture, of the clearance from steps and from
        the robot itself.
    """
    return (
        miss / choice.reach_tolerance,
        posture_error / choice.posture_tolerance,
        1.0 + (choice.limb_clearance - gap) / GAP_SCALE,
        1.0 + (choice.self_clearance - self_distance) / GAP_SCALE,
    )


def violation(
    prediction: MotionPrediction, window: float, choice: ChoiceParams
) -> tuple[float, str]:
    """What a motion violates worst, and by how much for its allowance.

    Args:
        prediction: of the motion.
        window: over which torques are averaged, s.
        choice: what is allowed.

    Returns:
        The excess as a multiple of what is allowed, and the quantity in one line; 0
        and nothing where all is allowed.
    """
    found: list[tuple[float, str]] = []
    miss, posture_error = (
        float(prediction.foot_error.max()),
        float(prediction.posture_error.max()),
    )
    gap, limb, close = prediction.worst_gap()
    nearest, met = prediction.worst_self_distance()
    of_reach, of_posture, of_clearance, of_itself = kinematic_excess(
        miss, posture_error, gap, nearest.distance, choice
    )
    if of_reach > 1.0:
        when = prediction.time[int(prediction.foot_error.argmax())]
        found.append(
            (
                of_reach,
                f"reach: a sole would miss its place by {miss:.3f} m at {when:.1f} s, "
                f"more than {choice.reach_tolerance:.3f} m",
            )
        )
    if of_posture > 1.0:
        when = prediction.time[int(prediction.posture_error.argmax())]
        found.append(
            (
                of_posture,
                f"reach: the upper body would have to stray {posture_error:.2f} rad "
                f"from its posture at {when:.1f} s, more than "
                f"{choice.posture_tolerance:g} rad",
            )
        )
    if of_clearance > 1.0:
        found.append(
            (
                of_clearance,
                f"clearance: {limb} would come within {gap:.3f} m of a nosing at "
                f"{close:.1f} s, less than {choice.limb_clearance:.3f} m",
            )
        )
    if of_itself > 1.0:
        found.append(
            (
                of_itself,
                f"clearance: {' and '.join(nearest.bodies)} would come within "
                f"{nearest.distance:.3f} m of each other at {met:.1f} s, less than "
                f"{choice.self_clearance:.3f} m",
            )
        )
    share, joint, when = prediction.worst_torque(window)
    if share > choice.torque_share:
        limit = dict(zip(prediction.joints, prediction.effort_limits, strict=True))[
            joint
        ]
        found.append(
            (
                share / choice.torque_share,
                f"torque: {joint} would need {share * limit:.0f} Nm for {window:g} s "
                f"at {when:.1f} s, more than {choice.torque_share * limit:.0f} Nm",
            )
        )
    return max(found, default=(0.0, ""))


def _dynamic(task: MotionTask, walker: Walker) -> Iterator[MotionPlan]:
    choice = walker.params.choice
    for lean, toe_off in product(choice.leans, choice.toe_offs):
        tried = dataclasses.replace(walker.params, lean=lean, max_toe_off=toe_off)
        yield plan_motion(task, dataclasses.replace(walker, params=tried))


def _quasi_static(task: MotionTask, walker: Walker) -> Iterator[MotionPlan]:
    choice = walker.params.choice
    for toe_off, forward, height, lean in product(
        choice.quasi_static_toe_offs,
        choice.quasi_static_forwards,
        choice.quasi_static_heights,
        choice.quasi_static_leans,
    ):
        climb = Climb(lean, toe_off, height, forward)
        segments = plan_segments(task, climb, walker)
        reason = unstable_segment(segments, walker.params, walker.robot)
        if reason:
            yield _standing(task, walker, reason)
            continue
        yield play_segments(segments, task, walker)


def _standing(task: MotionTask, walker: Walker, reason: str) -> MotionPlan:
    alone = dataclasses.replace(walker, body=None)
    plan = plan_motion(MotionTask(task.feet, task.com), alone)
    return dataclasses.replace(plan, reason=reason)


def _first_rise(plan: MotionPlan, params: MotionPlannerParams) -> float:
    """When the segment begins before the one in which a foot first rises, s.

    Every segment begins at rest, so that the prediction may begin there.
    """
    period = plan.period
    for before, phase in pairwise(plan.phases):
        first, last = (round(t / period) for t in (phase.start, phase.end))
        rise = plan.foot_poses[last, :, 2] - plan.foot_poses[first, :, 2]
        if phase.swing is not None and np.abs(rise).max() > params.climb_threshold:
            return before.start
    return 0.0


def _climbs(task: MotionTask, params: MotionPlannerParams) -> bool:
    heights = dict(zip(FEET, task.feet[:, 2], strict=True))
    return any(
        abs(step.X_WF.translation()[2] - heights[step.foot]) > params.climb_threshold
        for step in task.footsteps
    )
