"""JVRC-1, the humanoid of the Japan Virtual Robotics Challenge (`jvrc-description`)."""

from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_derivation import robot_model
from footfall.models.robots.robot_description import DEFAULT_FILE, read_description

JVRC1: RobotModel = robot_model(read_description(DEFAULT_FILE), DEFAULT_FILE)
