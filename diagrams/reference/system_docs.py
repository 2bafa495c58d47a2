"""What the docstring of a System tells of it and of its ports."""

import importlib
import inspect
import pkgutil
import re
from dataclasses import dataclass
from typing import Any

import yaml
from pydrake.systems.framework import LeafSystem

import footfall.systems

BLOCK = re.compile(r"^\.\. pydrake_system::\n\n((?: {4}.*\n|\n)+)", re.MULTILINE)
"""The block that names a System and its ports, in order, as Drake's docstrings do."""
ITEM = re.compile(r"^- (?=.*?`)((?:.*\n)(?: {2}.*\n)*)", re.MULTILINE)
"""An item of the list below it, with the lines that go on with it."""


@dataclass(frozen=True)
class SystemDoc:
    """A System as its docstring tells it."""

    name: str
    module: str
    summary: str
    """What it does, in a line."""
    text: str
    """All else that is said of it, Markdown."""
    inputs: tuple[str, ...]
    """Names of the input ports, in order."""
    outputs: tuple[str, ...]
    ports: dict[str, str]
    """By port what it carries: quantity, frame, shape, unit; Markdown."""


def find_systems() -> list[type[LeafSystem]]:
    """Finds every public LeafSystem that a module under systems/ defines."""
    found = []
    for info in pkgutil.walk_packages(footfall.systems.__path__, "footfall.systems."):
        module = importlib.import_module(info.name)
        found += [
            member
            for name, member in inspect.getmembers(module, inspect.isclass)
            if issubclass(member, LeafSystem)
            and member.__module__ == info.name
            and not name.startswith("_")
        ]
    return sorted(found, key=lambda system: system.__qualname__)


def documented_ports(system: type[LeafSystem]) -> dict[str, Any]:
    """Reads the `.. pydrake_system::` block of a System's docstring.

    Returns:
        `name`, and the ports' names in order as `input_ports` and `output_ports`.

    Raises:
        ValueError: the docstring has no such block.
    """
    block = BLOCK.search(_docstring(system))
    if block is None:
        raise ValueError(f"{system.__qualname__} has no pydrake_system block")
    ports: dict[str, Any] = {"input_ports": [], "output_ports": []}
    ports.update(yaml.safe_load(inspect.cleandoc(block.group(1))))
    return ports


def system_doc(system: type[LeafSystem]) -> SystemDoc:
    """Takes a System's docstring apart.

    Raises:
        ValueError: it does not name the ports.
    """
    named = documented_ports(system)
    text = BLOCK.sub("", _docstring(system), count=1)
    ports: dict[str, str] = {}
    for item in ITEM.findall(text):
        head, _, meaning = item.partition(":")
        told = " ".join(meaning.split())
        names = re.findall(r"`(\w+)`", head)
        known = {*named["input_ports"], *named["output_ports"]}
        if names and set(names) <= known:
            ports |= dict.fromkeys(names, told)
            text = text.replace("- " + item, "", 1)
    summary, _, rest = text.partition("\n")
    return SystemDoc(
        name=system.__qualname__,
        module=system.__module__,
        summary=summary.strip(),
        text=re.sub(r"\n{3,}", "\n\n", rest).strip(),
        inputs=tuple(named["input_ports"]),
        outputs=tuple(named["output_ports"]),
        ports=ports,
    )


def _docstring(system: type[LeafSystem]) -> str:
    return (inspect.getdoc(system) or "") + "\n"
