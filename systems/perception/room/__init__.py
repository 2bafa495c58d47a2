"""The floor and the environment of a room (room paper, Sec. 2)."""
