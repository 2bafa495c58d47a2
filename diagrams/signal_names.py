"""Names of the signals that the judge and the figures look for in a run."""

STATE_SIGNAL = "plant.state"
"""Positions, then velocities of the robot: a run that does not log them cannot be
judged."""
MOVERS_SIGNAL = "movers.state"
"""Where the boxes that move are, x and y of each in turn, then their rates."""
PLAN_SIGNAL = "executive.motion_plan"
"""The motion that is being carried out."""
POLYGON_SIGNAL = "static_stability.polygon"
"""Where the CoM may be for the robot to stand still on its present contacts."""
OBSTACLE_SIGNAL = "obstacle_finder.obstacle_map"
"""The obstacles that have been seen."""
