"""Feet by name."""

from typing import Literal, TypeAlias

Foot: TypeAlias = Literal["left", "right"]


FEET: tuple[Foot, Foot] = ("left", "right")


def other_foot(foot: Foot) -> Foot:
    """Returns the foot on the other side."""
    return "right" if foot == "left" else "left"
