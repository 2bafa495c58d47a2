"""A page about a System, and the list of all of them, as Markdown."""

import inspect
from collections.abc import Iterable, Mapping, Sequence

from pydrake.systems.framework import LeafSystem

from footfall.diagrams.reference.places import Place
from footfall.diagrams.reference.system_docs import SystemDoc


def system_page(
    system: type[LeafSystem], doc: SystemDoc, places: Sequence[Place], picture: str
) -> str:
    """Writes the page of a System.

    Args:
        system: its class.
        doc: what its docstring tells.
        places: where it stands in the closed loops; may be none.
        picture: name of the file that shows its block; empty for none.
    """
    lines = [f"# {doc.name}", "", doc.summary, ""]
    lines += ["```python", f"from {doc.module} import {doc.name}", "```", ""]
    if doc.text:
        lines += [doc.text, ""]
    carries = places[0].carries if places else {}
    for title, ports in (("Inputs", doc.inputs), ("Outputs", doc.outputs)):
        lines += [f"## {title}", ""]
        lines += [*_port_table(ports, doc, carries), ""] if ports else ["None.", ""]
    lines += ["## Where it stands", ""]
    if places:
        lines += ["| closed loop of | part | in the station |", "|---|---|---|"]
        lines += [_place_row(place) for place in places]
        lines += [
            "",
            "[A System of your own](../own_system.md) takes its place where its",
        ]
        lines.append("ports have these names and types, unless a run is judged by it.")
    else:
        lines.append("In none of the shipped closed loops; it is there to build with.")
    if picture:
        lines += ["", f"![{doc.name} and what it is connected to]({picture})"]
    lines += ["", "## To make one", "", "```python", _signature(system), "```", ""]
    made = inspect.getdoc(system.__init__) or ""
    if system.__init__ is not LeafSystem.__init__ and made:
        lines += ["```text", made, "```", ""]
    return "\n".join(lines)


def systems_list(docs: Iterable[SystemDoc]) -> str:
    """Writes the page that leads to those of the Systems, by their folders."""
    lines = ["# Systems", "", "One a file, each alone to be built with; by folder."]
    folders: dict[str, list[SystemDoc]] = {}
    for doc in docs:
        folder = ".".join(doc.module.split(".")[2:-1]) or "systems"
        folders.setdefault(folder, []).append(doc)
    for folder, held in sorted(folders.items()):
        lines += ["", f"## {folder}", "", "| System | does |", "|---|---|"]
        lines += [f"| [{doc.name}]({doc.name}.md) | {doc.summary} |" for doc in held]
    names = sorted(doc.name for held in folders.values() for doc in held)
    return "\n".join([*lines, "", "```{toctree}", ":hidden:", "", *names, "```", ""])


def _port_table(
    ports: Iterable[str], doc: SystemDoc, carries: Mapping[str, str]
) -> list[str]:
    """Lists ports; what they carry where it is known."""
    if not carries:
        rows = [f"| `{port}` | {doc.ports[port]} |" for port in ports]
        return ["| port | what |", "|---|---|", *rows]
    rows = [f"| `{port}` | {carries[port]} | {doc.ports[port]} |" for port in ports]
    return ["| port | carries | what |", "|---|---|---|", *rows]


def _place_row(place: Place) -> str:
    return f"| `{place.loop}` | `{place.name}` | `{place.station}` |"


def _signature(system: type[LeafSystem]) -> str:
    """Writes how one is made, an argument a line where there are several."""
    parameters = list(inspect.signature(system.__init__).parameters.values())[1:]
    if not parameters or system.__init__ is LeafSystem.__init__:
        return f"{system.__qualname__}()"
    body = "".join(f"    {_argument(parameter)},\n" for parameter in parameters)
    return f"{system.__qualname__}(\n{body})"


def _argument(parameter: inspect.Parameter) -> str:
    """Writes an argument with its type's name alone."""
    kind = parameter.annotation
    text = (
        kind.__name__ if inspect.isclass(kind) else str(kind).replace("footfall.", "")
    )
    default = parameter.default
    shown = "" if default is inspect.Parameter.empty else f" = {default!r}"
    return f"{parameter.name}: {text}{shown}"
