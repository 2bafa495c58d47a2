"""Diagrams that are built one after the other: each goes when nobody needs it.

Python's collector of cycles frees them, if it sees all that holds a System. It does not
see what Drake holds itself: callbacks, and objects that keep their System alive.
"""

import gc
import sys
import weakref
from types import CellType, MethodType

import pytest
from pydrake.systems.framework import Diagram, DiagramBuilder, LeafSystem, System

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario

NAMES = ("stairs-exp1", "obstacle-15cm", "room-moving")


class Nothing(LeafSystem):
    """A System in Python, without any port."""


def built(system: LeafSystem) -> System:
    """A diagram of one System."""
    builder = DiagramBuilder()
    builder.AddNamedSystem("nothing", system)
    return builder.Build()


def unseen(system: object) -> int:
    """How many hold an object unseen by the collector, and some more, always the same.

    References are counted by the interpreter, holders by the collector.
    """
    return sys.getrefcount(system) - len(gc.get_referrers(system))


def callbacks_of(system: object) -> list[object]:
    """Methods and closures that hold an object."""
    holders = gc.get_referrers(system)
    return [item for item in holders if isinstance(item, MethodType | CellType)]


@pytest.mark.parametrize("name", NAMES)
def test_no_callback_holds_a_system_nor_a_system_what_keeps_it(name: str) -> None:
    """Which the collector would not see."""
    (nothing,) = built(Nothing()).GetSystems()
    fewest = unseen(nothing)
    diagram = build_task(load_scenario(name)).diagram
    stations = [part for part in diagram.GetSystems() if isinstance(part, Diagram)]
    systems = [*stations, *(leaf for _, leaf in leaf_systems(diagram))]
    del diagram, stations
    gc.collect()
    for system in systems:
        assert callbacks_of(system) == [], system.get_name()
        assert unseen(system) <= fewest, system.get_name()


@pytest.mark.parametrize("name", NAMES)
def test_a_diagram_is_freed(name: str) -> None:
    """With all that it is made of."""
    alone = weakref.ref(built(Nothing()))
    gc.collect()
    if alone() is not None:
        pytest.skip("this version of Drake keeps every System that is in Python")
    diagram = build_task(load_scenario(name)).diagram
    leaves = [leaf for _, leaf in leaf_systems(diagram)]
    everything = (diagram, *diagram.GetSystems(), *leaves)
    kept = [weakref.ref(system) for system in everything]
    del leaves, everything
    del diagram
    gc.collect()
    assert [ref() for ref in kept if ref() is not None] == []
