"""The block diagram of a closed loop as a picture."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from html import escape
from typing import NamedTuple

from pydrake.systems.framework import Diagram, PortDataType, System

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems, leaf_wires
from footfall.diagrams.closed_loop.parts import input_ports, output_ports, owner
from footfall.systems.signal_log import SignalLog
from footfall.systems.value_log_sink import ValueLogSink

VECTOR_COLOR, ABSTRACT_COLOR = "#1f5fa8", "#b3541e"
OPEN_COLOR = "#8a8a8a"
"""Of a port that nothing is connected to."""
FILLS = {
    "sensing": "#e3f1e5",
    "perception": "#fdf0d5",
    "planning": "#f9e0dc",
    "balance": "#dfe9f6",
    "tracking": "#e9e2f3",
}
"""Colour of a block by the folder of `systems/` that it comes from."""
OTHER_FILL = "#eeeeee"


class Block(NamedTuple):
    """A system of the diagram."""

    name: str
    kind: str
    """Its class."""
    fill: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    station: str
    """The subdiagram that it is in, "" for one that the diagram holds itself."""
    open_inputs: frozenset[str]
    """Of its inputs those that nothing is connected to."""
    open_outputs: frozenset[str]
    """Likewise of its outputs."""


class Wire(NamedTuple):
    """A connection."""

    source: str
    output: str
    target: str
    input: str
    abstract: bool
    """Whether it carries a value rather than a vector."""


def topology(diagram: Diagram) -> tuple[list[Block], list[Wire]]:
    """Lists the blocks of a diagram and how they are connected, without log sinks.

    The subdiagrams are looked into. Unconnected ports are listed too, for they are what
    a further part can be connected to.
    """
    wires = [
        Wire(
            owner(source).get_name(),
            source.get_name(),
            owner(target).get_name(),
            target.get_name(),
            source.get_data_type() == PortDataType.kAbstractValued,
        )
        for source, target in leaf_wires(diagram)
        if not _is_log(owner(target))
    ]
    used_inputs = {(wire.target, wire.input) for wire in wires}
    used_outputs = {(wire.source, wire.output) for wire in wires}
    blocks = []
    for station, system in leaf_systems(diagram):
        if _is_log(system):
            continue
        name = system.get_name()
        inputs = [port.get_name() for port in input_ports(system)]
        outputs = [port.get_name() for port in output_ports(system)]
        blocks.append(
            Block(
                name,
                type(system).__name__.partition("_")[0],
                _fill(system),
                tuple(inputs),
                tuple(outputs),
                station,
                frozenset(port for port in inputs if (name, port) not in used_inputs),
                frozenset(port for port in outputs if (name, port) not in used_outputs),
            )
        )
    return blocks, wires


def block_diagram_svg(diagram: Diagram, title: str) -> str:
    """Draws the diagram's blocks and wires as SVG, laid out by Graphviz.

    Blocks are framed by station and coloured by what they are for; wires that carry
    vectors are solid and blue, those that carry abstract values dashed and brown.
    Ports that nothing is connected to are grey.
    """
    return draw_blocks(*topology(diagram), title)


def draw_blocks(blocks: Sequence[Block], wires: Sequence[Wire], title: str) -> str:
    """Draws blocks and wires as SVG; without a title there is no legend either."""
    # Where its X11 libraries are missing, all but these pictures can be drawn.
    import pygraphviz  # type: ignore[import-untyped]

    graph = pygraphviz.AGraph(directed=True, strict=False)
    graph.graph_attr.update(
        rankdir="LR",
        ranksep="1.1",
        nodesep="0.25",
        fontname="Helvetica",
        label=_legend(title) if title else "",
        labelloc="b",
    )
    graph.node_attr.update(shape="plain", fontname="Helvetica", fontsize="11")
    graph.edge_attr.update(arrowsize="0.6", penwidth="1.2")
    for block in blocks:
        graph.add_node(block.name, label=_label(block))
    for station in {block.station: None for block in blocks if block.station}:
        graph.add_subgraph(
            [block.name for block in blocks if block.station == station],
            name=f"cluster_{station}",
            label=station,
            labeljust="l",
            fontsize="16",
            fontcolor="#666666",
            color="#bbbbbb",
            style="rounded",
        )
    for wire in wires:
        graph.add_edge(
            wire.source,
            wire.target,
            tailport=f"o_{wire.output}:e",
            headport=f"i_{wire.input}:w",
            color=ABSTRACT_COLOR if wire.abstract else VECTOR_COLOR,
            style="dashed" if wire.abstract else "solid",
            edgetooltip=f"{wire.source}.{wire.output} -> {wire.target}.{wire.input}",
        )
    with _without_library_warnings():
        picture: bytes = graph.draw(format="svg", prog="dot")
    return picture.decode("utf-8")


@contextmanager
def _without_library_warnings() -> Iterator[None]:
    """Graphviz's font library complains of the system's settings to stderr itself."""
    saved = os.dup(2)
    try:
        with open(os.devnull, "w") as nowhere:
            os.dup2(nowhere.fileno(), 2)
            yield
    finally:
        os.dup2(saved, 2)
        os.close(saved)


def _is_log(system: System) -> bool:
    return isinstance(system, SignalLog | ValueLogSink)


def _fill(system: System) -> str:
    package = type(system).__module__.split(".")
    ours = package[:2] == ["footfall", "systems"]
    return FILLS.get(package[2], OTHER_FILL) if ours else OTHER_FILL


def _label(block: Block) -> str:
    """Writes a block as a Graphviz table: its title above inputs and outputs."""
    rows = max(len(block.inputs), len(block.outputs))
    body = ""
    for row in range(rows):
        left, right = (
            (
                f'<TD ALIGN="{side}" PORT="{key}_{escape(ports[row])}">'
                f"{_port(ports[row], opened)}</TD>"
            )
            if row < len(ports)
            else "<TD></TD>"
            for key, side, ports, opened in (
                ("i", "LEFT", block.inputs, block.open_inputs),
                ("o", "RIGHT", block.outputs, block.open_outputs),
            )
        )
        body += f"<TR>{left}{right}</TR>"
    kind = (
        ""
        if block.kind == block.name
        else (f'<BR/><FONT POINT-SIZE="9" COLOR="#666666">{escape(block.kind)}</FONT>')
    )
    return (
        f'<<TABLE BORDER="1" CELLBORDER="0" CELLSPACING="0" CELLPADDING="3" '
        f'STYLE="ROUNDED" COLOR="#555555" BGCOLOR="{block.fill}">'
        f'<TR><TD COLSPAN="2"><B>{escape(block.name)}</B>{kind}</TD></TR>'
        f"{body}</TABLE>>"
    )


def _port(name: str, opened: frozenset[str]) -> str:
    if name in opened:
        return f'<FONT COLOR="{OPEN_COLOR}">{escape(name)}</FONT>'
    return escape(name)


def _legend(title: str) -> str:
    return (
        f'<<FONT POINT-SIZE="11">{escape(title)}: '
        f'<FONT COLOR="{VECTOR_COLOR}">&#8212;&#8212; vector</FONT>   '
        f'<FONT COLOR="{ABSTRACT_COLOR}">- - - abstract value</FONT>   '
        f'<FONT COLOR="{OPEN_COLOR}">port that nothing is connected to</FONT></FONT>>'
    )
