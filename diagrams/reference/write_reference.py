"""Writes the pages of the documentation that are made from the code."""

from collections.abc import Sequence
from pathlib import Path

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.judge.meanings import meanings_table
from footfall.diagrams.reference.places import places_of
from footfall.diagrams.reference.system_docs import find_systems, system_doc
from footfall.diagrams.reference.system_page import system_page, systems_list
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.shipped import list_scenarios

LOOPS = ("stairs-exp1", "obstacle-15cm", "room-moving", "stand")
"""Scenarios in whose closed loops the Systems are looked for: one a kind of task."""
INDEX, MEANINGS, SCENARIOS = "index.md", "meanings.md", "scenarios.md"


def write_reference(folder: Path, scenarios: Sequence[str] = LOOPS) -> list[Path]:
    """Writes a page a System, their list, what figures mean, and the scenarios.

    Args:
        folder: is made; files of the same names are written anew.
        scenarios: in whose closed loops the Systems are looked for.

    Returns:
        What was written.

    Raises:
        ValueError: a System's docstring does not name its ports.
        OSError: the folder cannot be written to.
    """
    folder.mkdir(parents=True, exist_ok=True)
    loops = {name: build_task(load_scenario(name)).diagram for name in scenarios}
    docs = {system: system_doc(system) for system in find_systems()}
    found = places_of(loops)
    pages = {INDEX: systems_list(docs.values())}
    for system, doc in docs.items():
        places = found.get(system, [])
        picture = f"{doc.name}.svg" if places else ""
        pages[f"{doc.name}.md"] = system_page(system, doc, places, picture)
        if places:
            pages[picture] = places[0].svg
    pages[MEANINGS] = meanings_table() + "\n"
    pages[SCENARIOS] = scenarios_table() + "\n"
    for name, text in pages.items():
        (folder / name).write_text(text, encoding="utf-8")
    return [folder / name for name in pages]


def scenarios_table() -> str:
    """Writes the shipped scenarios as a Markdown table."""
    rows = [f"| `{name}` | {told} |" for name, told in list_scenarios()]
    return "\n".join(["| scenario | the robot |", "|---|---|", *rows])
