"""Every signal that a run logs has a frame."""

from footfall.diagrams.closed_loop.estimation_signals import estimation_signals
from footfall.diagrams.closed_loop.walking_signals import WALKING
from footfall.diagrams.signal_frames import SIGNAL_FRAMES, frame_of
from footfall.diagrams.signal_names import MOVERS_SIGNAL, STATE_SIGNAL
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone

PLANT = (
    *(STATE_SIGNAL, MOVERS_SIGNAL, "plant.net_actuation", "station.torque_command"),
    *("station.torque_wanted", "speed_monitor.peak_speeds"),
)
"""Those that bear the names of the robot's joints."""


def test_every_logged_signal_has_a_frame() -> None:
    """And none has one that is not logged."""
    walking = {one.name for one in WALKING}
    estimation = {one.name for one in estimation_signals(robot_alone(JVRC1))}
    assert set(SIGNAL_FRAMES) == {*PLANT, *walking, *estimation}
    assert all(SIGNAL_FRAMES.values())


def test_a_signal_of_the_users_has_none() -> None:
    """Nobody knows."""
    assert frame_of("mine.y") == ""
    assert frame_of("balance_state.com") == "W, true"
