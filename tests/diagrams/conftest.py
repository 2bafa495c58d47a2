"""A task that any machine can run in a second: the robot stands, a clock ends it."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from pydrake.common.value import Value
from pydrake.math import RigidTransform
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.systems.framework import Context, DiagramBuilder, LeafSystem
from pydrake.systems.primitives import ConstantVectorSource

from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.judge.evidence import Evidence, robot_limits
from footfall.diagrams.scenario import Scenario, SimulationParams, load_scenario
from footfall.diagrams.signals import SignalRecorder
from footfall.diagrams.simulation import run_task
from footfall.models.robots.contact_geometry import is_sole
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot import JointGains
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.solids import add_solids
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.feet import FEET
from footfall.models.values.planned import TaskStatus
from footfall.systems.sensing.contact_monitor import ContactMonitor
from footfall.systems.sensing.foot_wrench_sensor import FootWrenchSensor
from footfall.systems.sensing.kinematic_state import KinematicState
from footfall.systems.sensing.robot_contacts import watched_geometry
from footfall.systems.sensing.speed_monitor import SpeedMonitor
from footfall.systems.timing import timed
from tests.diagrams.judge.climb_evidence import climb_evidence

TIME_STEP = 2e-3
STIFF = replace(JVRC1, gains=dict.fromkeys(JVRC1.gains, JointGains(4000.0, 200.0, 0.1)))
"""Stands by its servos alone."""
WRENCH = ("fx", "fy", "fz", "mx", "my", "mz")


class Clock(LeafSystem):
    """An executive that says `last` from a given time on, or raises then.

    .. pydrake_system::

        name: Clock
        input_ports: []
        output_ports:
        - status
    """

    def __init__(self, end: float, last: TaskStatus | Exception | BaseException):
        super().__init__()
        self._end, self._last = end, last
        self.DeclareAbstractOutputPort(
            "status",
            lambda: Value[object](TaskStatus()),
            timed(self, self._calc_status),
            prerequisites_of_calc={self.time_ticket()},
        )

    def _calc_status(self, context: Context, status: Value) -> None:
        if context.get_time() < self._end:
            status.set_value(TaskStatus(activity="stand"))
        elif isinstance(self._last, BaseException):
            raise self._last
        else:
            status.set_value(self._last)


@dataclass(frozen=True)
class Standing:
    """What the tests of a run build on, as a fixture."""

    task: Callable[..., TaskDiagram]
    scenario: Callable[..., Scenario]


@pytest.fixture
def standing() -> Standing:
    """Builders of the task and of the scenario that goes with it."""
    return Standing(standing_task, standing_scenario)


@pytest.fixture
def climb() -> Evidence:
    """Two steps climbed: the left foot by one, then by two, the right one follows."""
    return climb_evidence()


@pytest.fixture(scope="session")
def crossed_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run over 15 x 5 cm from near by, with half as many scan lines."""
    scenario = load_scenario(
        "obstacle-15cm",
        [
            "sensors.lidar.tilt_step_deg=0.5",
            "robot.x=0.5",
            "task.goal=[1.75, 0.0, 0.0]",
        ],
    )
    folder = tmp_path_factory.mktemp("crossed") / "run"
    run_task(build_task(scenario), scenario, folder)
    return folder


@cache
def stiff_alone() -> MultibodyPlant:
    """The robot without a scene."""
    return robot_alone(STIFF)


def standing_task(
    end: float = 0.2,
    last: TaskStatus | BaseException = TaskStatus("finished", "stand", "stood"),  # noqa: B008
    scene: SceneParams | None = None,
    pitch: float = 0.0,
) -> TaskDiagram:
    """The robot holds its posture until `end`, s; `pitch` of the ankles makes it fall.

    Args:
        end: when the executive says `last`, s.
        last: what it says, or raises.
        scene: what stands around, by default an empty room.
        pitch: added to both ankles' reference, rad.
    """
    scene = scene or SceneParams()
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(
        MultibodyPlantConfig(
            time_step=TIME_STEP,
            contact_model="hydroelastic_with_fallback",
            discrete_contact_approximation="sap",
        ),
        builder,
    )
    plant.set_name("plant")
    add_solids(plant, scene.solids())
    robot = add_robot(plant, scene_graph, STIFF)
    plant.Finalize()
    base = plant.GetBodyByName(STIFF.base_body, robot)
    plant.SetDefaultFloatingBaseBodyPose(base, RigidTransform(np.array([0, 0, 0.85])))
    for name, angle in STIFF.posture.items():
        plant.GetJointByName(name).set_default_angle(angle)
    context = plant.CreateDefaultContext()
    foot = plant.GetBodyByName(STIFF.foot_bodies["left"], robot)
    sole = plant.EvalBodyPoseInWorld(context, foot).translation()[2]
    com = plant.CalcCenterOfMassPositionInWorld(context, [robot])
    height = 0.85 - sole + STIFF.sole.ankle_height
    plant.SetDefaultFloatingBaseBodyPose(
        base, RigidTransform(np.array([-com[0], 0.0, height]))
    )
    joints = [
        plant.get_joint_actuator(index).joint()
        for index in plant.GetJointActuatorIndices(robot)
    ]
    wanted = np.array(
        [
            STIFF.posture.get(joint.name(), 0.0)
            + pitch * joint.name().endswith("ANKLE_P")
            for joint in joints
        ]
    )
    posture = builder.AddNamedSystem(
        "posture", ConstantVectorSource(np.concatenate([wanted, 0.0 * wanted]))
    )
    builder.Connect(
        posture.get_output_port(), plant.get_desired_state_input_port(robot)
    )
    clock = builder.AddNamedSystem("executive", Clock(end, last))
    watched = watched_geometry(
        plant,
        scene_graph.model_inspector(),
        robot,
        tuple(STIFF.foot_bodies[foot] for foot in FEET),
        is_sole,
        scene.ground_names(),
    )
    weight = robot_limits(plant, robot).weight
    monitor = builder.AddNamedSystem(
        "contact_monitor", ContactMonitor(watched, TIME_STEP, weight)
    )
    speeds = builder.AddNamedSystem(
        "speed_monitor", SpeedMonitor(plant, robot, TIME_STEP)
    )
    builder.Connect(plant.get_state_output_port(robot), speeds.GetInputPort("state"))
    builder.Connect(
        plant.get_contact_results_output_port(), monitor.GetInputPort("contact_results")
    )
    signals = SignalRecorder(builder)
    names = [
        *plant.GetPositionNames(robot, False, True),
        *plant.GetVelocityNames(robot, False, True),
    ]
    signals.add_vector(
        "plant.state", plant.get_state_output_port(robot), tuple(names), "1", 0.005
    )
    signals.add_vector(
        "plant.net_actuation",
        plant.get_net_actuation_output_port(robot),
        tuple(joint.name() for joint in joints),
        "Nm",
        0.005,
    )
    sensor = builder.AddNamedSystem("station", FootWrenchSensor(plant, robot, STIFF))
    builder.Connect(
        plant.get_contact_results_output_port(), sensor.GetInputPort("contact_results")
    )
    kinematics = builder.AddNamedSystem(
        "kinematic_state", KinematicState(stiff_alone(), STIFF)
    )
    builder.Connect(
        plant.get_state_output_port(robot), kinematics.GetInputPort("state")
    )
    builder.Connect(
        kinematics.GetOutputPort("foot_poses"), sensor.GetInputPort("foot_poses")
    )
    signals.add_vector(
        "station.foot_wrenches",
        sensor.GetOutputPort("foot_wrenches"),
        tuple(f"{foot}_{part}" for foot in FEET for part in WRENCH),
        ("N", "N", "N", "Nm", "Nm", "Nm") * 2,
        0.005,
    )
    for port, columns in (
        (
            "foot_forces",
            tuple(f"{foot}_{part}" for foot in FEET for part in WRENCH[:3]),
        ),
        ("other_support", ("fz",)),
        ("impact", FEET),
    ):
        signals.add_vector(
            f"contact_monitor.{port}", monitor.GetOutputPort(port), columns, "N", 0.005
        )
    signals.add_vector(
        "speed_monitor.peak_speeds",
        speeds.GetOutputPort("peak_speeds"),
        tuple(joint.name() for joint in joints),
        "rad/s",
        0.005,
    )
    signals.add_value("executive.status", clock.GetOutputPort("status"), 0.005)
    signals.add_value("contact_monitor.touches", monitor.GetOutputPort("touches"), 0.05)
    return TaskDiagram(
        kind="standing",
        diagram=builder.Build(),
        plant=plant,
        scene_graph=scene_graph,
        robot_instance=robot,
        robot=STIFF,
        scene=scene,
        signals=signals,
        status=clock.GetOutputPort("status"),
    )


def standing_scenario(max_time: float = 1.0, seed: int = 0) -> Scenario:
    """The scenario that goes with it (the staircase stands out of reach)."""
    return Scenario(
        name="standing",
        scene=SceneParams(staircase=StaircaseParams(x=2.0)),
        simulation=SimulationParams(max_time=max_time, seed=seed),
    )
