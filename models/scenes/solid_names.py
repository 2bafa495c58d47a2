"""What the names of a scene's solids begin with; what they are their role says."""

BOX = "box/"
"""Begins the names of obstacles and clutter, those that move too."""
STAIRCASE = "staircase/"
"""Begins the names of a staircase's steps."""
ROOM = "room/"
"""Begins the names of the room's floor, walls and ceiling."""
