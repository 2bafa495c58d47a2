"""Joint limits by the columns of signals, and that a run's files have them."""

import pyarrow.parquet as pq
import pytest

from footfall.diagrams.closed_loop.joint_limits import JointLimits
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.simulation import run_task
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone

LIMITS = JointLimits(
    {"knee": (-0.1, 2.0)}, {"knee": (-9.0, 9.0)}, {"knee": (-1.0, 1.0)}
)


@pytest.fixture(scope="module")
def stood(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """A robot that stands for a moment."""
    scenario = load_scenario("stand", ["task.stand_time=0.1"])
    folder = tmp_path_factory.mktemp("stood") / "run"
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


def test_a_column_has_the_limits_of_its_unit() -> None:
    """Columns of no joint have none."""
    columns, units = ("knee_q", "knee_w", "base_x"), ("rad", "rad/s", "m")
    assert LIMITS.of_columns(columns, units) == {
        "knee_q": (-0.1, 2.0),
        "knee_w": (-9.0, 9.0),
    }
    assert LIMITS.of_columns(("knee", "left_mx"), ("N m", "N m")) == {
        "knee": (-1.0, 1.0)
    }


def test_every_joint_of_a_run_has_its_limits(stood: Run) -> None:
    """Of the robot's description: angle, speed and torque, wherever they are logged."""
    plant = robot_alone(JVRC1)
    for name in ("plant.state", "base_estimator.state", "joint_encoders.joints"):
        limits = stood.signals[name].attrs["limits"]
        for index in plant.GetJointActuatorIndices():
            joint = plant.get_joint_actuator(index).joint()
            assert limits[f"{joint.name()}_q"] == (
                joint.position_lower_limits()[0],
                joint.position_upper_limits()[0],
            )
            assert limits[f"{joint.name()}_w"][1] == joint.velocity_upper_limits()[0]
        assert "PELVIS_S_qw" not in limits
    for name in ("plant.net_actuation", "station.torque_wanted"):
        frame = stood.signals[name]
        assert set(frame.attrs["limits"]) == set(frame.columns) - {"time"}
        assert frame.attrs["limits"]["R_KNEE"] == (-100.0, 100.0)
    assert stood.signals["balance_state.com"].attrs["limits"] == {}


def test_the_file_itself_says_so(stood: Run) -> None:
    """For who reads it without us."""
    file = stood.folder / "signals" / "plant.net_actuation.parquet"
    field = pq.read_schema(file).field("R_KNEE")
    assert field.metadata == {
        b"unit": b"N m",
        b"lower_limit": b"-100.0",
        b"upper_limit": b"100.0",
    }
