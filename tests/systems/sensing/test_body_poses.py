"""The bodies of the state that is believed, and points on them."""

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.jvrc1 import JVRC1
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.body_poses import BodyPoses
from footfall.systems.sensing.mounted_point import MountedPoint
from tests.systems.test_system_docstrings import robot_alone


def test_every_body_by_its_index() -> None:
    """As the plant itself has them."""
    plant, _ = robot_alone()
    rng = np.random.default_rng(0)
    state = np.concatenate(
        [[1.0, 0.0, 0.0, 0.0, 0.4, -0.2, 0.9], rng.uniform(-0.3, 0.3, 32), np.zeros(38)]
    )
    system = BodyPoses(plant)
    context = system.CreateDefaultContext()
    system.GetInputPort("state").FixValue(context, state)
    poses = system.get_output_port(0).Eval(context)
    at = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(at, state)
    assert len(poses) == plant.num_bodies()
    for name in (JVRC1.base_body, JVRC1.foot_bodies["left"], JVRC1.torso_body):
        body = plant.GetBodyByName(name)
        pose = poses[int(body.index())]
        assert pose.IsNearlyEqualTo(body.EvalPoseInWorld(at), 1e-12)


def test_a_point_moves_with_its_body() -> None:
    """X_WB p_BP."""
    system = MountedPoint(1, np.array([0.1, 0.0, 0.2]))
    context = system.CreateDefaultContext()
    poses = [RigidTransform(), RigidTransform([1.0, 2.0, 3.0])]
    system.GetInputPort("body_poses").FixValue(context, poses)
    position = eval_vector(system.get_output_port(0), context)
    np.testing.assert_allclose(position, [1.1, 2.0, 3.2])
