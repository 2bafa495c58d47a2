"""The robot alone, and where it stands for the tests of tracking."""

from dataclasses import dataclass

import numpy as np
import pytest
from pydrake.geometry import SceneGraph
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot
from footfall.models.values.vector import Vector
from footfall.systems.tracking.whole_body_ik import (
    IkParams,
    IkTarget,
    WholeBodyIk,
    solve_posture,
)


@dataclass(frozen=True)
class Standing:
    """A robot at rest on a target: feet apart in height, turned, waist leaning."""

    plant: MultibodyPlant
    target: IkTarget
    q: Vector

    def context(self, q: Vector | None = None) -> Context:
        """A new context of the plant, at these positions or standing."""
        context = self.plant.CreateDefaultContext()
        self.plant.SetPositions(context, self.q if q is None else q)
        return context


@pytest.fixture(scope="session")
def standing() -> Standing:
    """Solved once."""
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    target = IkTarget(
        com=np.array([0.55, -0.28, 0.93]),
        com_velocity=np.zeros(3),
        foot_poses=np.array(
            [[0.5, -0.2, 0.15, 0.0, 0.0, 0.2], [0.55, -0.4, 0.1, 0.0, 0.0, 0.1]]
        ),
        foot_rates=np.zeros((2, 6)),
        stance=np.ones(2),
        waist=np.array([0.02, 0.15, 0.15]),
        waist_rate=np.zeros(3),
    )
    ik = WholeBodyIk(plant, JVRC1, IkParams())
    return Standing(plant, target, solve_posture(ik, plant, target))
