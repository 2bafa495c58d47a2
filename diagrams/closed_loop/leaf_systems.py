"""The Systems and the wires of a diagram, those of the diagrams in it too."""

from collections.abc import Iterator
from typing import NamedTuple

from pydrake.systems.framework import (
    Context,
    Diagram,
    InputPort,
    OutputPort,
    PortDataType,
    System,
)

from footfall.systems.ports import eval_vector


class LeafWire(NamedTuple):
    """A connection of two Systems that are no diagrams."""

    source: OutputPort
    target: InputPort


def leaf_systems(diagram: Diagram) -> Iterator[tuple[str, System]]:
    """Finds all Systems that are no diagrams, each with the station that it is in.

    The station is the diagram's subsystem through which it is reached, "" for those
    that the diagram holds itself.
    """
    for system in diagram.GetSystems():
        if isinstance(system, Diagram):
            for _, leaf in leaf_systems(system):
                yield system.get_name(), leaf
        else:
            yield "", system


def find_system(diagram: Diagram, name: str) -> System:
    """Finds a System anywhere in a diagram by its name, a station too.

    Raises:
        LookupError: there is none; the message lists those that there are.
    """
    found = {system.get_name(): system for _, system in leaf_systems(diagram)}
    found |= {system.get_name(): system for system in diagram.GetSystems()}
    if name not in found:
        raise LookupError(f"no system {name!r}; there are: {', '.join(sorted(found))}")
    return found[name]


def eval_output(diagram: Diagram, name: str, root_context: Context) -> object:
    """Evaluates an output port anywhere in a diagram.

    Args:
        diagram: the closed loop.
        name: "SYSTEM.PORT".
        root_context: the diagram's.

    Returns:
        The vector, (n,), or the value.

    Raises:
        LookupError: there is no such port; the message lists those that there are.
    """
    system_name, _, port_name = name.partition(".")
    system = find_system(diagram, system_name)
    if not system.HasOutputPort(port_name):
        ports = [system.get_output_port(i) for i in range(system.num_output_ports())]
        names = ", ".join(port.get_name() for port in ports)
        raise LookupError(f"{system_name} has no output {port_name!r}; it has: {names}")
    port = system.GetOutputPort(port_name)
    context = system.GetMyContextFromRoot(root_context)
    if port.get_data_type() == PortDataType.kVectorValued:
        return eval_vector(port, context)
    return port.Eval(context)


def leaf_wires(diagram: Diagram) -> list[LeafWire]:
    """Lists every connection between Systems that are no diagrams."""
    wires = []
    for target, source in diagram.connection_map().items():
        output = _leaf_output(source[0].get_output_port(int(source[1])))
        inputs = _leaf_inputs(target[0].get_input_port(int(target[1])))
        wires += [LeafWire(output, leaf) for leaf in inputs]
    for system in diagram.GetSystems():
        if isinstance(system, Diagram):
            wires += leaf_wires(system)
    return wires


def _leaf_output(port: OutputPort) -> OutputPort:
    """Finds the port of a leaf System that an output of a diagram exports."""
    system = port.get_system()
    if not isinstance(system, Diagram):
        return port
    inner, index = system.get_output_port_locator(port.get_index())
    return _leaf_output(inner.get_output_port(int(index)))


def _leaf_inputs(port: InputPort) -> list[InputPort]:
    """Finds the ports of leaf Systems that an input of a diagram feeds."""
    system = port.get_system()
    if not isinstance(system, Diagram):
        return [port]
    return [
        leaf
        for inner, index in system.GetInputPortLocators(port.get_index())
        for leaf in _leaf_inputs(inner.get_input_port(int(index)))
    ]
