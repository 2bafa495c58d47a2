"""The block diagram of a closed loop as a picture."""

import os
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from typing import NamedTuple

from pydrake.systems.framework import Diagram, PortDataType, System

from footfall.systems.signal_log import SignalLog
from footfall.systems.value_log_sink import ValueLogSink

VECTOR_COLOR, ABSTRACT_COLOR = "#1f5fa8", "#b3541e"
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
    """Connected input ports."""
    outputs: tuple[str, ...]
    """Connected output ports."""


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

    A subdiagram is one block. Ports that nothing is connected to are left out.
    """
    wires = []
    for target, source in diagram.connection_map().items():
        (input_system, input_index), (output_system, output_index) = target, source
        if _is_log(input_system):
            continue
        output = output_system.get_output_port(int(output_index))
        wires.append(
            Wire(
                output_system.get_name(),
                output.get_name(),
                input_system.get_name(),
                input_system.get_input_port(int(input_index)).get_name(),
                output.get_data_type() == PortDataType.kAbstractValued,
            )
        )
    used_inputs, used_outputs = defaultdict(set), defaultdict(set)
    for wire in wires:
        used_inputs[wire.target].add(wire.input)
        used_outputs[wire.source].add(wire.output)
    blocks = []
    for system in diagram.GetSystems():
        if _is_log(system):
            continue
        name = system.get_name()
        inputs = [
            system.get_input_port(index).get_name()
            for index in range(system.num_input_ports())
        ]
        outputs = [
            system.get_output_port(index).get_name()
            for index in range(system.num_output_ports())
        ]
        blocks.append(
            Block(
                name,
                type(system).__name__.partition("_")[0],
                _fill(system),
                tuple(port for port in inputs if port in used_inputs[name]),
                tuple(port for port in outputs if port in used_outputs[name]),
            )
        )
    return blocks, wires


def block_diagram_svg(diagram: Diagram, title: str) -> str:
    """Draws the diagram's blocks and wires as SVG, laid out by Graphviz.

    Blocks are coloured by what they are for; wires that carry vectors are solid and
    blue, those that carry abstract values dashed and brown.
    """
    # Where its X11 libraries are missing, all but this one picture can be drawn.
    import pygraphviz  # type: ignore[import-untyped]

    blocks, wires = topology(diagram)
    graph = pygraphviz.AGraph(directed=True, strict=False)
    graph.graph_attr.update(
        rankdir="LR",
        ranksep="1.1",
        nodesep="0.25",
        fontname="Helvetica",
        label=_legend(title),
        labelloc="b",
    )
    graph.node_attr.update(shape="plain", fontname="Helvetica", fontsize="11")
    graph.edge_attr.update(arrowsize="0.6", penwidth="1.2")
    for block in blocks:
        graph.add_node(block.name, label=_label(block))
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
                f"{escape(ports[row])}</TD>"
            )
            if row < len(ports)
            else "<TD></TD>"
            for key, side, ports in (
                ("i", "LEFT", block.inputs),
                ("o", "RIGHT", block.outputs),
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


def _legend(title: str) -> str:
    return (
        f'<<FONT POINT-SIZE="11">{escape(title)}: '
        f'<FONT COLOR="{VECTOR_COLOR}">&#8212;&#8212; vector</FONT>   '
        f'<FONT COLOR="{ABSTRACT_COLOR}">- - - abstract value</FONT></FONT>>'
    )
