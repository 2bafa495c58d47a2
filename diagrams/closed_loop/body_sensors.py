"""What the robot feels of itself: pelvis, joints and ankles, as sensors tell it."""

from dataclasses import replace

from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.sensors import Accelerometer, Gyroscope

from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import StationBuilder
from footfall.systems.sensing.ankle_force_sensors import AnkleForceSensors
from footfall.systems.sensing.imu import Imu
from footfall.systems.sensing.joint_encoders import JointEncoders

BODY_SIGNALS = (
    ("imu", "imu.integrals"),
    ("joints", "joint_encoders.joints"),
    ("ankle_wrenches", "ankle_force_sensors.foot_wrenches"),
)
"""What the station of the robot gives of them, and which port that is."""


def add_body_sensors(
    station: StationBuilder,
    setup: Setup,
    plant: MultibodyPlant,
    instance: ModelInstanceIndex,
) -> None:
    """Adds the sensors, which read the true plant at its every step.

    Parts: `accelerometer`, `gyroscope`, `imu`, `joint_encoders`, `ankle_force_sensors`.

    Args:
        station: of the robot; has its `plant`.
        setup: scenario and robot.
        plant: finalised.
        instance: the robot in it.
    """
    sensors, robot = setup.scenario.sensors, setup.robot
    step, seed = setup.scenario.simulation.time_step, setup.scenario.simulation.seed
    pelvis = plant.GetBodyByName(robot.base_body, instance)
    gravity = plant.gravity_field().gravity_vector()
    station.add(
        "accelerometer", lambda: Accelerometer(pelvis, RigidTransform(), gravity)
    )
    station.add("gyroscope", lambda: Gyroscope(pelvis, RigidTransform()))
    imu = replace(sensors.imu, seed=sensors.imu.seed + seed)
    station.add("imu", lambda: Imu(imu, step))
    names = plant.GetPositionNames(instance, False, False)[7:]
    station.add(
        "joint_encoders",
        lambda: JointEncoders(
            sensors.encoders,
            step,
            names,
            setup.stand.positions[7:],
            plant.num_multibody_states(instance),
        ),
    )
    ankles = replace(sensors.ankles, seed=sensors.ankles.seed + seed)
    station.add(
        "ankle_force_sensors",
        lambda: AnkleForceSensors(ankles, step, plant, instance, robot),
    )
    for sensor in ("accelerometer", "gyroscope"):
        station.connect("plant.body_poses", f"{sensor}.body_poses")
        velocities = f"{sensor}.body_spatial_velocities"
        station.connect("plant.body_spatial_velocities", velocities)
    station.connect(
        "plant.body_spatial_accelerations", "accelerometer.body_spatial_accelerations"
    )
    station.connect("accelerometer.measurement", "imu.specific_force")
    station.connect("gyroscope.measurement", "imu.angular_rate")
    state = plant.get_state_output_port(instance).get_name()
    station.connect(f"plant.{state}", "joint_encoders.state")
    station.connect("plant.reaction_forces", "ankle_force_sensors.reaction_forces")
