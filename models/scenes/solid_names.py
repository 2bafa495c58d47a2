"""What the solids of a scene are called, and which of them a sole may stand on."""

BOX = "box/"
"""Begins the names of obstacles and clutter, those that move too."""
STAIRCASE = "staircase/"
"""Begins the names of a staircase's steps."""
ROOM = "room/"
"""Begins the names of the room's floor, walls and ceiling."""
FLOOR = f"{ROOM}floor"
"""The floor, z = 0."""


def is_box(name: str) -> bool:
    """Whether a solid is an obstacle or clutter."""
    return name.startswith(BOX)


def is_ground(name: str) -> bool:
    """Whether soles may touch a solid; nothing else of a robot may, and no other."""
    return name == FLOOR or name.startswith(STAIRCASE)
