"""A user's own Systems in the places of ours: which part is which, and does it fit."""

import difflib
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from pydrake.systems.framework import InputPort, OutputPort, PortDataType, System


class PartError(ValueError):
    """A part of a user's own does not fit where it is to go."""


class Parts:
    """The Systems that take the places of a closed loop's own, by the parts' names."""

    def __init__(self, replace: Mapping[str, System]) -> None:
        """Remembers them.

        Args:
            replace: by the name of the part that each takes the place of.

        Raises:
            PartError: something in it is no System of doubles.
        """
        for name, system in replace.items():
            if not isinstance(system, System):
                got = type(system).__name__
                made = ", the class and not one of its objects"
                raise PartError(
                    f"replace: {name}: must be a Drake System, got {got}"
                    f"{made if isinstance(system, type) else ''}"
                )
        self._own = dict(replace)
        self._known: set[str] = set()

    def choose(self, name: str, make: Callable[[], System]) -> System:
        """Gives the user's System where there is one by that name, else makes ours."""
        self._known.add(name)
        return self._own[name] if name in self._own else make()

    def own(self, name: str) -> System | None:
        """Finds the user's System of that name."""
        return self._own.get(name)

    def fix(self, name: str, reason: str) -> None:
        """Says of a part that it stays ours.

        Raises:
            PartError: the user has one of his own.
        """
        self._known.add(name)
        if name in self._own:
            raise PartError(f"replace: {name}: cannot be replaced: {reason}")

    def check_all_known(self) -> None:
        """Checks that every part has found its place.

        Raises:
            PartError: there is no part of a name; the message lists those that are.
        """
        for name in self._own.keys() - self._known:
            near = difflib.get_close_matches(name, self._known, 1)
            hint = f", did you mean {near[0]!r}?" if near else ""
            raise PartError(
                f"replace: {name}: this task has no such part{hint}; its parts: "
                f"{', '.join(sorted(self._known))}"
            )

    def named(self) -> dict[str, str]:
        """Gives the class of every part that was replaced, with its module."""
        classes = {name: type(system) for name, system in self._own.items()}
        return {
            name: f"{kind.__module__}.{kind.__qualname__}"
            for name, kind in sorted(classes.items())
        }


def input_ports(system: System) -> list[InputPort]:
    """Lists a System's input ports in their order."""
    return [system.get_input_port(i) for i in range(system.num_input_ports())]


def output_ports(system: System) -> list[OutputPort]:
    """Lists a System's output ports in their order."""
    return [system.get_output_port(i) for i in range(system.num_output_ports())]


def owner(port: InputPort | OutputPort) -> System:
    """Finds the System that a port belongs to."""
    system: System = port.get_system()  # type: ignore[assignment]
    return system


def model_value(port: OutputPort) -> object:
    """Makes a value of the type that an abstract output carries."""
    value: Any = port.Allocate()
    return value.get_value()


def describe(port: InputPort | OutputPort) -> str:
    """Says what a port carries: "vector of 3", "abstract MotionPlan"."""
    if port.get_data_type() == PortDataType.kVectorValued:
        return f"vector of {port.size()}"
    return f"abstract {_carried(port).__name__}"


def _carried(port: InputPort | OutputPort) -> type:
    """Finds the type that an abstract port carries, by its model value."""
    if isinstance(port, OutputPort):
        return type(model_value(port))
    value: Any = owner(port).AllocateInputAbstract(port)
    return type(value.get_value())


def _fits(source: OutputPort | InputPort, target: OutputPort | InputPort) -> bool:
    """Tells whether what one port carries can be taken by the other."""
    if source.get_data_type() != target.get_data_type():
        return False
    if source.get_data_type() == PortDataType.kVectorValued:
        return bool(source.size() == target.size())
    return issubclass(_carried(source), _carried(target))


def list_ports(ports: Iterable[InputPort | OutputPort]) -> str:
    """Lists ports in one line, each with what it carries."""
    return ", ".join(f"{p.get_name()} ({describe(p)})" for p in ports) or "none"


def check_part(name: str, own: System, ours: System) -> None:
    """Checks the ports that a user's System shares with the one whose place it takes.

    What it does not ask for it need not have: an input of ours may be missing, and so
    may an output that nothing takes (see `require_output`).

    Args:
        name: of the part.
        own: the user's.
        ours: the one that would stand there.

    Raises:
        PartError: a port carries something else; in one line with its name and both
            types.
    """
    who = f"replace: {name}: {type(own).__name__}"
    for port in output_ports(ours):
        if not own.HasOutputPort(port.get_name()):
            continue
        mine = own.GetOutputPort(port.get_name())
        if not _fits(mine, port):
            raise PartError(
                f"{who}: its output port {port.get_name()!r} must be "
                f"{describe(port)}, is {describe(mine)}"
            )
    for wanted in input_ports(ours):
        if not own.HasInputPort(wanted.get_name()):
            continue
        asked = own.GetInputPort(wanted.get_name())
        if not _fits(wanted, asked):
            raise PartError(
                f"{who}: its input port {wanted.get_name()!r} is given a "
                f"{describe(wanted)}, is {describe(asked)}"
            )


def require_output(name: str, own: System, wanted: OutputPort) -> OutputPort:
    """Finds the output of a user's System that others take.

    Args:
        name: of the part.
        own: the user's.
        wanted: the output of ours.

    Raises:
        PartError: there is none.
    """
    if not own.HasOutputPort(wanted.get_name()):
        raise PartError(
            f"replace: {name}: {type(own).__name__} has no output port "
            f"{wanted.get_name()!r} ({describe(wanted)}), which others take; its "
            f"outputs: {list_ports(output_ports(own))}"
        )
    return own.GetOutputPort(wanted.get_name())
