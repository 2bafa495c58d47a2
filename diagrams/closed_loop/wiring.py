"""Typed edges of the DiagramBuilder."""

from typing import TypeVar

from pydrake.systems.framework import DiagramBuilder, System

S = TypeVar("S", bound=System)


def add_system(builder: DiagramBuilder, name: str, system: S) -> S:
    """Adds a system under a name and gives it back with its own type."""
    builder.AddNamedSystem(name, system)
    return system
