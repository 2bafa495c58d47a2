"""CoM and feet from the measured state, against a plant set to that state."""

import numpy as np
import pytest
from pydrake.geometry import SceneGraph
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.kinematic_state import KinematicState


@pytest.fixture(scope="module")
def plant() -> MultibodyPlant:
    """The robot alone."""
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    return plant


def random_state(plant: MultibodyPlant, seed: int) -> Vector:
    """Positions with a unit quaternion, then velocities."""
    rng = np.random.default_rng(seed)
    state = rng.uniform(-0.5, 0.5, plant.num_multibody_states())
    state[0] = 1.0
    state[:4] /= np.linalg.norm(state[:4])
    return state


def at(plant: MultibodyPlant, state: Vector) -> tuple[KinematicState, Context]:
    """The system with that state on its input."""
    system = KinematicState(plant, JVRC1)
    context = system.CreateDefaultContext()
    system.GetInputPort("state").FixValue(context, state)
    return system, context


def output(system: KinematicState, context: Context, name: str) -> Vector:
    """A port's value."""
    return eval_vector(system.GetOutputPort(name), context)


@pytest.mark.parametrize("seed", range(3))
def test_com_is_the_mean_of_the_bodies(plant: MultibodyPlant, seed: int) -> None:
    """By mass, each at its own centre."""
    state = random_state(plant, seed)
    system, context = at(plant, state)
    truth = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(truth, state)
    total, moment = 0.0, np.zeros(3)
    for instance in range(2, plant.num_model_instances()):
        for body_index in plant.GetBodyIndices(ModelInstanceIndex(instance)):
            body = plant.get_body(body_index)
            mass = body.get_mass(truth)
            p_BoBcm = body.CalcCenterOfMassInBodyFrame(truth)
            p_WBcm = plant.EvalBodyPoseInWorld(truth, body).multiply(p_BoBcm)
            total, moment = total + mass, moment + mass * p_WBcm
    np.testing.assert_allclose(
        output(system, context, "com"), moment / total, atol=1e-12
    )


def test_com_velocity_is_the_rate_of_the_com(plant: MultibodyPlant) -> None:
    """By central differences along the motion."""
    state, step = random_state(plant, 5), 1e-6
    nq = plant.num_positions()
    truth = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(truth, state)
    qdot = plant.MapVelocityToQDot(truth, state[nq:])
    coms = []
    for sign in (1.0, -1.0):
        moved = state.copy()
        moved[:nq] += sign * step * qdot
        coms.append(output(*at(plant, moved), "com"))
    velocity = output(*at(plant, state), "com_velocity")
    np.testing.assert_allclose((coms[0] - coms[1]) / (2.0 * step), velocity, atol=1e-6)


def test_foot_poses_are_the_soles(plant: MultibodyPlant) -> None:
    """Left first; the ankle's orientation, the origin below it on the sole."""
    state = random_state(plant, 6)
    truth = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(truth, state)
    poses = output(*at(plant, state), "foot_poses").reshape(2, 6)
    for foot, pose in zip(FEET, poses, strict=True):
        body = plant.GetBodyByName(JVRC1.foot_bodies[foot])
        X_WF = RigidTransform(RollPitchYaw(pose[3:]), pose[:3])
        X_AF = plant.EvalBodyPoseInWorld(truth, body).InvertAndCompose(X_WF)
        want = RigidTransform(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
        assert X_AF.IsNearlyEqualTo(want, 1e-12)


def test_outputs_follow_the_input(plant: MultibodyPlant) -> None:
    """A new state is not answered from the old one's cache."""
    system, context = at(plant, random_state(plant, 7))
    before = output(system, context, "com")
    state = random_state(plant, 7)
    state[4:7] += [1.0, 2.0, 3.0]
    system.GetInputPort("state").FixValue(context, state)
    np.testing.assert_allclose(
        output(system, context, "com") - before, [1.0, 2.0, 3.0], atol=1e-12
    )
