"""The robot alone and a step to climb, for the tests of planned motions."""

from dataclasses import dataclass

import numpy as np
import pytest
from pydrake.geometry import SceneGraph
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.collision_hulls import collision_hulls
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.balance.wrench_distribution import DistributionParams
from footfall.systems.planning.motion.motion_prediction import MotionPredictor
from footfall.systems.planning.motion.motion_task import MotionTask
from footfall.systems.tracking.whole_body_ik import IkParams, WholeBodyIk


@dataclass(frozen=True)
class Robot:
    """JVRC-1 and what predicts for it."""

    plant: MultibodyPlant
    predictor: MotionPredictor


@pytest.fixture(scope="session")
def jvrc1() -> Robot:
    """Built once."""
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    ik = WholeBodyIk(plant, JVRC1, IkParams())
    predictor = MotionPredictor(
        plant,
        JVRC1,
        ik,
        DistributionParams(),
        collision_hulls(JVRC1),
        SelfDistanceMeter(JVRC1),
    )
    return Robot(plant, predictor)


def one_step(rise: float, run: float = 0.327, gap: float = 0.08) -> MotionTask:
    """Both feet up one step: `run` from sole to sole, toes `gap` before the riser."""
    feet: Vector = np.zeros((2, 6))
    feet[:, 1] = (0.095, -0.095)
    footsteps = tuple(
        Footstep(foot, RigidTransform(np.array([run, y, rise])), 0)
        for foot, y in (("right", -0.095), ("left", 0.095))
    )
    edge = np.array([[0.15 + gap, 0.0, rise]])
    return MotionTask(feet, np.array([0.035, 0.0, 0.85]), footsteps, edge)


@pytest.fixture
def step_10cm() -> MotionTask:
    """A step that is lower than a lifted heel."""
    return one_step(0.10)


@pytest.fixture
def step_24cm() -> MotionTask:
    """The stair paper's step."""
    return one_step(0.24)


@pytest.fixture
def step_32cm() -> MotionTask:
    """A step that is too high."""
    return one_step(0.32)
