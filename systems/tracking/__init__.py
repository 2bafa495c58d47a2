"""Tracking: whole-body inverse kinematics and the joint references it yields."""
