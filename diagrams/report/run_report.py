"""A run as one page: what happened, pictures, figures and how to repeat it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from footfall.diagrams.figures.captions import (
    CAPTIONS,
    FOLDED,
    OVER_TIME,
    Caption,
)
from footfall.diagrams.figures.film_strip import render_run
from footfall.diagrams.figures.illustrations import DIAGRAM_FILE
from footfall.diagrams.figures.replay import replay_run
from footfall.diagrams.figures.run_figures import plot_run
from footfall.diagrams.judge.meanings import summary_meanings
from footfall.diagrams.judge.summary_table import summary_rows
from footfall.diagrams.report.page import (
    PAGE_FILE,
    Picture,
    data_uri,
    packed,
    render_page,
)
from footfall.diagrams.report.repeat import file_command, short_command
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signals import SCENARIO_FILE, load_run
from footfall.models.values.value import Json

APART = "timing_us"
"""The figure that has a table of its own."""
SENTENCES = {
    "completed": "The robot did what it was to do: {}.",
    "failed": "The robot finished, but did not do what it was to do: {}.",
    "fell": "It did not do what it was to do: {}.",
    "infeasible": "The robot refused what it was to do: {}.",
    "timed_out": "The robot ran out of time: {}.",
    "interrupted": "The run was ended early: {}.",
    "cut": "The run broke off: {}.",
}
"""What became of a run, by its outcome; the reason goes in."""


@dataclass(frozen=True)
class FigureRow:
    """Figures of a summary that are explained together."""

    values: tuple[tuple[str, str], ...]
    """Name and value of each, nested ones one by one."""
    meaning: str
    measured: bool


def report_run(folder: Path) -> tuple[Path, list[str]]:
    """Writes a run as one page that needs nothing beside it, `report.html`.

    The film strip, the replay and the figures are drawn anew from the run's signals.
    One that cannot be drawn does not stop the page, which says so.

    Args:
        folder: of the run; one that was cut too.

    Returns:
        The page, and a line for each picture that could not be drawn.

    Raises:
        RunError: the folder holds no run, or its summary is damaged.
        ScenarioError: its scenario cannot be read.
        OSError: the page cannot be written.
    """
    run = load_run(folder)
    summary, scenario = run.summary, run.scenario
    complaints: list[str] = []

    def attempt(name: str, draw: Callable[[Path], Path | list[Path]]) -> list[Path]:
        try:
            drawn = draw(folder)
        except Exception as error:
            reason = " ".join(str(error).split()) or type(error).__name__
            complaints.append(f"no {name}: {reason}")
            return []
        return drawn if isinstance(drawn, list) else [drawn]

    strip = attempt("film strip", render_run)
    replay = attempt("replay", replay_run)
    figures = attempt("figures", plot_run)
    diagram = folder / DIAGRAM_FILE
    rows = figure_rows(summary)
    html = render_page(
        "run.html.j2",
        title=f"{scenario.name}, seed {scenario.simulation.seed}",
        outcome=summary["outcome"],
        description=scenario.description,
        sentence=run_sentence(summary),
        strip=[_picture(path) for path in strip],
        replay=packed(replay[0]) if replay else None,
        figures=[_picture(path) for path in figures],
        measured=[row for row in rows if row.measured],
        unmeasured=[row for row in rows if not row.measured],
        timing=summary.get(APART) or {},
        versions=summary.get("versions") or {},
        meanings={n: m.text for m in summary_meanings() for n in m.names},
        command=short_command(scenario),
        file_command=file_command(folder / SCENARIO_FILE),
        scenario_text=(folder / SCENARIO_FILE).read_text(encoding="utf-8"),
        scenario_uri=data_uri(folder / SCENARIO_FILE),
        diagram=data_uri(diagram) if diagram.exists() else None,
        complaints=complaints,
    )
    path = folder / PAGE_FILE
    with whole_file(path) as partial:
        partial.write_text(html, encoding="utf-8")
    return path, complaints


def run_sentence(summary: Mapping[str, Json]) -> str:
    """Says in a sentence or two what happened in a run.

    Args:
        summary: what `summary.json` holds, or less of a run that was cut.
    """
    reason = str(summary["reason"])
    said = SENTENCES[str(summary["outcome"])].format(reason)
    did = []
    for name, one, many in (
        ("footsteps", "took {} footstep", "took {} footsteps"),
        ("steps_climbed", "climbed {} step", "climbed {} steps"),
        ("obstacles_crossed", "stepped over {} obstacle", "stepped over {} obstacles"),
    ):
        count = summary.get(name)
        if isinstance(count, int) and count:
            did.append((one if count == 1 else many).format(count))
    time = summary.get("simulated_time_s")
    if not isinstance(time, int | float):
        return said
    if not did:
        return f"{said} All of it took {time:.1f} s of simulated time."
    text = did[0] if len(did) == 1 else f"{', '.join(did[:-1])} and {did[-1]}"
    return f"{said} It {text} in {time:.1f} s of simulated time."


def figure_rows(summary: Mapping[str, Json]) -> list[FigureRow]:
    """Lists the figures of a summary with their meaning, those that go together once.

    Args:
        summary: what `summary.json` holds; figures that it lacks were not measured.
    """
    rows = []
    for meaning in summary_meanings():
        if meaning.names[0] == APART:
            continue
        given = {name: summary.get(name) for name in meaning.names}
        measured = any(value not in (None, {}) for value in given.values())
        values = [
            row
            for name, value in given.items()
            for row in (summary_rows(name, value) or [(name, "none")])
        ]
        rows.append(FigureRow(tuple(values), meaning.text, measured))
    return rows


def _picture(path: Path) -> Picture:
    name = path.stem
    caption = CAPTIONS[name]
    if name in OVER_TIME:
        caption = Caption(caption.title, f"{caption.text} {FOLDED}")
    return Picture(name, data_uri(path), caption)
