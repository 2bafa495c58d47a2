"""The pictures of a run: replay, block diagram and figures, each on its own."""

from collections.abc import Callable
from pathlib import Path

from pydrake.systems.framework import Diagram

from footfall.diagrams.figures.block_diagram import block_diagram_svg
from footfall.diagrams.figures.replay import replay_run
from footfall.diagrams.figures.run_figures import plot_run
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signals import load_run

DIAGRAM_FILE = "diagram.svg"


def illustrate(folder: Path, diagram: Diagram) -> list[str]:
    """Adds replay, block diagram and figures to a finished run.

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
        with whole_file(run / DIAGRAM_FILE) as path:
            path.write_text(svg, encoding="utf-8")

    # The slowest last: whoever does not wait for it has the others.
    pictures: dict[str, Callable[[Path], object]] = {
        "replay": replay_run,
        "block diagram": draw_diagram,
        "figures": plot_run,
    }
    complaints = []
    for name, draw in pictures.items():
        try:
            draw(folder)
        except Exception as error:
            reason = " ".join(str(error).split())
            complaints.append(f"no {name}: {type(error).__name__}: {reason}")
    return complaints
