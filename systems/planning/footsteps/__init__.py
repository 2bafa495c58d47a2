"""Footsteps on stairs and in front of them (stair paper, Sec. 6.1)."""
