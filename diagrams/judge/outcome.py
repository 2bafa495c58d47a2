"""The judge: what became of a task, from what truly happened.

It sees the plant's true state, the true contacts and the true scene; of what the
controller believes it takes only that it stopped, and why.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from footfall.diagrams.judge.evidence import Evidence, Stop
from footfall.diagrams.judge.evidence_measures import (
    climb_time,
    com_error,
    crossing_figures,
    dcm_error,
    foot_contacts,
    footsteps,
    goal_error,
    max_friction_ratio,
    max_impact,
    max_slip,
    min_static_margin,
    min_zmp_margin,
    steps_climbed,
)
from footfall.diagrams.judge.evidence_signals import (
    CLIMBING,
    fall,
    foot_loads,
    foot_wrenches,
    last_ground,
)
from footfall.diagrams.judge.falls import Fall
from footfall.diagrams.judge.joint_figures import (
    by_joint,
    joint_peaks,
    sample_period,
    time_at_limit,
    worst_fraction,
)
from footfall.diagrams.judge.rest import rest_faults, rest_figures
from footfall.diagrams.judge.rules import SLIP_MENTIONED, broken_rules, missing_evidence
from footfall.models.values.feet import Foot
from footfall.models.values.value import Json
from footfall.models.values.vector import Vector

Outcome: TypeAlias = Literal[
    "completed", "failed", "fell", "infeasible", "timed_out", "interrupted", "cut"
]
"""What can become of a task; see `judge`."""


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """What became of the task; a figure that was not measured is None.

    A text stands below the field, or the fields, that it explains; see `meanings`.
    """

    outcome: Outcome
    reason: str
    """What became of the task, and why, in one line; "cut" also of a run that has no
    summary."""
    footsteps: int | None = None
    steps_climbed: int | None = None
    """How many footsteps were taken, and the highest tread that both feet came to rest
    on or above: loaded and flat for 0.2 s, before any fall; null where no stairs were
    to be climbed."""
    max_torque_fraction: float | None = None
    max_torque_joint: str | None = None
    """Largest torque of any joint over its limit in the URDF, and which joint's."""
    torque_limit_s: float | None = None
    torque_limit_joint: str | None = None
    """For how long any joint's torque was at its limit, and which most often."""
    max_wanted_torque_fraction: float | None = None
    max_wanted_torque_joint: str | None = None
    """Largest torque that a joint's servo wanted, over its limit, and which joint's;
    the plant applies no more than the limit."""
    max_speed_fraction: float | None = None
    max_speed_joint: str | None = None
    """Largest speed of any joint over its limit in the URDF, and which joint's."""
    min_zmp_margin_m: float | None = None
    """Least distance of the measured zero-moment point from the edge of the support
    polygon; negative outside."""
    min_static_margin_m: float | None = None
    """Least signed distance of the true centre of mass from the edge of the
    static-stability polygon of the soles that truly bear weight; meant for quasi-static
    motion, negative is normal in a dynamic one."""
    max_dcm_error_m: float | None = None
    com_rms_error_m: float | None = None
    """How far the divergent component of motion (at most) and the centre of mass (root
    mean square) were from their references."""
    max_foot_slip_m: float | None = None
    """Farthest that a foot slid while it stood."""
    max_impact_body_weights: float | None = None
    """Largest upward force on a foot, averaged over 10 ms, looked at every step of the
    plant."""
    max_friction_ratio: float | None = None
    """Largest horizontal over upward force of a foot that bears more than a fifth of
    the weight, both averaged over 10 ms."""
    min_self_distance_m: float | None = None
    min_self_distance_bodies: tuple[str, str] | None = None
    """Nearest that two of the robot's own bodies came that may collide, and which; null
    beyond 10 cm."""
    min_clearance_m: float | None = None
    min_clearance_body: str | None = None
    """Least distance between a swinging sole and the edges of the steps; over an
    obstacle, between any part of the robot and the obstacle, and which part."""
    goal_error_m: float | None = None
    goal_turn_rad: float | None = None
    """Horizontal distance of the feet's midpoint from the goal at the end, and turn of
    their mean heading from the goal's, where there is one."""
    climb_time_s: float | None = None
    """From the first motion until the last foot stood on the top tread: the time spent
    moving alone, without scanning, thinking (segmenting and planning) and coming to
    rest."""
    obstacles_crossed: int | None = None
    """How many were stepped over."""
    crossing_time_s: float | None = None
    crossing_impact_body_weights: float | None = None
    """From the first foot's lift-off to the second's touch-down, all in between
    included (it is planned before, so no thinking is in it), and the largest upward
    force, averaged over 10 ms, on a foot that lands; of what both feet stepped over,
    not of what was walked past."""
    crossing: Mapping[str, Json] | None = None
    """What the planner says of its crossings; of quasi-static ones also how far the
    centre of mass keeps inside the stance and the largest share of an effort limit that
    standing takes."""


def judge(evidence: Evidence) -> Judgement:
    """Measures the run and says what became of the task.

    - "completed": the executive finished, the robot came to rest where the task ends
      (see `rest_faults`) and no rule was broken (see `broken_rules`).
    - "failed": the executive finished, but it did not rest or a rule was broken.
    - "fell": at any time (see `find_fall`).
    - "infeasible": a planner refused.
    - "timed_out": the time was up.
    - "interrupted": the user ended it, by Ctrl-C or by a condition of his own.
    - "cut": the simulation broke off, or its process was killed.

    The reason of a run that did not finish also names the rules that it broke.
    """
    wrenches = foot_wrenches(evidence)
    loads = foot_loads(evidence)
    contacts = foot_contacts(evidence, wrenches)
    limits, state_period = evidence.limits, sample_period(evidence)
    torques = by_joint(evidence, "plant.net_actuation")
    torque = worst_fraction(torques, limits.torque)
    wanted = worst_fraction(by_joint(evidence, "station.torque_wanted"), limits.torque)
    clipped = time_at_limit(torques, limits.torque, state_period)
    speed = worst_fraction(joint_peaks(evidence), limits.speed)
    slip = max_slip(evidence, wrenches)
    outcome, reason = _verdict(evidence, loads, speed, slip)
    nearest = evidence.self_distance
    return Judgement(
        outcome=outcome,
        reason=reason,
        footsteps=None if contacts is None else footsteps(evidence, contacts),
        steps_climbed=steps_climbed(evidence, loads),
        max_torque_fraction=torque[0],
        max_torque_joint=torque[1],
        torque_limit_s=clipped[0],
        torque_limit_joint=clipped[1],
        max_wanted_torque_fraction=wanted[0],
        max_wanted_torque_joint=wanted[1],
        max_speed_fraction=speed[0],
        max_speed_joint=speed[1],
        min_zmp_margin_m=min_zmp_margin(evidence, wrenches),
        min_static_margin_m=min_static_margin(evidence, loads),
        max_dcm_error_m=dcm_error(evidence),
        com_rms_error_m=com_error(evidence),
        max_foot_slip_m=slip,
        max_impact_body_weights=max_impact(evidence),
        max_friction_ratio=max_friction_ratio(evidence),
        min_self_distance_m=None if nearest is None else nearest.distance,
        min_self_distance_bodies=None if nearest is None else nearest.bodies,
        **crossing_figures(evidence, wrenches),
        goal_error_m=None if evidence.goal is None else goal_error(evidence)[0],
        goal_turn_rad=None if evidence.goal is None else goal_error(evidence)[1],
        climb_time_s=climb_time(evidence, contacts),
    )


def _verdict(
    evidence: Evidence,
    loads: dict[Foot, Vector] | None,
    speed: tuple[float | None, str | None],
    slip: float | None,
) -> tuple[Outcome, str]:
    fallen = fall(evidence)
    if fallen is not None or evidence.stop == "fell":
        return "fell", _fall_reason(evidence, fallen)
    rules = broken_rules(evidence, speed, slip)
    if evidence.stop != "finished":
        reason = "; besides, ".join([evidence.stop_reason, *rules[:1]])
        return STOPPED[evidence.stop], "; ".join([reason, *rules[1:]])
    ground = last_ground(evidence)
    rules += missing_evidence(evidence, speed[0], slip)
    figures = rest_figures(evidence.motion, loads, evidence.limits.weight, ground)
    unrest = rest_faults(figures, ground)
    if unrest:
        rules = [f"the robot did not come to rest: {', '.join(unrest)}", *rules]
    if rules:
        return "failed", "; ".join(rules)
    done = "the robot rests on the floor"
    if evidence.kind == CLIMBING:
        done = f"both feet rest on {ground.name}, number {len(evidence.treads)}"
    elif evidence.goal is not None:
        done = f"the robot rests {100.0 * goal_error(evidence)[0]:.1f} cm from the goal"
    if slip is not None and slip > SLIP_MENTIONED:
        done += f"; a loaded foot slid by {1e3 * slip:.0f} mm"
    return "completed", done


STOPPED: dict[Stop, Outcome] = {
    "infeasible": "infeasible",
    "time limit": "timed_out",
    "stopped": "interrupted",
    "interrupted": "interrupted",
    "error": "cut",
}
"""What becomes of a task that neither finished nor fell, by why it stopped."""


def _fall_reason(evidence: Evidence, fallen: Fall | None) -> str:
    if fallen is None:
        return evidence.stop_reason
    reason = f"the robot fell at {fallen.time:.2f} s: {fallen.how}"
    if evidence.stop in ("fell", "finished"):
        return reason
    return f"{reason}; {evidence.stop_reason}"
