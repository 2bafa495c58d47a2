"""The block diagram: the wiring as it is, as a picture that parses."""

from xml.etree import ElementTree as ET

import numpy as np
from pydrake.systems.framework import DiagramBuilder, LeafSystem
from pydrake.systems.primitives import ConstantVectorSource

from footfall.diagrams.figures.block_diagram import (
    ABSTRACT_COLOR,
    VECTOR_COLOR,
    Wire,
    block_diagram_svg,
    topology,
)


class Twin(LeafSystem):
    """Takes and gives a `value`.

    .. pydrake_system::

        name: Twin
        input_ports:
        - value
        output_ports:
        - value
    """

    def __init__(self) -> None:
        super().__init__()
        self.DeclareVectorInputPort("value", 1)
        self.DeclareStateOutputPort("value", self.DeclareDiscreteState(1))


def test_topology_is_that_of_the_diagram(standing) -> None:
    """Every system but the log sinks, every wire between them."""
    blocks, wires = topology(standing.task().diagram)
    kinds = {block.name: block.kind for block in blocks}
    assert kinds == {
        "plant": "MultibodyPlant",
        "scene_graph": "SceneGraph",
        "posture": "ConstantVectorSource",
        "executive": "Clock",
        "contact_monitor": "ContactMonitor",
        "speed_monitor": "SpeedMonitor",
        "station": "FootWrenchSensor",
        "kinematic_state": "KinematicState",
    }
    assert Wire("posture", "y0", "plant", "jvrc1_desired_state", False) in wires
    results = ("plant", "contact_results")
    assert Wire(*results, "station", "contact_results", True) in wires
    assert Wire(*results, "contact_monitor", "contact_results", True) in wires
    station = next(block for block in blocks if block.name == "station")
    assert station.inputs == ("contact_results", "foot_poses")


def test_picture_shows_every_block_and_wire(standing) -> None:
    """Vectors and abstract values are told apart by colour and dashes."""
    blocks, wires = topology(standing.task().diagram)
    picture = ET.fromstring(block_diagram_svg(standing.task().diagram, "a <title>"))
    assert picture.tag.endswith("svg")
    texts = {text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")}
    assert {block.name for block in blocks} <= texts
    assert any("a <title>" in (text or "") for text in texts)
    paths = [
        path.attrib
        for group in picture.iter("{http://www.w3.org/2000/svg}g")
        if group.get("class") == "edge"
        for path in group.iter("{http://www.w3.org/2000/svg}path")
    ]
    colors = [attributes["stroke"] for attributes in paths]
    assert colors.count(ABSTRACT_COLOR) == sum(wire.abstract for wire in wires)
    assert colors.count(VECTOR_COLOR) == sum(not wire.abstract for wire in wires)
    dashed = [a for a in paths if "stroke-dasharray" in a]
    assert {attributes["stroke"] for attributes in dashed} == {ABSTRACT_COLOR}


def test_what_nothing_is_connected_to_is_told_for_each_side() -> None:
    """A port may bear the same name on both: one is used, the other is not."""
    builder = DiagramBuilder()
    source = builder.AddNamedSystem("source", ConstantVectorSource(np.zeros(1)))
    hold = builder.AddNamedSystem("hold", Twin())
    builder.Connect(source.get_output_port(), hold.GetInputPort("value"))
    blocks, _ = topology(builder.Build())
    block = next(block for block in blocks if block.name == "hold")
    assert (block.inputs, block.outputs) == (("value",), ("value",))
    assert (block.open_inputs, block.open_outputs) == (frozenset(), {"value"})
