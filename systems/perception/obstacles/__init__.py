"""Obstacles and boxes: clusters of points, and their solids."""
