"""The judge, on evidence that is altered in one respect at a time."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.outcome import judge
from footfall.diagrams.judge.self_distance import NearestApproach
from footfall.diagrams.judge.true_motion import TrueMotion, sole_corners_F
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.contact import Touch
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector
from tests.diagrams.judge.climb_evidence import (
    LEFT,
    RIGHT,
    SAMPLES,
    WEIGHT,
    frame,
    motion_of,
    wrenches,
)

LAST = slice(-101, None)
"""The last second."""
TREAD_FRONT = 0.3 + 0.27
"""Where the top tread begins, m."""


def with_sole(
    evidence: Evidence, foot: Foot, X_FG: RigidTransform, samples: slice = LAST
) -> Evidence:
    """The same with one sole moved, by a pose in its own frame."""
    X_WF = evidence.motion.X_WF[foot].copy()
    X_WF[samples] = X_WF[samples] @ X_FG.GetAsMatrix4()
    corners_F = sole_corners_F(JVRC1.sole)
    corners = X_WF[:, None, :3, 3] + np.einsum(
        "nij,kj->nki", X_WF[:, :3, :3], corners_F
    )
    motion = replace(
        evidence.motion,
        X_WF={**evidence.motion.X_WF, foot: X_WF},
        sole_corners={**evidence.motion.sole_corners, foot: corners},
    )
    return replace(evidence, motion=motion)


def overhanging(evidence: Evidence, back: float) -> Evidence:
    """The same with both soles farther back on the top tread, m."""
    X_FG = moved(x=-back)
    evidence = with_sole(evidence, "left", X_FG, slice(400, None))
    return with_sole(evidence, "right", X_FG, slice(500, None))


def with_motion(evidence: Evidence, **changes: Callable[[Vector], None]) -> Evidence:
    """The same with fields of its motion changed in place."""
    fields = {}
    for name, change in changes.items():
        fields[name] = getattr(evidence.motion, name).copy()
        change(fields[name])
    return replace(evidence, motion=replace(evidence.motion, **fields))


def with_frame(evidence: Evidence, name: str, columns: Vector) -> Evidence:
    """The same with one signal replaced."""
    return replace(evidence, frames={**evidence.frames, name: frame(columns)})


def put(value: object, samples: slice = LAST, *axes: int) -> Callable[[Vector], None]:
    """Writes a value into some samples."""

    def change(array: Vector) -> None:
        array[(samples, *axes)] = value

    return change


def moved(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> RigidTransform:
    """A pose without a turn."""
    return RigidTransform(np.array([x, y, z]))


def test_a_climb_is_completed_and_counted(climb: Evidence) -> None:
    """Three footsteps, two steps, the limits' shares with the joints' names."""
    judgement = judge(climb)
    assert (judgement.outcome, judgement.steps_climbed) == ("completed", 2)
    assert judgement.reason == "both feet rest on the top tread, number 2"
    assert judgement.footsteps == 3
    assert (judgement.max_torque_fraction, judgement.max_torque_joint) == (0.8, "KNEE")
    assert judgement.max_wanted_torque_fraction == pytest.approx(1.2)
    assert judgement.max_wanted_torque_joint == "KNEE"
    assert (judgement.torque_limit_s, judgement.torque_limit_joint) == (0.0, None)
    assert (judgement.max_speed_fraction, judgement.max_speed_joint) == (0.65, "KNEE")
    assert judgement.max_impact_body_weights == pytest.approx(1.1)
    assert judgement.max_friction_ratio == pytest.approx(0.25)
    assert judgement.max_foot_slip_m == 0.0
    assert judgement.min_zmp_margin_m == pytest.approx(0.042)


@pytest.mark.parametrize(
    ("signal", "reason"),
    [
        ("station.foot_wrenches", "what the left sole bears was not measured"),
        ("station.foot_wrenches", "the feet's slip was not measured"),
        ("speed_monitor.peak_speeds", "the joints' speeds were not watched"),
        (
            "contact_monitor.other_support",
            "what others than the soles bore was not watched",
        ),
    ],
)
def test_a_signal_that_is_missing_is_not_in_favour(climb, signal, reason) -> None:
    """It is named, and nothing that it would have told is guessed."""
    frames = {name: part for name, part in climb.frames.items() if name != signal}
    judgement = judge(replace(climb, frames=frames))
    assert judgement.outcome == "failed"
    assert reason in judgement.reason


def test_touches_that_were_not_watched_are_not_in_favour(climb: Evidence) -> None:
    """None is not an empty list."""
    judgement = judge(replace(climb, touches=None))
    assert judgement.outcome == "failed"
    assert judgement.reason == "what the robot touched was not watched"


def test_figures_that_were_not_measured_are_none(climb: Evidence) -> None:
    """Never zero, never a guess."""
    judgement = judge(replace(climb, frames={}, activities=None))
    for name in (
        *("footsteps", "steps_climbed", "max_torque_fraction", "max_torque_joint"),
        *("torque_limit_s", "max_wanted_torque_fraction", "max_friction_ratio"),
        *("min_zmp_margin_m", "max_dcm_error_m", "com_rms_error_m", "climb_time_s"),
        *("max_foot_slip_m", "max_impact_body_weights", "min_clearance_m"),
        *("min_static_margin_m", "max_speed_fraction", "min_self_distance_m"),
    ):
        assert getattr(judgement, name) is None, name


@pytest.mark.parametrize(
    "rows", [np.r_[0 : SAMPLES - 10], np.r_[0:300, 320:SAMPLES], np.r_[20:SAMPLES]]
)
@pytest.mark.parametrize(
    ("signal", "reason"),
    [
        ("speed_monitor.peak_speeds", "the joints' speeds were not watched"),
        (
            "contact_monitor.other_support",
            "what others than the soles bore was not watched",
        ),
    ],
)
def test_a_signal_with_a_gap_is_not_in_favour(climb, signal, reason, rows) -> None:
    """At the end, in the middle, at the start."""
    frames = {**climb.frames, signal: climb.frames[signal].iloc[rows]}
    judgement = judge(replace(climb, frames=frames))
    assert (judgement.outcome, judgement.reason) == ("failed", reason)


def test_a_support_that_is_not_a_number_is_not_in_favour(climb: Evidence) -> None:
    """It is no more than a tenth, but no less either."""
    support = np.zeros((SAMPLES, 1))
    support[300] = np.nan
    judgement = judge(with_frame(climb, "contact_monitor.other_support", support))
    assert judgement.outcome == "failed"
    assert judgement.reason == "what others than the soles bore was not watched"


def test_loads_that_end_early_are_not_in_favour(climb: Evidence) -> None:
    """Their last value is not taken for what came after."""
    loads = climb.frames["station.foot_wrenches"].iloc[:-10]
    judgement = judge(
        replace(climb, frames={**climb.frames, "station.foot_wrenches": loads})
    )
    assert judgement.outcome == "failed"
    assert "what the left sole bears was not measured" in judgement.reason


REST = {
    "a sole 6 mm above": (
        lambda e: with_sole(e, "left", moved(z=0.006)),
        "the left sole is not flat on the top tread (corners 6 to 6 mm above it)",
    ),
    "a sole 4 mm in it": (
        lambda e: with_sole(e, "right", moved(z=-0.004)),
        "the right sole is not flat on the top tread (corners -4 to -4 mm above it)",
    ),
    "a heel lifted by 9 mm": (
        lambda e: with_sole(
            e, "left", RigidTransform(RollPitchYaw(0.0, 0.06, 0.0), [0, 0, 0.006])
        ),
        "the left sole is not flat on the top tread (corners -3 to 10 mm above it)",
    ),
    "a sole two fifths beyond the edge": (
        lambda e: with_sole(e, "right", moved(x=-0.12)),
        "the right sole is not on the top tread (58 % of it)",
    ),
    "a sole inside the other": (
        lambda e: with_motion(
            with_sole(e, "left", moved(y=-0.13)), com=put(-0.07, LAST, 1)
        ),
        "one sole is inside the other",
    ),
    "a sole that bears 9 %": (
        lambda e: replace(
            e,
            frames={
                **e.frames,
                "station.foot_wrenches": wrenches(
                    [0.5, 0.0, 0.5, 0.0, 1.0, 0.5, 0.09],
                    [0.5, 1.0, 0.5, 1.0, 0.0, 0.5, 0.91],
                ),
            },
        ),
        "the left sole bears 9 % of the weight alone",
    ),
    "a torso that leans by 16 deg": (
        lambda e: with_motion(e, torso_up=put(np.cos(np.deg2rad(16.0)))),
        "the torso leans by 16 deg",
    ),
    "a CoM 1.5 cm inside the heels": (
        lambda e: with_motion(e, com=put(0.67 - 0.06, LAST, 0)),
        "the DCM is 15 mm inside the support",
    ),
    "a CoM outside": (
        lambda e: with_motion(e, com=put(-0.2, LAST, 1)),
        "the DCM is -58 mm inside the support",
    ),
    "a CoM that moves at 2.5 cm/s": (
        lambda e: with_motion(e, com_velocity=put(0.025, LAST, 2)),
        "the CoM moves at 2.5 cm/s",
    ),
    "a pose that is not a number": (
        lambda e: with_motion(e, torso_up=put(np.nan)),
        "the torso leans by nan deg",
    ),
}


@pytest.mark.parametrize("case", REST)
def test_what_is_no_rest_is_not_completed(climb: Evidence, case: str) -> None:
    """Whatever the executive says; each of the conditions alone."""
    alter, reason = REST[case]
    judgement = judge(alter(climb))
    assert judgement.outcome == "failed"
    rest, *others = judgement.reason.split("; ")
    assert rest == f"the robot did not come to rest: {reason}"
    assert all("slid by" in other for other in others)


@pytest.mark.parametrize(
    "alter",
    [
        lambda e: with_sole(e, "left", moved(z=0.0049)),
        lambda e: with_sole(e, "right", moved(z=-0.0029)),
        lambda e: with_motion(e, torso_up=put(np.cos(np.deg2rad(14.0)))),
        lambda e: with_motion(e, com=put(0.67 - 0.054, LAST, 0)),
        lambda e: with_motion(e, com_velocity=put(0.019, LAST, 2)),
        # The heel overhangs by a fifth; the DCM is 3 cm inside what is left.
        lambda e: with_motion(overhanging(e, 0.07), com=put(0.60, LAST, 0)),
    ],
)
def test_what_is_just_rest_is_completed(climb: Evidence, alter) -> None:
    """The bounds are where they are said to be."""
    judgement = judge(alter(climb))
    assert judgement.outcome == "completed", judgement.reason


def test_an_overhanging_part_supports_nothing(climb: Evidence) -> None:
    """The DCM 1 cm from the edge of the tread, 5 cm from the heels, is not inside."""
    back = TREAD_FRONT + 0.01
    judgement = judge(with_motion(overhanging(climb, 0.065), com=put(back, LAST, 0)))
    assert judgement.outcome == "failed"
    assert "the DCM is 10 mm inside the support" in judgement.reason


def test_the_dcm_counts_and_not_the_com_alone(climb: Evidence) -> None:
    """At 1.9 cm/s the DCM is v / omega = 5.4 mm ahead: 1.6 cm are not enough."""
    edge = 0.67 - 0.075
    com = with_motion(climb, com=put(edge + 0.0215, LAST, 0))
    assert judge(com).outcome == "completed"
    judgement = judge(with_motion(com, com_velocity=put(-0.019, LAST, 0)))
    assert judgement.outcome == "failed"
    assert "the DCM is 16 mm inside the support" in judgement.reason


def test_rest_lasts_a_second_on_end(climb: Evidence) -> None:
    """A moment of unrest within it, or a record with a gap, is none."""
    moment = slice(-50, -49)
    judgement = judge(with_motion(climb, com_velocity=put(0.05, moment, 0)))
    assert judgement.outcome == "failed"
    before = slice(-110, -105)
    assert judge(with_motion(climb, com_velocity=put(0.05, before, 0))).outcome == (
        "completed"
    )


@pytest.mark.parametrize(
    ("rows", "reason"),
    [
        (np.r_[640:SAMPLES], "it was not watched for 1 s"),
        (np.r_[0:640, 690:SAMPLES], "its last 1 s were not all recorded"),
    ],
)
def test_a_second_that_was_not_recorded_is_not_in_favour(climb, rows, reason) -> None:
    """Neither a run of 0.8 s nor one with half a second missing."""
    judgement = judge(replace(climb, motion=picked(climb.motion, rows)))
    assert judgement.outcome == "failed"
    assert reason in judgement.reason


def picked(motion: TrueMotion, rows: Vector) -> TrueMotion:
    """Some of the samples."""
    return TrueMotion(
        time=motion.time[rows],
        com=motion.com[rows],
        com_velocity=motion.com_velocity[rows],
        base=motion.base[rows],
        torso_up=motion.torso_up[rows],
        sole_corners={foot: motion.sole_corners[foot][rows] for foot in FEET},
        X_WF={foot: motion.X_WF[foot][rows] for foot in FEET},
    )


def test_finished_beside_the_top_is_not_completed(climb: Evidence) -> None:
    """The executive may believe what it likes."""
    motion = motion_of(LEFT, [*RIGHT[:-1], "step 1"])
    judgement = judge(replace(climb, motion=motion))
    assert judgement.outcome == "failed"
    assert "the right sole is not flat on the top tread" in judgement.reason
    assert judgement.steps_climbed == 2


def test_a_joint_beyond_its_speed_limit_fails(climb: Evidence) -> None:
    """Seen at a step of the plant that the log of the state does not hold."""
    peaks = np.tile([1.0, 6.0], (SAMPLES, 1))
    peaks[300:, 0] = 10.1
    judgement = judge(with_frame(climb, "speed_monitor.peak_speeds", peaks))
    assert judgement.outcome == "failed"
    assert judgement.reason == "HIP went at 1.01 times its speed limit"


def test_a_speed_that_is_not_a_number_fails(climb: Evidence) -> None:
    """It is not below the limit."""
    peaks = np.tile([1.0, np.nan], (SAMPLES, 1))
    judgement = judge(with_frame(climb, "speed_monitor.peak_speeds", peaks))
    assert judgement.outcome == "failed"
    assert judgement.reason.startswith("KNEE went at nan times its speed limit")


@pytest.mark.parametrize(
    ("body", "met"),
    [
        ("R_KNEE_S", "staircase/step_2"),
        ("L_ANKLE_P_S", "box/trunk"),
        ("L_KNEE_S", "R_KNEE_S"),
    ],
)
def test_a_touch_fails(climb: Evidence, body: str, met: str) -> None:
    """With the stairs, with a box that stands about, with itself; the pair is named."""
    touch = Touch(body, met, 0.014, 35.2)
    judgement = judge(replace(climb, touches=(touch,)))
    assert judgement.outcome == "failed"
    assert judgement.reason == f"{body} touched {met} (14 ms, up to 35 N)"


def test_the_least_distance_to_itself_is_told(climb: Evidence) -> None:
    """With the two bodies."""
    near = NearestApproach(0.012, ("L_KNEE_S", "R_KNEE_S"), 3.0)
    judgement = judge(replace(climb, self_distance=near))
    assert judgement.min_self_distance_m == 0.012
    assert judgement.min_self_distance_bodies == ("L_KNEE_S", "R_KNEE_S")


def test_a_loaded_foot_that_slides_fails(climb: Evidence) -> None:
    """By more than 3 cm; over 1 cm it is mentioned."""
    slid = with_sole(climb, "left", moved(x=0.031))
    judgement = judge(slid)
    assert judgement.outcome == "failed"
    assert judgement.reason == "a loaded foot slid by 31 mm"
    judgement = judge(with_sole(climb, "left", moved(x=0.015)))
    assert judgement.outcome == "completed"
    assert judgement.max_foot_slip_m == pytest.approx(0.015)
    assert "slid by 15 mm" in judgement.reason


@pytest.mark.parametrize(
    ("stop", "outcome"),
    [
        ("fell", "fell"),
        ("infeasible", "infeasible"),
        ("time limit", "timed_out"),
        ("interrupted", "interrupted"),
        ("error", "cut"),
    ],
)
def test_every_other_stop_has_its_outcome(climb: Evidence, stop, outcome) -> None:
    """With the reason it came with, even where both feet are on top."""
    judgement = judge(replace(climb, stop=stop, stop_reason="because"))
    assert (judgement.outcome, judgement.reason) == (outcome, "because")


def test_a_run_that_did_not_finish_names_what_it_broke(climb: Evidence) -> None:
    """Beside why it stopped; where the goal is does not matter then."""
    touch = Touch("R_KNEE_S", "staircase/step_2", 0.014, 35.2)
    evidence = replace(climb, stop="time limit", stop_reason="late", touches=(touch,))
    judgement = judge(evidence)
    assert judgement.outcome == "timed_out"
    assert judgement.reason.startswith("late; besides, R_KNEE_S touched staircase/")


def test_a_run_that_did_not_finish_is_not_blamed_for_what_is_missing(climb) -> None:
    """It is no success anyway; why it stopped is what there is to say."""
    evidence = replace(climb, stop="interrupted", stop_reason="early", frames={})
    judgement = judge(replace(evidence, touches=None))
    assert (judgement.outcome, judgement.reason) == ("interrupted", "early")


@pytest.mark.parametrize("stop", ["finished", "infeasible", "time limit"])
@pytest.mark.parametrize("when", [slice(250, 260), slice(-3, None)])
@pytest.mark.parametrize(
    ("alter", "how"),
    [
        (
            lambda e, when: with_motion(e, torso_up=put(0.1, when)),
            "its torso leaned by 84 deg",
        ),
        (
            lambda e, when: with_motion(e, base=put(0.4, when, 2)),
            "its base sank to ",
        ),
        (
            lambda e, when: with_frame(
                e, "contact_monitor.other_support", bore(0.11, when)
            ),
            "something else than its soles bore 11% of its weight",
        ),
    ],
)
def test_a_fall_at_any_time_is_a_fall(climb, stop, when, alter, how) -> None:
    """By its tilt, by its height, by what bears it; even where it stands again."""
    judgement = judge(alter(replace(climb, stop=stop, stop_reason="so"), when))
    assert judgement.outcome == "fell"
    first = np.arange(SAMPLES)[when][0] * 0.01
    assert judgement.reason.startswith(f"the robot fell at {first:.2f} s: {how}")


def bore(share: float, when: slice) -> Vector:
    """What others than the soles bore, N."""
    support = np.zeros((SAMPLES, 1))
    support[when] = share * WEIGHT
    return support


def test_a_robot_that_lies_when_the_solver_gives_up_fell(climb: Evidence) -> None:
    """Both are said."""
    lying = with_motion(climb, torso_up=put(0.1, slice(-10, None)))
    judgement = judge(replace(lying, stop="error", stop_reason="boom"))
    assert judgement.outcome == "fell"
    assert judgement.reason.endswith("; boom")


def test_seconds_at_a_torque_limit(climb: Evidence) -> None:
    """Of any joint, and which most often; the plant clips what was wanted."""
    torque = np.zeros((SAMPLES, 2))
    torque[100:130, 0], torque[120:140, 1] = 100.0, -100.0
    wanted = np.zeros((SAMPLES, 2))
    wanted[125] = [130.0, -170.0]
    evidence = with_frame(climb, "plant.net_actuation", torque)
    judgement = judge(with_frame(evidence, "station.torque_wanted", wanted))
    assert judgement.torque_limit_s == pytest.approx(0.4)
    assert judgement.torque_limit_joint == "HIP"
    assert judgement.max_wanted_torque_fraction == pytest.approx(1.7)
    assert judgement.max_wanted_torque_joint == "KNEE"


def at_goal(climb: Evidence, dx: float = 0.0, turn: float = 0.0) -> Evidence:
    """On the floor, its feet's middle beside its goal by dx, facing past it by turn."""
    motion = motion_of(["floor"] * 7, ["floor"] * 7)
    R = RotationMatrix.MakeZRotation(np.pi - turn).matrix()
    poses, corners = {}, {}
    for foot in FEET:
        poses[foot] = motion.X_WF[foot].copy()
        poses[foot][:, :3, 3] = R @ poses[foot][0, :3, 3]
        poses[foot][:, :3, :3] = R
        corners[foot] = motion.sole_corners[foot] @ R.T
    return replace(
        climb,
        kind="room_crossing",
        motion=replace(motion, X_WF=poses, sole_corners=corners),
        goal=(dx, 0.0, -np.pi),
    )


def test_a_goal_is_reached_within_its_tolerances(climb: Evidence) -> None:
    """10 cm and 10 deg, the heading across the turn of pi.

    The staircase that stands in the room is not what was to be climbed.
    """
    assert climb.treads
    judgement = judge(at_goal(climb, 0.09, np.deg2rad(9.0)))
    assert judgement.outcome == "completed", judgement.reason
    assert judgement.reason == "the robot rests 9.0 cm from the goal"
    assert judgement.goal_error_m == pytest.approx(0.09)
    assert judgement.goal_turn_rad == pytest.approx(np.deg2rad(9.0))
    assert (judgement.steps_climbed, judgement.climb_time_s) == (None, None)


def test_a_goal_that_is_missed_is_not_reached(climb: Evidence) -> None:
    """Whatever the executive says; both faults are named."""
    judgement = judge(at_goal(climb, 0.11, np.deg2rad(-11.0)))
    assert judgement.outcome == "failed"
    assert "the robot stands 0.11 m from the goal" in judgement.reason
    assert "the robot faces 11 deg off the goal's" in judgement.reason


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"goal": None}, "its goal is not known"),
        (
            {"kind": "stair_climbing", "treads": ()},
            "there is no staircase to climb",
        ),
    ],
)
def test_a_task_without_its_goal_is_not_completed(climb, changes, reason) -> None:
    """What was to be reached is evidence too."""
    judgement = judge(replace(at_goal(climb), **changes))
    assert judgement.outcome == "failed"
    assert judgement.reason == reason


@pytest.mark.parametrize("yaw", [0.5, -2.0])
def test_a_heading_is_that_of_the_goal(climb: Evidence, yaw: float) -> None:
    """To the left is to the left: a robot that faces as it should is not off."""
    evidence = at_goal(climb, turn=np.pi - yaw)
    judgement = judge(replace(evidence, goal=(0.0, 0.0, yaw)))
    assert judgement.outcome == "completed", judgement.reason
    assert judgement.goal_turn_rad == pytest.approx(0.0, abs=1e-9)


def test_without_a_goal_there_is_no_goal_error(climb: Evidence) -> None:
    """Not zero."""
    judgement = judge(climb)
    assert (judgement.goal_error_m, judgement.goal_turn_rad) == (None, None)
