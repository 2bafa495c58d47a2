"""Disturbances: what the world does to the robot."""
