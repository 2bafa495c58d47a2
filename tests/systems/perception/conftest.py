"""Synthetic sweeps of a tilting laser scanner before staircases, as fixtures."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.systems.perception.stair_scans import Array, StairScene, scan_scene


@pytest.fixture(scope="session")
def scan() -> Callable[..., Array]:
    """The ray-caster."""
    return scan_scene


@pytest.fixture(scope="session")
def stair_scene() -> type[StairScene]:
    """The description of a scene."""
    return StairScene


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real data; skips the test where it is absent."""
    default = Path(__file__).parents[4] / "shared" / "data"
    folder = Path(os.environ.get("FOOTFALL_DATA", default))
    if not folder.is_dir():
        pytest.skip("no real data: set FOOTFALL_DATA to its folder")
    return folder
