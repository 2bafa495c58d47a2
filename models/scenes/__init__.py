"""Scenes: staircases, obstacles and rooms as solids."""
