"""What is logged of sensors and estimate: enough to run the estimator again alone."""

from pydrake.multibody.plant import MultibodyPlant

from footfall.diagrams.closed_loop.logged_vector import (
    WRENCH,
    WRENCH_UNITS,
    XYZ,
    LoggedVector,
    both_feet,
    state_units,
)
from footfall.models.values.feet import FEET

IMU_SIGNAL = "imu.integrals"
JOINTS_SIGNAL = "joint_encoders.joints"
ANKLES_SIGNAL = "ankle_force_sensors.foot_wrenches"
ESTIMATE_SIGNAL = "base_estimator.state"
DEVIATION_SIGNAL = "base_estimator.deviation"
BEARING_SIGNAL = "contact_detector.bearing"
FOOTHOLDS_SIGNAL = "motion_player.footholds"
TOUCHING_SIGNAL = "contact_detector.touching"
BELIEVED_COM_SIGNAL = "com_observer.com"
BELIEVED_VELOCITY_SIGNAL = "believed_state.com_velocity"
FAULTS_SIGNAL = "base_estimator.faults"
_ROTATION = ("rx", "ry", "rz")
_VELOCITY = ("vx", "vy", "vz")


def estimation_signals(model: MultibodyPlant) -> list[LoggedVector]:
    """Lists sensors, contacts and estimate, each signal called as its port.

    Args:
        model: the robot alone, whose state's names the columns bear.
    """
    names = tuple(model.GetStateNames(False))
    joints = (*names[7 : model.num_positions()], *names[model.num_positions() + 6 :])
    rows = (
        (
            IMU_SIGNAL,
            ("sampled", *_ROTATION, *_VELOCITY),
            ("s", *("rad",) * 3, *("m/s",) * 3),
        ),
        (JOINTS_SIGNAL, joints, state_units(joints)),
        (ANKLES_SIGNAL, both_feet(WRENCH), WRENCH_UNITS * 2),
        (
            FOOTHOLDS_SIGNAL,
            both_feet(("nx", "ny", "nz", "distance")),
            ("1", "1", "1", "m") * 2,
        ),
        (TOUCHING_SIGNAL, FEET, "1"),
        (BEARING_SIGNAL, FEET, "1"),
        (ESTIMATE_SIGNAL, names, state_units(names)),
        (
            DEVIATION_SIGNAL,
            (*_ROTATION, *_VELOCITY, *XYZ),
            (*("rad",) * 3, *("m/s",) * 3, *("m",) * 3),
        ),
        (
            "base_estimator.biases",
            tuple(f"{name}{axis}" for name in ("gyro_", "accel_") for axis in XYZ),
            (*("rad/s",) * 3, *("m/s^2",) * 3),
        ),
        (
            FAULTS_SIGNAL,
            (*(f"{side}_slips" for side in FEET), "imu_silent"),
            ("1", "1", "s"),
        ),
        (BELIEVED_COM_SIGNAL, XYZ, "m"),
        ("com_observer.offset", ("ahead", "left"), "m"),
        (BELIEVED_VELOCITY_SIGNAL, _VELOCITY, "m/s"),
    )
    return [LoggedVector(name, name, columns, units) for name, columns, units in rows]
