"""The studies that are sweeps can be run: no scenario of them is refused."""

from pathlib import Path

import pytest

from footfall.diagrams.sweep.definition import load_sweep_file
from footfall.diagrams.sweep_command import check_samples

ROOT = Path(__file__).resolve().parents[2]
DEFINITIONS = sorted(
    [*(ROOT / "tests" / "studies").glob("*.yaml"), *(ROOT / "docs/sweeps").glob("*")]
)


def test_there_are_definitions() -> None:
    """They lie where they are looked for."""
    assert len(DEFINITIONS) >= 6


@pytest.mark.parametrize("file", DEFINITIONS, ids=lambda file: file.stem)
def test_every_run_of_a_study_can_be_loaded(file: Path) -> None:
    """What a scenario refuses is found before anybody waits for it."""
    check_samples(load_sweep_file(file), file)
