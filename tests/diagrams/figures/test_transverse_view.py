"""Support areas and CoM from above, as in the stair paper's Fig. 7."""

import json

import numpy as np
import pytest

from footfall.diagrams.figures.run_figures import plot_run
from footfall.diagrams.figures.transverse_view import support_areas, transverse_view
from footfall.diagrams.run_data import read_run_data
from footfall.diagrams.signal_names import POLYGON_SIGNAL
from footfall.diagrams.simulation import run_task

SQUARE = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]]


@pytest.fixture
def run_folder(tmp_path, standing):
    """A run that stood on a square, drifted a little, then on another, then nowhere."""
    scenario = standing.scenario()
    task = standing.task(end=0.01, scene=scenario.scene)
    run_task(task, scenario, tmp_path / "run")
    drifted = (np.array(SQUARE) + 1e-3).tolist()
    other = (np.array(SQUARE) + np.array([0.3, 0.0])).tolist()
    lines = [
        {"time": time, "value": {"vertices": vertices, "status": "ok", "margin": 0.1}}
        for time, vertices in ((0.0, SQUARE), (0.1, drifted), (0.2, other), (0.3, []))
    ]
    path = tmp_path / "run" / "signals" / f"{POLYGON_SIGNAL}.jsonl"
    path.write_text("\n".join(map(json.dumps, lines)) + "\n")
    return tmp_path / "run"


def test_areas_that_differ_are_drawn_once_each(run_folder) -> None:
    """A drift of a millimetre is no other area, no polygon is none."""
    data = read_run_data(run_folder)
    areas = support_areas(data)
    assert len(areas) == 2
    np.testing.assert_allclose(areas[0], SQUARE)
    (ax,) = transverse_view(data).axes
    outlines = [np.asarray(patch.get_xy()) for patch in ax.patches]
    assert sum(np.allclose(outline[:4], areas[1]) for outline in outlines) == 2
    (line,) = [line for line in ax.lines if line.get_label() == "true CoM"]
    np.testing.assert_allclose(line.get_xydata(), data.motion.com[:, :2])


def test_plot_draws_it_where_polygons_were_logged(run_folder) -> None:
    """Beside the other figures."""
    assert "static_stability.png" in {path.name for path in plot_run(run_folder)}
