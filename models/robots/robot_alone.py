"""The robot without a scene: the controllers' kinematics and dynamics."""

import numpy as np
from pydrake.geometry import SceneGraph
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import add_robot


def robot_alone(robot: RobotModel) -> MultibodyPlant:
    """Makes the robot without a scene, finalised, as the controllers know it."""
    model = MultibodyPlant(0.0)
    scene_graph = SceneGraph()
    model.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(model, scene_graph, robot)
    model.Finalize()
    return model


def robot_weight(model: MultibodyPlant) -> float:
    """Computes the weight of the robot alone, N."""
    gravity = float(np.linalg.norm(model.gravity_field().gravity_vector()))
    return model.CalcTotalMass(model.CreateDefaultContext()) * gravity
