"""The signals that every walking task logs."""

from pydrake.systems.framework import DiagramBuilder, OutputPort, System

from footfall.diagrams.closed_loop.station import Station
from footfall.diagrams.closed_loop.walking import Walking
from footfall.diagrams.signal_names import POLYGON_SIGNAL, STATE_SIGNAL
from footfall.diagrams.signals import SignalRecorder

SIGNAL_PERIOD = 0.005
"""Between samples of vector signals, s."""
VALUE_PERIOD = 0.025
"""Between looks at abstract signals, s."""

_SIDES = ("left", "right")
_XYZ = ("x", "y", "z")


def _columns(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{side}_{name}" for side in _SIDES for name in names)


def record_walking(
    builder: DiagramBuilder, station: Station, walking: Walking, executive: System
) -> SignalRecorder:
    """Logs state, torques, wrenches, CoM, DCM, ZMP, feet, contacts and decisions.

    Args:
        builder: of the diagram.
        station: robot and scene.
        walking: the controllers.
        executive: what decides on their plans.

    Returns:
        The recorder, to which a task adds its own signals.
    """
    recorder = SignalRecorder(builder)
    plant, instance = station.plant, station.instance

    def add(
        name: str,
        port: OutputPort,
        columns: tuple[str, ...],
        units: tuple[str, ...] | str,
    ) -> None:
        recorder.add_vector(name, port, columns, units, SIGNAL_PERIOD)

    state_names = plant.GetStateNames(instance, False)
    add(
        STATE_SIGNAL,
        station.joint_state,
        tuple(state_names),
        _state_units(state_names),
    )
    joints = tuple(plant.GetActuatorNames(instance, False))
    add(
        "plant.net_actuation",
        plant.get_net_actuation_output_port(instance),
        joints,
        "N m",
    )
    add("station.torque_command", station.torque.get_output_port(), joints, "N m")
    wanted = station.wanted_torque.GetOutputPort("torque_wanted")
    add("station.torque_wanted", wanted, joints, "N m")
    _record_truth(recorder, station, joints)

    wrench = ("fx", "fy", "fz", "mx", "my", "mz")
    units = ("N",) * 3 + ("N m",) * 3
    sensor = station.wrench_sensor
    add(
        "station.foot_wrenches",
        sensor.GetOutputPort("foot_wrenches"),
        _columns(wrench),
        units * 2,
    )
    add("balance_state.zmp", sensor.GetOutputPort("zmp"), _XYZ, "m")
    stabilizer = walking.stabilizer
    add(
        "stabilizer.foot_wrenches",
        stabilizer.GetOutputPort("foot_wrenches"),
        _columns(wrench),
        units * 2,
    )

    kinematics = station.kinematics
    add("balance_state.com", kinematics.GetOutputPort("com"), _XYZ, "m")
    add("balance_state.dcm", stabilizer.GetOutputPort("dcm"), _XYZ[:2], "m")
    com_columns = tuple(
        f"{name}{axis}" for name in ("", "v", "a") for axis in ("x", "y", "z")
    )
    add(
        "reference.com",
        walking.com_reference,
        com_columns,
        ("m",) * 3 + ("m/s",) * 3 + ("m/s^2",) * 3,
    )
    add("reference.dcm", stabilizer.GetOutputPort("dcm_reference"), _XYZ[:2], "m")
    add("reference.zmp", walking.player.GetOutputPort("zmp"), _XYZ, "m")
    add(
        "stabilizer.zmp_command",
        stabilizer.GetOutputPort("zmp_command"),
        _XYZ[:2],
        "m",
    )

    pose = (*_XYZ, "roll", "pitch", "yaw")
    pose_units = ("m",) * 3 + ("rad",) * 3
    add(
        "feet.true",
        kinematics.GetOutputPort("foot_poses"),
        _columns(pose),
        pose_units * 2,
    )
    rates = tuple(f"{name}_rate" for name in pose)
    rate_units = ("m/s",) * 3 + ("rad/s",) * 3
    add(
        "feet.wanted",
        walking.landing.GetOutputPort("foot_references"),
        _columns(pose) + _columns(rates),
        pose_units * 2 + rate_units * 2,
    )
    contact_columns = (*_columns(("contact",)), *_columns(("carrying_length",)))
    for name, source in (
        ("motion_player.contacts", walking.player),
        ("landing_adaptor.contacts", walking.landing),
    ):
        add(
            name,
            source.GetOutputPort("contacts"),
            contact_columns,
            ("1", "1", "m", "m"),
        )
    add(
        "static_stability.margin",
        walking.stability.GetOutputPort("margin"),
        ("margin",),
        "m",
    )
    recorder.add_value(
        POLYGON_SIGNAL,
        walking.stability.GetOutputPort("polygon"),
        VALUE_PERIOD,
        keep=False,
    )
    for port in ("status", "footstep_plan"):
        recorder.add_value(
            f"executive.{port}", executive.GetOutputPort(port), VALUE_PERIOD
        )
    return recorder


def _record_truth(
    recorder: SignalRecorder, station: Station, joints: tuple[str, ...]
) -> None:
    """Logs what watches every step of the plant."""
    monitor = station.contact_monitor
    for port, columns, unit in (
        ("foot_forces", _columns(("fx", "fy", "fz")), "N"),
        ("other_support", ("fz",), "N"),
        ("impact", _SIDES, "N"),
        ("friction_ratio", ("ratio",), "1"),
    ):
        recorder.add_vector(
            f"contact_monitor.{port}",
            monitor.GetOutputPort(port),
            columns,
            unit,
            SIGNAL_PERIOD,
        )
    recorder.add_vector(
        "speed_monitor.peak_speeds",
        station.speed_monitor.GetOutputPort("peak_speeds"),
        joints,
        "rad/s",
        SIGNAL_PERIOD,
    )
    recorder.add_value(
        "contact_monitor.touches", monitor.GetOutputPort("touches"), VALUE_PERIOD
    )


def _state_units(names: list[str]) -> tuple[str, ...]:
    """Units of the plant's state by the suffixes that Drake gives its elements."""
    units = {
        "qw": "1",
        "qx": "1",
        "qy": "1",
        "qz": "1",
        "x": "m",
        "y": "m",
        "z": "m",
        "q": "rad",
        "w": "rad/s",
        "wx": "rad/s",
        "wy": "rad/s",
        "wz": "rad/s",
        "vx": "m/s",
        "vy": "m/s",
        "vz": "m/s",
    }
    return tuple(units[name.rpartition("_")[2]] for name in names)
