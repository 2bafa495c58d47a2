"""Builds a station: a Diagram of named Systems, any of which a user may replace."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from pydrake.systems.framework import (
    DiagramBuilder,
    InputPort,
    OutputPort,
    System,
)

from footfall.diagrams.closed_loop.parts import (
    PartError,
    Parts,
    check_part,
    input_ports,
    list_ports,
    output_ports,
    owner,
    require_output,
)


@dataclass(frozen=True)
class Station:
    """A station of the data flow, ready to be connected to the others."""

    system: System
    """A Diagram, or what a user has put in its place."""
    values: tuple[str, ...] = ()
    """The abstract ports, "SYSTEM.PORT", that a run logs."""


class StationBuilder:
    """Gathers the Systems of a station and the wires between them.

    Ports are named by strings, "SYSTEM.PORT", so that a System that a user has put
    in is wired like ours. The station's own ports carry the names of the signals that
    stations exchange; besides, every output port inside is exported as "SYSTEM.PORT",
    so that it can be logged and connected from outside.
    """

    def __init__(self, name: str, parts: Parts) -> None:
        """Begins an empty station.

        Args:
            name: of the station.
            parts: the user's own Systems.
        """
        self.builder = DiagramBuilder()
        self._name, self._parts = name, parts
        self._ours: dict[str, System] = {}
        self._values: list[str] = []

    def add(self, name: str, make: Callable[[], System]) -> None:
        """Adds a System, or the user's own of that name.

        Args:
            name: of the part.
            make: makes ours.

        Raises:
            PartError: a port of the user's carries something else than ours.
        """
        system = self._parts.choose(name, make)
        if self._parts.own(name) is not None:
            self._ours[name] = make()
            check_part(name, system, self._ours[name])
        self.builder.AddNamedSystem(name, system)

    def connect(self, source: str, *targets: str) -> None:
        """Connects an output of one part to inputs of others, all "SYSTEM.PORT".

        Inputs that a user's own System does not have are passed over.

        Raises:
            PartError: a user's own System has no such output.
        """
        output = self._output(source)
        for target in targets:
            if (port := self._input(target)) is not None:
                self.builder.Connect(output, port)

    def take(self, signal: str, *targets: str) -> None:
        """Makes an input port of the station and connects it to inputs of its parts."""
        ports = [port for target in targets if (port := self._input(target))]
        if ports:
            self.builder.ExportInput(ports[0], signal)
        for port in ports[1:]:
            self.builder.ConnectInput(signal, port)

    def give(self, signal: str, source: str) -> None:
        """Makes an output port of the station from one of its parts'.

        Raises:
            PartError: a user's own System has no such output.
        """
        self.builder.ExportOutput(self._output(source), signal)

    def log(self, *sources: str) -> None:
        """Has abstract output ports, "SYSTEM.PORT", logged when the station runs."""
        self._values.extend(sources)

    def build(self) -> Station:
        """Builds the station; inputs that only a user's System has become its own."""
        for system in self.builder.GetSystems():
            name = system.get_name()
            for port in output_ports(system):
                self.builder.ExportOutput(port, f"{name}.{port.get_name()}")
            for extra in input_ports(system) if name in self._ours else ():
                if not self.builder.IsConnectedOrExported(extra):
                    self.builder.ExportInput(extra, f"{name}.{extra.get_name()}")
        diagram = self.builder.Build()
        diagram.set_name(self._name)
        return Station(diagram, tuple(self._values))

    def _output(self, name: str) -> OutputPort:
        part, _, port = name.partition(".")
        system = self.builder.GetSubsystemByName(part)
        if part not in self._ours:
            return system.GetOutputPort(port)
        return require_output(part, system, self._ours[part].GetOutputPort(port))

    def _input(self, name: str) -> InputPort | None:
        """Finds an input; None where a user's System does not ask for it."""
        part, _, port = name.partition(".")
        system = self.builder.GetSubsystemByName(part)
        if part in self._ours and not system.HasInputPort(port):
            return None
        return system.GetInputPort(port)


def choose_station(name: str, parts: Parts, make: Callable[[], Station]) -> Station:
    """Makes a station, or takes the user's own.

    Args:
        name: of the station.
        parts: the user's own Systems.
        make: makes ours.

    Raises:
        PartError: the user's does not fit.
    """
    ours = make()
    system = parts.choose(name, lambda: ours.system)
    if parts.own(name) is None:
        return ours
    check_part(name, system, ours.system)
    for port in output_ports(ours.system):
        if "." not in port.get_name():
            require_output(name, system, port)
    return Station(system, ours.values)


def connect_stations(builder: DiagramBuilder, stations: Iterable[Station]) -> None:
    """Connects the stations: an input goes to the output of the same name.

    Args:
        builder: of the diagram that holds them.
        stations: all that there are.

    Raises:
        PartError: a signal is given twice, or asked for by a user's part and given by
            none.
    """
    systems = [station.system for station in stations]
    signals: dict[str, OutputPort] = {}
    for system in systems:
        for port in output_ports(system):
            name = port.get_name()
            if "." in name:
                continue
            if name in signals:
                giver = owner(signals[name]).get_name()
                raise PartError(
                    f"signal {name!r}: given by {giver} and by {system.get_name()}"
                )
            signals[name] = port
    for system in systems:
        for wanted in input_ports(system):
            name = wanted.get_name()
            if name in signals:
                builder.Connect(signals[name], wanted)
            elif "." not in name:
                given = list_ports(signals.values())
                raise PartError(
                    f"{system.get_name()}: no station gives its input {name!r}; they "
                    f"give: {given}"
                )
