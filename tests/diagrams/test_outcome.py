"""The judge, on runs of which it is known what became of them."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from pydrake.math import RigidTransform, RotationMatrix

from diagrams.evidence import Evidence, Limits
from diagrams.outcome import has_fallen, judge
from diagrams.true_motion import TrueMotion, sole_corners_F
from models.jvrc1 import JVRC1
from models.staircase import StaircaseParams
from systems.values import FEET, Touch

WEIGHT = 600.0
TREADS = StaircaseParams(steps=2, rise=0.2, run=0.27, x=0.3).treads()
PLACES = {
    "floor": (0.0, 0.0),
    "step 1": (0.40, 0.2),
    "step 2": (0.67, 0.4),
}


def motion_of(left: list[str], right: list[str], base: float = 0.85) -> TrueMotion:
    """A robot whose feet are at these places, a sample each."""
    poses = {
        foot: np.stack(
            [
                RigidTransform(np.array([PLACES[p][0], y, PLACES[p][1]])).GetAsMatrix4()
                for p in places
            ]
        )
        for foot, places, y in (("left", left, 0.1), ("right", right, -0.1))
    }
    middle = (poses["left"][:, :3, 3] + poses["right"][:, :3, 3]) / 2.0
    count = len(left)
    corners_F = sole_corners_F(JVRC1.sole)
    return TrueMotion(
        time=np.arange(count, dtype=float),
        com=middle + np.array([0.0, 0.0, 0.8]),
        base=middle + np.array([0.0, 0.0, base]),
        torso_up=np.ones(count),
        sole_corners={
            foot: poses[foot][:, None, :3, 3] + corners_F[None] for foot in FEET
        },
        X_WF=poses,
    )


def frame(columns: np.ndarray) -> pd.DataFrame:
    """A signal sampled once a second."""
    data = np.column_stack([np.arange(len(columns), dtype=float), columns])
    return pd.DataFrame(data)


def wrenches(left: list[float], right: list[float]) -> pd.DataFrame:
    """Normal forces, in weights, at the soles' origins."""
    both = np.zeros((len(left), 12))
    both[:, 2], both[:, 8] = np.array(left) * WEIGHT, np.array(right) * WEIGHT
    return frame(both)


LEFT = ["floor", "floor", "step 1", "step 1", "step 2", "step 2", "step 2"]
RIGHT = ["floor", "floor", "floor", "floor", "floor", "step 2", "step 2"]


@pytest.fixture
def climb() -> Evidence:
    """Two steps climbed: the left foot by one, then by two, the right one follows."""
    loads = wrenches(
        [0.5, 0.0, 0.5, 0.0, 1.0, 0.5, 0.5], [0.5, 1.0, 0.5, 1.0, 0.0, 0.5, 0.5]
    )
    torque = np.zeros((7, 2))
    torque[3, 1] = -80.0
    return Evidence(
        stop="finished",
        stop_reason="at the top",
        motion=motion_of(LEFT, RIGHT),
        joint_velocities={"HIP": np.full(7, 1.0), "KNEE": np.full(7, -6.0)},
        frames={"station.foot_wrenches": loads, "plant.net_actuation": frame(torque)},
        treads=TREADS,
        limits=Limits(
            torque={"HIP": 100.0, "KNEE": 100.0},
            speed={"HIP": 10.0, "KNEE": 10.0},
            weight=WEIGHT,
        ),
        touches=(),
        activities=((0.0, "scan"), (1.0, "move"), (2.0, "scan"), (2.5, "move")),
    )


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


def test_a_step_is_climbed_by_both_feet(climb: Evidence) -> None:
    """One foot on the second tread and one on the floor have climbed none."""
    motion = motion_of(LEFT, ["floor"] * 7)
    judgement = judge(replace(climb, motion=motion, stop="time limit"))
    assert judgement.steps_climbed == 0


def test_climb_time_counts_motion_only(climb: Evidence) -> None:
    """From 1 s to the last touch-down at 5 s, without half a second of scanning."""
    assert judge(climb).climb_time_s == pytest.approx(1.0 + 2.5)


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


def test_errors_of_com_and_dcm(climb: Evidence) -> None:
    """Against the reference, the true CoM in space, the measured DCM in the plane."""
    com = climb.motion.com
    frames = {
        **climb.frames,
        "reference.com": frame(com + np.array([0.0, 0.03, 0.04])),
        "balance_state.dcm": frame(com + np.array([0.3, 0.4, 9.0])),
        "reference.dcm": frame(com),
    }
    judgement = judge(replace(climb, frames=frames))
    assert judgement.com_rms_error_m == pytest.approx(0.05)
    assert judgement.max_dcm_error_m == pytest.approx(0.5)


def test_static_margin_is_the_least_where_there_is_a_polygon(climb: Evidence) -> None:
    """A moment without any polygon has no margin."""
    margins = np.full((len(climb.motion.time), 1), 0.05)
    margins[0], margins[1] = -np.inf, -0.01
    frames = {**climb.frames, "static_stability.margin": frame(margins)}
    judgement = judge(replace(climb, frames=frames))
    assert judgement.min_static_margin_m == pytest.approx(-0.01)
    assert judge(climb).min_static_margin_m is None


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


def test_torques_of_another_number_of_joints_are_refused(climb: Evidence) -> None:
    """A column too many would be given another joint's name."""
    frames = {**climb.frames, "plant.net_actuation": frame(np.zeros((7, 3)))}
    with pytest.raises(ValueError, match="has 3 columns, expected one for each of 2"):
        judge(replace(climb, frames=frames))


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
