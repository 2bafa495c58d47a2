"""The judge, on runs of which it is known what became of them."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.math import RotationMatrix

from diagrams.evidence import Evidence
from diagrams.outcome import has_fallen, judge
from systems.values import FEET, Touch
from tests.diagrams.climb_evidence import LEFT, RIGHT, motion_of


def test_a_climb_is_completed_and_counted(climb: Evidence) -> None:
    """Three footsteps, two steps, the limits' shares with the joints' names."""
    judgement = judge(climb)
    assert (judgement.outcome, judgement.steps_climbed) == ("completed", 2)
    assert "both feet rest on the top tread, number 2" in judgement.reason
    assert judgement.footsteps == 3
    assert (judgement.max_torque_fraction, judgement.max_torque_joint) == (0.8, "KNEE")
    assert (judgement.max_speed_fraction, judgement.max_speed_joint) == (0.6, "KNEE")
    assert judgement.max_impact_body_weights == pytest.approx(1.0)
    assert judgement.max_foot_slip_m == 0.0
    assert judgement.min_zmp_margin_m == pytest.approx(0.042)


def test_what_was_not_measured_is_none(climb: Evidence) -> None:
    """Never zero, never a guess; the outcome needs the state alone."""
    judgement = judge(replace(climb, frames={}, activities=None))
    assert judgement.outcome == "completed"
    for name in (
        *("footsteps", "steps_climbed", "max_torque_fraction", "max_torque_joint"),
        *("min_zmp_margin_m", "max_dcm_error_m", "com_rms_error_m", "climb_time_s"),
        *("max_foot_slip_m", "max_impact_body_weights", "min_clearance_m"),
    ):
        assert getattr(judgement, name) is None, name


def test_finished_beside_the_top_is_not_completed(climb: Evidence) -> None:
    """The executive may believe what it likes."""
    motion = motion_of(LEFT, [*RIGHT[:-1], "step 1"])
    judgement = judge(replace(climb, motion=motion))
    assert judgement.outcome == "infeasible"
    assert judgement.reason == "the right sole is not on the top tread"
    assert judgement.steps_climbed == 2


def test_a_joint_beyond_its_speed_limit_is_not_completed(climb: Evidence) -> None:
    """It is named."""
    velocities = {**climb.joint_velocities, "HIP": np.array([0.0, -10.1] + [0.0] * 5)}
    judgement = judge(replace(climb, joint_velocities=velocities))
    assert judgement.outcome == "infeasible"
    assert judgement.reason == "HIP went at 1.01 times its speed limit"


def test_a_shin_on_a_nosing_is_not_completed(climb: Evidence) -> None:
    """The pair is named."""
    touch = Touch("R_KNEE_S", "staircase/step_2", 0.014, 35.2)
    judgement = judge(replace(climb, touches=(touch,)))
    assert judgement.outcome == "infeasible"
    assert judgement.reason == "R_KNEE_S touched staircase/step_2 (14 ms, up to 35 N)"


@pytest.mark.parametrize(
    ("stop", "outcome"),
    [
        ("fell", "fell"),
        ("infeasible", "infeasible"),
        ("time limit", "timed_out"),
        ("interrupted", "timed_out"),
        ("error", "timed_out"),
    ],
)
def test_every_other_stop_has_its_outcome(climb: Evidence, stop, outcome) -> None:
    """With the reason it came with, even where both feet are on top."""
    judgement = judge(replace(climb, stop=stop, stop_reason="because"))
    assert (judgement.outcome, judgement.reason) == (outcome, "because")


def test_a_robot_that_lies_at_the_end_fell(climb: Evidence) -> None:
    """Whatever stopped the run."""
    lying = replace(climb.motion, torso_up=np.array([1.0] * 6 + [0.1]))
    judgement = judge(replace(climb, motion=lying, stop="error", stop_reason="boom"))
    assert judgement.outcome == "fell"
    assert judgement.reason == "the robot fell at 6.00 s; boom"


def test_has_fallen_by_height_or_by_tilt() -> None:
    """Climbing raises both base and feet: only the height between them counts."""
    assert not has_fallen(0.8, 0.85, 1.0)
    assert has_fallen(0.5, 0.85, 1.0)
    assert has_fallen(0.8, 0.85, 0.49)
    assert not has_fallen(0.8, 0.85, 0.51)


def test_slip_is_mentioned(climb: Evidence) -> None:
    """A completed climb with a slip over a centimetre says so."""
    corners = climb.motion.sole_corners["left"].copy()
    corners[-1, :, 0] += 0.015
    motion = replace(
        climb.motion, sole_corners={**climb.motion.sole_corners, "left": corners}
    )
    judgement = judge(replace(climb, motion=motion))
    assert judgement.outcome == "completed"
    assert judgement.max_foot_slip_m == pytest.approx(0.015)
    assert "slid by 15 mm" in judgement.reason


def at_goal(climb: Evidence, dx: float = 0.0, turn: float = 0.0) -> Evidence:
    """On the floor, its feet's middle beside its goal by dx, facing past it by turn."""
    motion = motion_of(["floor"] * 7, ["floor"] * 7)
    R = RotationMatrix.MakeZRotation(np.pi - turn).matrix()
    poses = {}
    for foot in FEET:
        poses[foot] = motion.X_WF[foot].copy()
        poses[foot][:, :3, 3] = R @ poses[foot][0, :3, 3]
        poses[foot][:, :3, :3] = R
    return replace(
        climb, treads=(), motion=replace(motion, X_WF=poses), goal=(dx, 0.0, -np.pi)
    )


def test_a_goal_is_reached_within_its_tolerances(climb: Evidence) -> None:
    """10 cm and 10 deg, the heading across the turn of pi."""
    slow = replace(climb, joint_velocities={"HIP": np.full(7, 1.0)})
    judgement = judge(at_goal(slow, 0.09, np.deg2rad(9.0)))
    assert judgement.outcome == "completed"
    assert judgement.reason.startswith("the robot stands 9.0 cm from the goal")
    assert judgement.goal_error_m == pytest.approx(0.09)
    assert judgement.goal_turn_rad == pytest.approx(np.deg2rad(9.0))
    assert judgement.steps_climbed is None


def test_a_goal_that_is_missed_is_not_reached(climb: Evidence) -> None:
    """Whatever the executive says; both faults are named."""
    judgement = judge(at_goal(climb, 0.11, np.deg2rad(-11.0)))
    assert judgement.outcome == "infeasible"
    assert "the robot stands 0.11 m from the goal" in judgement.reason
    assert "the robot faces 11 deg off the goal's" in judgement.reason


def test_without_a_goal_there_is_no_goal_error(climb: Evidence) -> None:
    """Not zero."""
    judgement = judge(climb)
    assert (judgement.goal_error_m, judgement.goal_turn_rad) == (None, None)
