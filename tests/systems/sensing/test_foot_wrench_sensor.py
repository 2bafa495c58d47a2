"""Force sensors under the soles, against a robot that stands on tilted feet and floor.

Everything that must balance when nothing moves: weight, moments, centres of pressure.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    ContactResults,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context, DiagramBuilder
from pydrake.systems.primitives import ConstantVectorSource

from footfall.diagrams.closed_loop.robot_station import DRAKE_CONTACT_MODELS
from footfall.models.robots.contact_geometry import CONTACT_MODELS, ContactModel
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot import JointGains
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solids import add_solids
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.foot_wrench_sensor import (
    FootWrenchSensor,
    SoleFrame,
    sum_wrenches,
)
from footfall.systems.sensing.kinematic_state import KinematicState

STIFF = replace(JVRC1, gains=dict.fromkeys(JVRC1.gains, JointGains(4000.0, 200.0, 0.1)))
"""Stands by its servos alone."""


@dataclass(frozen=True)
class Standing:
    """A robot that has come to rest on the floor, and what its sensor says."""

    plant: MultibodyPlant
    context: Context
    wrenches: Vector
    """(2, 6), in F."""
    zmp: Vector
    X_WF: tuple[RigidTransform, ...]
    com: Vector
    weight: float


@pytest.fixture(scope="module", params=CONTACT_MODELS)
def standing(request: pytest.FixtureRequest) -> Standing:
    """After 4 s of holding a posture that loads the feet unevenly."""
    model: ContactModel = request.param
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(
        MultibodyPlantConfig(
            time_step=0.0025,
            contact_model=DRAKE_CONTACT_MODELS[model],
            discrete_contact_approximation="lagged",
        ),
        builder,
    )
    add_solids(plant, RoomParams().solids())
    robot = add_robot(plant, scene_graph, STIFF, model)
    plant.Finalize()
    yaw = 0.6
    base = plant.GetBodyByName(JVRC1.base_body, robot)
    for name, angle in (JVRC1.posture | {"WAIST_R": 0.15, "WAIST_Y": 0.3}).items():
        plant.GetJointByName(name).set_default_angle(angle)
    R_WP = RollPitchYaw(0.0, 0.0, yaw).ToRotationMatrix()
    plant.SetDefaultFloatingBaseBodyPose(base, RigidTransform(R_WP, [0.0, 0.0, 1.0]))
    context = plant.CreateDefaultContext()
    foot = plant.GetBodyByName(JVRC1.foot_bodies["left"], robot)
    ankle = plant.EvalBodyPoseInWorld(context, foot).translation()[2]
    height = 1.0 - ankle + JVRC1.sole.ankle_height
    plant.SetDefaultFloatingBaseBodyPose(base, RigidTransform(R_WP, [1.0, 2.0, height]))
    wanted = np.array(
        [
            plant.get_joint_actuator(index).joint().default_positions()[0]
            for index in plant.GetJointActuatorIndices(robot)
        ]
    )
    posture = builder.AddSystem(
        ConstantVectorSource(np.concatenate([wanted, np.zeros(len(wanted))]))
    )
    builder.Connect(
        posture.get_output_port(), plant.get_desired_state_input_port(robot)
    )
    sensor = builder.AddSystem(FootWrenchSensor(plant, robot, JVRC1))
    builder.Connect(
        plant.get_contact_results_output_port(), sensor.GetInputPort("contact_results")
    )
    kinematics = builder.AddSystem(KinematicState(robot_alone(STIFF), STIFF))
    builder.Connect(
        plant.get_state_output_port(robot), kinematics.GetInputPort("state")
    )
    builder.Connect(
        kinematics.GetOutputPort("foot_poses"), sensor.GetInputPort("foot_poses")
    )
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(4.0)
    root = simulator.get_context()
    context = plant.GetMyContextFromRoot(root)
    own = sensor.GetMyContextFromRoot(root)
    X_AF = RigidTransform(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
    return Standing(
        plant,
        context,
        eval_vector(sensor.GetOutputPort("foot_wrenches"), own).reshape(2, 6),
        eval_vector(sensor.GetOutputPort("zmp"), own),
        tuple(
            plant.EvalBodyPoseInWorld(
                context, plant.GetBodyByName(JVRC1.foot_bodies[foot], robot)
            ).multiply(X_AF)
            for foot in FEET
        ),
        plant.CalcCenterOfMassPositionInWorld(context, [robot]),
        9.81 * plant.CalcTotalMass(context, [robot]),
    )


def in_world(standing: Standing) -> tuple[Vector, Vector]:
    """Net force, and net moment about W's origin, of both sensors."""
    force, moment = np.zeros(3), np.zeros(3)
    for wrench, X in zip(standing.wrenches, standing.X_WF, strict=True):
        f_W = X.rotation().multiply(wrench[:3])
        force += f_W
        moment += X.rotation().multiply(wrench[3:]) + np.cross(X.translation(), f_W)
    return force, moment


def test_it_stands(standing: Standing) -> None:
    """The fixture's robot is at rest, turned, and its feet are loaded unevenly."""
    speed = np.abs(standing.plant.GetVelocities(standing.context)).max()
    assert speed < 2e-3
    left, right = standing.wrenches[:, 2]
    assert min(left, right) > 20.0
    assert abs(left - right) > 40.0


def test_forces_carry_the_weight(standing: Standing) -> None:
    """And nothing sideways."""
    force, _ = in_world(standing)
    np.testing.assert_allclose(force, [0.0, 0.0, standing.weight], atol=1.0)


def test_moments_balance_about_the_com(standing: Standing) -> None:
    """All three: the robot neither tips nor turns."""
    force, moment = in_world(standing)
    np.testing.assert_allclose(
        moment - np.cross(standing.com, force), np.zeros(3), atol=0.3
    )


def test_zmp_is_under_the_com(standing: Standing) -> None:
    """At rest; at the height of the soles."""
    np.testing.assert_allclose(standing.zmp[:2], standing.com[:2], atol=1e-3)
    assert standing.zmp[2] == pytest.approx(0.0, abs=2e-3)


def test_each_centre_of_pressure_lies_in_its_sole(standing: Standing) -> None:
    """In F: my / fz back, mx / fz to the left."""
    sole = JVRC1.sole
    for wrench in standing.wrenches:
        x, y = -wrench[4] / wrench[2], wrench[3] / wrench[2]
        assert -sole.heel - 1e-3 < x < sole.toe + 1e-3
        assert abs(y) < sole.half_width + 1e-3


def test_wrenches_are_those_of_the_contacts(standing: Standing) -> None:
    """Each foot has its own, moved to its sole frame, whichever body is named first."""
    results = standing.plant.get_contact_results_output_port().Eval(standing.context)
    assert isinstance(results, ContactResults)
    plant = standing.plant
    bodies = [plant.GetBodyByName(JVRC1.foot_bodies[foot]) for foot in FEET]
    feet = {
        geometry.get_value(): k
        for k, body in enumerate(bodies)
        for geometry in plant.GetCollisionGeometriesForBody(body)
    }
    frames = [SoleFrame(X.rotation().matrix(), X.translation()) for X in standing.X_WF]
    np.testing.assert_allclose(
        sum_wrenches(results, feet, frames), standing.wrenches, atol=1e-12
    )
    other = {geometry: 1 - k for geometry, k in feet.items()}
    swapped = sum_wrenches(results, other, frames[::-1])
    np.testing.assert_allclose(swapped[::-1], standing.wrenches, atol=1e-12)
    # The floor feels the opposite.
    walls = plant.GetCollisionGeometriesForBody(plant.world_body())
    floor = {geometry.get_value(): 0 for geometry in walls}
    world = sum_wrenches(results, floor, [SoleFrame(np.eye(3), np.zeros(3))])[0]
    force, moment = in_world(standing)
    np.testing.assert_allclose(world, -np.concatenate([force, moment]), atol=1e-9)
