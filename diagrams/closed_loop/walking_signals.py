"""The signals that every walking task logs."""

from footfall.diagrams.closed_loop.estimation_signals import estimation_signals
from footfall.diagrams.closed_loop.joint_limits import joint_limits
from footfall.diagrams.closed_loop.logged_vector import (
    WRENCH,
    WRENCH_UNITS,
    XYZ,
    LoggedVector,
    both_feet,
    state_units,
)
from footfall.diagrams.closed_loop.loop_builder import (
    SIGNAL_PERIOD,
    VALUE_PERIOD,
    LoopBuilder,
)
from footfall.diagrams.closed_loop.robot_station import RobotStation
from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.signal_names import MOVERS_SIGNAL, POLYGON_SIGNAL, STATE_SIGNAL
from footfall.models.values.feet import FEET

_POSE = (*XYZ, "roll", "pitch", "yaw")
_POSE_UNITS = ("m",) * 3 + ("rad",) * 3


_CONTACTS = (*both_feet(("contact",)), *both_feet(("carrying_length",)))
_CONTACT_UNITS = ("1", "1", "m", "m")
WALKING = (
    LoggedVector(
        "station.foot_wrenches",
        "foot_wrench_sensor.foot_wrenches",
        both_feet(WRENCH),
        WRENCH_UNITS * 2,
    ),
    LoggedVector("balance_state.zmp", "foot_wrench_sensor.zmp", XYZ, "m"),
    LoggedVector(
        "stabilizer.foot_wrenches",
        "stabilizer.foot_wrenches",
        both_feet(WRENCH),
        WRENCH_UNITS * 2,
    ),
    LoggedVector("balance_state.com", "kinematic_state.com", XYZ, "m"),
    LoggedVector("balance_state.dcm", "stabilizer.dcm", XYZ[:2], "m"),
    LoggedVector(
        "reference.com",
        "com_reference.com_reference",
        tuple(f"{name}{axis}" for name in ("", "v", "a") for axis in XYZ),
        ("m",) * 3 + ("m/s",) * 3 + ("m/s^2",) * 3,
    ),
    LoggedVector("reference.dcm", "stabilizer.dcm_reference", XYZ[:2], "m"),
    LoggedVector("reference.zmp", "motion_player.zmp", XYZ, "m"),
    LoggedVector("stabilizer.zmp_command", "stabilizer.zmp_command", XYZ[:2], "m"),
    LoggedVector(
        "feet.true", "kinematic_state.foot_poses", both_feet(_POSE), _POSE_UNITS * 2
    ),
    LoggedVector(
        "feet.wanted",
        "landing_adaptor.foot_references",
        both_feet(_POSE) + both_feet(tuple(f"{name}_rate" for name in _POSE)),
        _POSE_UNITS * 2 + (("m/s",) * 3 + ("rad/s",) * 3) * 2,
    ),
    LoggedVector(
        "motion_player.contacts", "motion_player.contacts", _CONTACTS, _CONTACT_UNITS
    ),
    LoggedVector(
        "landing_adaptor.contacts",
        "landing_adaptor.contacts",
        _CONTACTS,
        _CONTACT_UNITS,
    ),
    LoggedVector(
        "static_stability.margin", "static_stability.margin", ("margin",), "m"
    ),
    LoggedVector(
        "contact_monitor.foot_forces",
        "contact_monitor.foot_forces",
        both_feet(("fx", "fy", "fz")),
        "N",
    ),
    LoggedVector(
        "contact_monitor.other_support", "contact_monitor.other_support", ("fz",), "N"
    ),
    LoggedVector("contact_monitor.impact", "contact_monitor.impact", FEET, "N"),
    LoggedVector(
        "contact_monitor.friction_ratio",
        "contact_monitor.friction_ratio",
        ("ratio",),
        "1",
    ),
)
"""What balance and tracking do, and what the feet truly meet."""


def log_walking(loop: LoopBuilder, setup: Setup, true: RobotStation) -> None:
    """Logs state, torques, wrenches, CoM, DCM, ZMP, feet, contacts and decisions.

    Of a part that a user has replaced the ports that it does not have are left out.

    Args:
        loop: the closed loop.
        setup: its robot.
        true: the plant, whose names the columns bear.
    """
    signals = loop.signals
    estimation = estimation_signals(setup.model)
    limits = joint_limits(true.plant, true.instance)
    for name, port, columns, units in (*_plant_signals(true), *WALKING, *estimation):
        if (output := loop.find_output(port)) is not None:
            every = (units,) * len(columns) if isinstance(units, str) else units
            within = limits.of_columns(columns, every)
            signals.add_vector(name, output, columns, every, SIGNAL_PERIOD, within)
    loop.log("contact_monitor.touches")
    if (polygon := loop.find_output(POLYGON_SIGNAL)) is not None:
        signals.add_value(POLYGON_SIGNAL, polygon, VALUE_PERIOD, keep=False)
    for port in ("status", "footstep_plan"):
        loop.log(f"planning.{port}", name=f"executive.{port}")


def _plant_signals(true: RobotStation) -> list[LoggedVector]:
    """Names the signals of the plant and of its joints, after the robot in it."""
    plant, instance = true.plant, true.instance
    joints = tuple(plant.GetActuatorNames(instance, False))
    state = plant.get_state_output_port(instance).get_name()
    actuation = plant.get_net_actuation_output_port(instance).get_name()
    names = plant.GetStateNames(instance, False)
    signals = [
        LoggedVector(STATE_SIGNAL, f"plant.{state}", tuple(names), state_units(names)),
        LoggedVector("plant.net_actuation", f"plant.{actuation}", joints, "N m"),
        LoggedVector("station.torque_command", "torque_hold.y", joints, "N m"),
        LoggedVector(
            "station.torque_wanted", "wanted_torque.torque_wanted", joints, "N m"
        ),
        LoggedVector(
            "speed_monitor.peak_speeds", "speed_monitor.peak_speeds", joints, "rad/s"
        ),
    ]
    if plant.num_positions(true.movers):
        names = plant.GetStateNames(true.movers, False)
        half = len(names) // 2
        movers = plant.get_state_output_port(true.movers).get_name()
        units = ("m",) * half + ("m/s",) * half
        signals.append(
            LoggedVector(MOVERS_SIGNAL, f"plant.{movers}", tuple(names), units)
        )
    return signals
