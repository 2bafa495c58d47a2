"""Where each System stands in the closed loops, and what its ports carry there."""

from collections.abc import Mapping
from dataclasses import dataclass

from pydrake.systems.framework import Diagram, LeafSystem, System

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.diagrams.closed_loop.parts import describe, input_ports, output_ports
from footfall.diagrams.figures.block_diagram import Block, Wire, draw_blocks, topology


@dataclass(frozen=True)
class Place:
    """A System in a closed loop."""

    loop: str
    """The scenario that it is of."""
    name: str
    """Of the part."""
    station: str
    """That it is in; empty where the loop holds it itself."""
    carries: Mapping[str, str]
    """By port its size or type: "vector of 3", "abstract MotionPlan"."""
    svg: str
    """Its block with those that it is connected to, as a picture."""


def places_of(loops: Mapping[str, Diagram]) -> dict[type[LeafSystem], list[Place]]:
    """Finds the Systems of closed loops.

    Args:
        loops: the loops by their scenarios' names.

    Returns:
        By class every place that a System of it has, in the order of the loops.
    """
    found: dict[type[LeafSystem], list[Place]] = {}
    for loop, diagram in loops.items():
        blocks, wires = topology(diagram)
        for station, system in leaf_systems(diagram):
            name = system.get_name()
            if isinstance(system, LeafSystem) and any(b.name == name for b in blocks):
                svg = draw_blocks(*neighbourhood(name, blocks, wires), "")
                place = Place(loop, name, station, carried_by(system), svg)
                found.setdefault(type(system), []).append(place)
    return found


def carried_by(system: System) -> dict[str, str]:
    """Says what each port of a System carries, by the port's name."""
    carried = {port.get_name(): describe(port) for port in input_ports(system)}
    return carried | {port.get_name(): describe(port) for port in output_ports(system)}


def neighbourhood(
    name: str, blocks: list[Block], wires: list[Wire]
) -> tuple[list[Block], list[Wire]]:
    """Picks a block, those it is connected to, and the wires between it and them.

    The neighbours keep the ports alone that these wires end at.
    """
    near = [wire for wire in wires if name in (wire.source, wire.target)]
    outputs = {(wire.source, wire.output) for wire in near}
    inputs = {(wire.target, wire.input) for wire in near}
    names = {name, *(end for wire in near for end in (wire.source, wire.target))}
    picked = [
        block
        if block.name == name
        else block._replace(
            inputs=tuple(p for p in block.inputs if (block.name, p) in inputs),
            outputs=tuple(p for p in block.outputs if (block.name, p) in outputs),
        )
        for block in blocks
        if block.name in names
    ]
    return picked, near
