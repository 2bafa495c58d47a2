"""The fastest that joints have been, at every step."""

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.speed_monitor import SpeedMonitor, actuated_velocities

PERIOD = 0.0025
MODEL = robot_alone(JVRC1)
INSTANCE = MODEL.GetBodyByName(JVRC1.base_body).model_instance()


def state(speeds: dict[str, float]) -> Vector:
    """The robot's state with some joints moving."""
    context: Context = MODEL.CreateDefaultContext()
    for joint, speed in speeds.items():
        MODEL.GetJointByName(joint).set_angular_rate(context, speed)
    return np.array(MODEL.GetPositionsAndVelocities(context, INSTANCE))


def test_the_peak_of_a_single_step_is_kept() -> None:
    """Between two samples of a log at 200 Hz, whatever its sign."""
    monitor = SpeedMonitor(MODEL, INSTANCE, PERIOD)
    simulator = Simulator(monitor)
    context = simulator.get_mutable_context()
    port = monitor.GetInputPort("state")
    for tick, speed in enumerate([0.0, 1.0, -9.0, 2.0, 0.0]):
        port.FixValue(context, state({"R_KNEE": speed, "L_HIP_P": 0.5}))
        simulator.AdvanceTo((tick + 0.5) * PERIOD)
    peaks = eval_vector(monitor.GetOutputPort("peak_speeds"), context)
    names = list(MODEL.GetActuatorNames(INSTANCE, False))
    assert peaks[names.index("R_KNEE")] == 9.0
    assert peaks[names.index("L_HIP_P")] == 0.5
    assert np.count_nonzero(peaks) == 2


def test_what_is_not_a_number_stays() -> None:
    """A later number does not hide it."""
    monitor = SpeedMonitor(MODEL, INSTANCE, PERIOD)
    simulator = Simulator(monitor)
    context = simulator.get_mutable_context()
    for tick, speed in enumerate([np.nan, 1.0]):
        monitor.GetInputPort("state").FixValue(context, state({"R_KNEE": speed}))
        simulator.AdvanceTo((tick + 0.5) * PERIOD)
    peaks = eval_vector(monitor.GetOutputPort("peak_speeds"), context)
    assert np.isnan(peaks).sum() == 1


def test_velocities_are_found_by_name() -> None:
    """Those of the state's second half, in the order of the actuators."""
    columns = actuated_velocities(MODEL, INSTANCE)
    names = list(MODEL.GetActuatorNames(INSTANCE, False))
    moving = state({"L_WRIST_Y": -0.25})[columns]
    assert moving[names.index("L_WRIST_Y")] == -0.25
    assert np.count_nonzero(moving) == 1


def test_period_must_be_positive() -> None:
    """It is the plant's step."""
    with pytest.raises(ValueError, match=r"period: must be positive, got 0\.0 s"):
        SpeedMonitor(MODEL, INSTANCE, 0.0)
