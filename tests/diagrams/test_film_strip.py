"""The film strip of a run, rendered without a display."""

import numpy as np
import pytest
from matplotlib.image import imread

from diagrams.film_strip import HEIGHT, WIDTH, look_at, render_run, render_states
from diagrams.signals import RunError, load_run
from diagrams.simulation import run_task


@pytest.fixture
def run_folder(tmp_path, standing):
    """A run of half a second in front of a staircase."""
    scenario = standing.scenario()
    task = standing.task(end=0.01, scene=scenario.scene)
    run_task(task, scenario, tmp_path / "run")
    return tmp_path / "run"


def test_strip_is_a_picture(run_folder) -> None:
    """Seven pictures in two rows."""
    path = render_run(run_folder, frames=7)
    assert path == run_folder / "figures" / "film_strip.png"
    pixels = imread(path)
    assert np.ptp(pixels[:, :, :3]) > 0.5
    assert pixels.shape[0] > 600
    assert pixels.shape[1] > 1200


def test_the_robot_is_in_the_picture(run_folder) -> None:
    """Its orange parts are, and move up with it."""
    run = load_run(run_folder)
    state = run.signals["plant.state"].to_numpy(dtype=np.float64)[:1, 1:]
    (picture,) = render_states(run, state)
    assert picture.shape == (HEIGHT, WIDTH, 3)
    colour = picture.astype(int)
    orange = colour[:, :, 0] - colour[:, :, 2] > 80
    assert orange.sum() > 3000


def test_camera_looks_at_its_target() -> None:
    """Z ahead, y down."""
    target, camera = np.array([1.0, 2.0, 3.0]), np.array([2.0, 0.0, 3.5])
    X_WC = look_at(camera, target)
    p_C = X_WC.inverse().multiply(target)
    np.testing.assert_allclose(p_C[:2], 0.0, atol=1e-12)
    assert p_C[2] == pytest.approx(np.linalg.norm(target - camera))
    assert X_WC.rotation().matrix()[2, 1] < -0.9


def test_nothing_to_render_is_told(run_folder) -> None:
    """An empty stretch, a run without state, no run."""
    with pytest.raises(RunError, match="nothing to render between 3 and"):
        render_run(run_folder, start=3.0)
    (run_folder / "signals" / "plant.state.parquet").unlink()
    with pytest.raises(RunError, match=r"did not log plant\.state"):
        render_run(run_folder)
    with pytest.raises(RunError):
        render_run(run_folder / "nowhere")
