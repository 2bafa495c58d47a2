"""Sensors: what the robot measures of itself and of the scene."""
