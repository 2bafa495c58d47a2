"""A closed loop that is being built: its stations, what is logged, what is added."""

from collections.abc import Mapping, Sequence

from pydrake.systems.framework import (
    Diagram,
    DiagramBuilder,
    OutputPort,
    PortDataType,
    System,
)

from footfall.diagrams.closed_loop.parts import (
    PartError,
    describe,
    input_ports,
    model_value,
    output_ports,
)
from footfall.diagrams.closed_loop.station_builder import Station, connect_stations
from footfall.diagrams.signals import SignalRecorder
from footfall.models.values.value import to_json

SIGNAL_PERIOD = 0.005
"""Between samples of vector signals, s."""
VALUE_PERIOD = 0.025
"""Between looks at abstract signals, s."""


class LoopBuilder:
    """The stations of a closed loop, wired, to which a user may add Systems and logs.

    Every output port is found by the name "SYSTEM.PORT", as `footfall diagram` shows
    them and as signals are called.
    """

    def __init__(self, stations: Sequence[Station]) -> None:
        """Connects the stations.

        Args:
            stations: all that the loop is made of.

        Raises:
            PartError: a signal is given twice, or asked for and given by none.
        """
        self.builder = DiagramBuilder()
        """Holds the stations; for what the methods here do not do."""
        for station in stations:
            name = station.system.get_name()
            self.builder.AddNamedSystem(name, station.system)
        connect_stations(self.builder, stations)
        self.signals = SignalRecorder(self.builder)
        """What is logged."""

    def find_output(self, name: str) -> OutputPort | None:
        """Finds an output port "SYSTEM.PORT"; None where there is none."""
        system, _, port = name.partition(".")
        for candidate in self.builder.GetSystems():
            if candidate.HasOutputPort(name):
                return candidate.GetOutputPort(name)
            if candidate.get_name() == system and candidate.HasOutputPort(port):
                return candidate.GetOutputPort(port)
        return None

    def output(self, name: str) -> OutputPort:
        """Finds an output port "SYSTEM.PORT".

        Raises:
            PartError: there is none; the message lists those of the System, or the
                Systems.
        """
        if (port := self.find_output(name)) is not None:
            return port
        names = {
            found if "." in found else f"{system.get_name()}.{found}"
            for system in self.builder.GetSystems()
            for found in (p.get_name() for p in output_ports(system))
        }
        part = name.partition(".")[0]
        own = sorted(n for n in names if n.partition(".")[0] == part)
        if own:
            raise PartError(f"no output {name!r}; {part} has: {', '.join(own)}")
        parts = ", ".join(sorted({n.partition(".")[0] for n in names}))
        raise PartError(f"no output {name!r}: no part {part!r}; there are: {parts}")

    def add(
        self, name: str, system: System, inputs: Mapping[str, str] | None = None
    ) -> None:
        """Adds a System beside the stations.

        Args:
            name: of the System, by which its ports are then found.
            system: the user's own.
            inputs: by input port the output "SYSTEM.PORT" that it is connected to.

        Raises:
            PartError: the name is taken, a port is not there, or does not fit.
        """
        if any(name == other.get_name() for other in self.builder.GetSystems()):
            raise PartError(f"add: {name}: the name is taken")
        self.builder.AddNamedSystem(name, system)
        for port, source in (inputs or {}).items():
            self.connect(source, f"{name}.{port}")

    def connect(self, source: str, target: str) -> None:
        """Connects an output to an input that is still open, both "SYSTEM.PORT".

        Open are the inputs of Systems that were added, and those that a user's part has
        beyond the ones of ours.

        Raises:
            PartError: a port is not there, is taken, or carries something else.
        """
        output = self.output(source)
        part, _, port = target.partition(".")
        for system in self.builder.GetSystems():
            wanted = port if system.get_name() == part else target
            if system.HasInputPort(wanted):
                break
        else:
            raise PartError(
                f"no input {target!r}; open are: {self._open_inputs() or 'none'}"
            )
        asked = system.GetInputPort(wanted)
        if self.builder.IsConnectedOrExported(asked):
            raise PartError(f"input {target!r} is connected already")
        try:
            self.builder.Connect(output, asked)
        except (RuntimeError, ValueError) as error:
            raise PartError(
                f"{source} ({describe(output)}) cannot be connected to {target} "
                f"({describe(asked)})"
            ) from error

    def log(
        self,
        port: str,
        columns: Sequence[str] | None = None,
        units: Sequence[str] | str = "1",
        *,
        name: str | None = None,
    ) -> None:
        """Logs an output port, a vector at 200 Hz, a value whenever it changes.

        Args:
            port: "SYSTEM.PORT".
            columns: what the elements of a vector are called, by default 0, 1, ...
            units: of each element, or one for all; "1" where there is none.
            name: of the signal, by default that of the port.

        Raises:
            PartError: there is no such port, or its value has no JSON form.
            ValueError: the signal is logged already, or the numbers do not match.
        """
        output = self.output(port)
        if output.get_data_type() == PortDataType.kVectorValued:
            named = tuple(columns or map(str, range(output.size())))
            unit = units if isinstance(units, str) else tuple(units)
            self.signals.add_vector(name or port, output, named, unit, SIGNAL_PERIOD)
            return
        try:
            to_json(model_value(output))
        except TypeError as error:
            raise PartError(f"log: {port}: {describe(output)}: {error}") from error
        self.signals.add_value(name or port, output, VALUE_PERIOD)

    def build(self, name: str) -> Diagram:
        """Builds the diagram.

        Args:
            name: of the diagram.

        Raises:
            PartError: an input is connected to nothing.
        """
        if unconnected := self._open_inputs():
            raise PartError(
                f"connected to nothing: {unconnected}; connect it in `extend`, or name "
                "it as ours is named"
            )
        diagram = self.builder.Build()
        diagram.set_name(name)
        return diagram

    def _open_inputs(self) -> str:
        """Lists the inputs that are connected to nothing, each with what it takes."""
        ports = [
            (port.get_name(), port, system.get_name())
            for system in self.builder.GetSystems()
            for port in input_ports(system)
            if not self.builder.IsConnectedOrExported(port)
        ]
        named = [
            f"{name if '.' in name else f'{system}.{name}'} ({describe(port)})"
            for name, port, system in ports
        ]
        return ", ".join(named)
