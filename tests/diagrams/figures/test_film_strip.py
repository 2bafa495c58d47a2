"""The film strip of a run, rendered without a display."""

import logging
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread

from footfall.diagrams.figures.crossing_data import planned_crossings
from footfall.diagrams.figures.film_strip import (
    FALL_SHOWN,
    render_run,
    spread,
    with_fall,
)
from footfall.diagrams.figures.rendering import (
    CROSSING_VIEW,
    HEIGHT,
    WIDTH,
    look_at,
    render_states,
    turned,
)
from footfall.diagrams.scenario import save_scenario
from footfall.diagrams.signal_names import PLAN_SIGNAL
from footfall.diagrams.signals import Run, RunError, load_run
from footfall.diagrams.simulation import run_task
from footfall.models.scenes.mover import MoverParams


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


def test_the_robot_is_in_the_picture(run_folder, caplog) -> None:
    """Its orange parts are; Drake's warnings of its materials are not passed on."""
    run = load_run(run_folder)
    state = run.signals["plant.state"].to_numpy(dtype=np.float64)[:1, 1:]
    drake = logging.getLogger("drake")
    drake.addHandler(caplog.handler)
    try:
        (picture,) = render_states(run, state)
    finally:
        drake.removeHandler(caplog.handler)
    assert caplog.records == []
    assert picture.shape == (HEIGHT, WIDTH, 3)
    colour = picture.astype(int)
    orange = colour[:, :, 0] - colour[:, :, 2] > 80
    assert orange.sum() > 3000


def test_a_crossing_is_shown_with_a_step_before_and_after(
    crossed_folder, monkeypatch, tmp_path
) -> None:
    """The obstacle is in every picture of phases 1 to 3, from its own side."""
    taken = []

    def pictures(run, states, view, movers):
        assert movers is None
        taken.append((states, view))
        return list(render_states(run, states[2:3], view)) * len(states)

    monkeypatch.setattr("footfall.diagrams.figures.film_strip.render_states", pictures)
    render_run(crossed_folder, frames=5)
    ((states, view),) = taken
    (plan,) = planned_crossings(load_run(crossed_folder).values(PLAN_SIGNAL))
    time = load_run(crossed_folder).signals["plant.state"]
    rows = [int((abs(time.iloc[:, 1:] - row).sum(axis=1)).argmin()) for row in states]
    moments = time["time"].to_numpy()[rows]
    assert moments[[0, -1]] == pytest.approx(plan.stretch(), abs=0.01)
    np.testing.assert_allclose(view[:2], CROSSING_VIEW[:2], atol=0.01)
    (picture,) = render_states(load_run(crossed_folder), states[2:3], view)
    red, green, _ = picture.astype(int).transpose(2, 0, 1)
    obstacle = (red - green > 15) & (red < 170) & (red - green < 60)
    assert obstacle.sum() > 1500


def test_pictures_are_spread_over_the_motions() -> None:
    """None is spent on the scan between two of them."""
    moments = spread([(1.0, 3.0), (10.0, 12.0)], 5)
    assert moments.tolist() == [1.0, 2.0, 3.0, 11.0, 12.0]
    assert spread([(4.0, 6.0)], 1).tolist() == [4.0]


def test_a_fall_is_shown_whenever_it_happens() -> None:
    """In a scan long after the last motion, in the midst of one, and at once."""
    assert with_fall([(1.0, 3.0), (10.0, 12.0)], 20.0) == [
        *((1.0, 3.0), (10.0, 12.0), (20.0 - FALL_SHOWN, 20.0))
    ]
    assert with_fall([(1.0, 3.0), (10.0, 20.0)], 20.0) == [(1.0, 3.0), (10.0, 20.0)]
    assert with_fall([(1.0, 3.0)], 3.0) == [(0.0, 3.0)]


def test_boxes_that_move_are_where_they_were(standing, tmp_path) -> None:
    """One beside the robot hides what is behind it only once it has come."""
    movers = [MoverParams(name="cart", x=-3.0, y=0.6, size=[0.5, 0.3, 1.2])]
    scene = replace(standing.scenario().scene, movers=movers)
    scenario = replace(standing.scenario(), scene=scene)
    save_scenario(scenario, tmp_path / "scenario.yaml")
    task = standing.task()
    state = task.plant.GetPositionsAndVelocities(
        task.plant.CreateDefaultContext(), task.robot_instance
    )
    states = np.tile(state, (3, 1))
    places = np.array([[-3.0, 0.6], [-3.0, 0.6], [0.0, 0.6]])
    away, still, near = render_states(Run(tmp_path), states, movers=places)
    np.testing.assert_array_equal(away, still)
    assert (np.abs(near.astype(int) - away).max(axis=2) > 20).mean() > 0.03


def test_the_camera_turns_with_the_obstacle() -> None:
    """A quarter turn to the left."""
    np.testing.assert_allclose(
        turned(np.array([1.0, -2.0, 0.5]), np.pi / 2), [2, 1, 0.5]
    )


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
