"""The pictures of a run: figures, replay and block diagram, each on its own."""

from collections.abc import Callable
from pathlib import Path

from pydrake.systems.framework import Diagram

from diagrams.block_diagram import block_diagram_svg
from diagrams.replay import replay_run
from diagrams.report import plot_run
from diagrams.signals import load_run

DIAGRAM_FILE = "diagram.svg"


def illustrate(folder: Path, diagram: Diagram) -> list[str]:
    """Adds figures, replay and block diagram to a finished run.

    A run that took minutes is worth more than its pictures: one that cannot be drawn
    does not stop the others.

    Args:
        folder: the run folder.
        diagram: the closed loop that was run.

    Returns:
        A line for every picture that could not be drawn.
    """

    def draw_diagram(run: Path) -> None:
        svg = block_diagram_svg(diagram, load_run(run).scenario.name)
        (run / DIAGRAM_FILE).write_text(svg, encoding="utf-8")

    pictures: dict[str, Callable[[Path], object]] = {
        "figures": plot_run,
        "replay": replay_run,
        "block diagram": draw_diagram,
    }
    complaints = []
    for name, draw in pictures.items():
        try:
            draw(folder)
        except Exception as error:
            reason = " ".join(str(error).split())
            complaints.append(f"no {name}: {type(error).__name__}: {reason}")
    return complaints
