"""What is imported is what is used: no command waits for what it does not need."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SLOW = ("open3d", "dash", "plotly", "scipy.stats")


@pytest.mark.parametrize(
    ("modules", "unused"),
    [
        (
            "footfall.diagrams.cli.app, footfall.diagrams.shipped",
            ("pydrake", "numpy", "scipy", *SLOW),
        ),
        (
            "footfall.diagrams.segmenting",
            ("pandas", "pyarrow", "trimesh", "ompl", *SLOW),
        ),
        ("footfall.diagrams.scenario", ("pandas", "matplotlib", *SLOW)),
        (
            "footfall.diagrams.figures.run_figures, footfall.diagrams.figures.replay, "
            "footfall.diagrams.figures.film_strip",
            SLOW,
        ),
        (
            "footfall.diagrams.closed_loop.tasks, footfall.diagrams.simulation",
            ("matplotlib", *SLOW),
        ),
    ],
)
def test_modules_import_only_what_they_use(
    modules: str, unused: tuple[str, ...]
) -> None:
    """Asked in a process of its own; Open3D, say, takes as long as all else."""
    code = f"import sys, {modules}; print('\\n'.join(sys.modules))"
    run = subprocess.run(
        [sys.executable, "-c", code],
        check=True,
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    assert set(unused) & set(run.stdout.split()) == set()
