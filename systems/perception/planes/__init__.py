"""Planes and stairs in point clouds (stair paper, Secs. 3 to 5)."""
