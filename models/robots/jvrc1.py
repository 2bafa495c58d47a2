"""JVRC-1, the humanoid of the Japan Virtual Robotics Challenge (`jvrc-description`)."""

from pathlib import Path

from pydrake.common.yaml import yaml_load_typed

from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_derivation import robot_model
from footfall.models.robots.robot_description import RobotDescription

FILE = Path(__file__).with_suffix(".yaml")
"""What is said of it."""

JVRC1: RobotModel = robot_model(
    yaml_load_typed(schema=RobotDescription, filename=str(FILE)),  # type: ignore[no-untyped-call]
    FILE,
)
