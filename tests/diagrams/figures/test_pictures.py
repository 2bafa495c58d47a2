"""Figures and replay of a run, each made from its folder alone."""

import numpy as np
import pytest
from matplotlib.image import imread
from pydrake.geometry import MeshcatAnimation

from footfall.diagrams.figures.illustrations import illustrate
from footfall.diagrams.figures.replay import (
    FRAME_RATE,
    MAX_FRAMES,
    OPEN_CONTROLS,
    frame_times,
    replay_html,
    replay_run,
)
from footfall.diagrams.figures.replay_overlays import read_overlays
from footfall.diagrams.figures.run_figures import balance_figure, plot_run, top_view
from footfall.diagrams.run_data import read_run_data
from footfall.diagrams.signals import RunError
from footfall.diagrams.simulation import run_task
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.scenes.scene import SceneParams


@pytest.fixture
def run_folder(tmp_path, standing):
    """A run of half a second in front of a staircase."""
    scenario = standing.scenario()
    task = standing.task(end=0.01, scene=scenario.scene)
    run_task(task, scenario, tmp_path / "run")
    return tmp_path / "run"


def test_figures_are_drawn(run_folder) -> None:
    """Each is a picture with something in it."""
    paths = plot_run(run_folder)
    names = {path.name for path in paths}
    assert names == {f"{n}.png" for n in ("balance", "feet", "joints", "top_view")} | {
        "side_view.png"
    }
    assert all(path.parent == run_folder / "figures" for path in paths)
    for path in paths:
        pixels = imread(path)
        assert pixels.shape[0] > 500
        assert pixels.shape[1] > 800
        assert np.ptp(pixels[:, :, :3]) > 0.5
    assert {path.name for path in (run_folder / "figures").iterdir()} == names


def test_figures_for_papers_are_vector_graphics(run_folder) -> None:
    """Text stays text, and the same run gives the same file."""
    paths = plot_run(run_folder, ("pdf", "svg"))
    assert {path.suffix for path in paths} == {".pdf", ".svg"}
    assert len(paths) == 2 * len({path.stem for path in paths})
    svg = run_folder / "figures" / "joints.svg"
    assert "torque / limit" in svg.read_text(encoding="utf-8")
    pdf = run_folder / "figures" / "joints.pdf"
    assert pdf.read_bytes().startswith(b"%PDF")
    assert b"/FontFile2" in pdf.read_bytes()
    assert not list((run_folder / "figures").glob("*.png"))
    before = {path: path.read_bytes() for path in paths}
    plot_run(run_folder, ("pdf", "svg"))
    assert [path for path in paths if path.read_bytes() != before[path]] == []
    with pytest.raises(ValueError, match="must be of png, pdf, svg, got tiff"):
        plot_run(run_folder, ("svg", "tiff"))


def test_a_crossing_adds_the_obstacle_papers_figures(crossed_folder) -> None:
    """By the numbers they have there."""
    names = {path.name for path in plot_run(crossed_folder)}
    assert {
        "fig5_stick_diagram.png",
        "fig7_adaptation.png",
        "fig8_ahead.png",
        "fig9_sideways.png",
    } < names
    for name in names:
        assert np.ptp(imread(crossed_folder / "figures" / name)[:, :, :3]) > 0.5


def test_the_balance_figure_ends_at_the_summarys_error(crossed_folder) -> None:
    """Its lowest panel peaks at `max_dcm_error_m`; the one above is the true height."""
    data = read_run_data(crossed_folder)
    axes = balance_figure(data).axes
    (error,) = axes[3].get_lines()
    peak = float(np.max(error.get_ydata()))
    assert peak == pytest.approx(1e3 * data.run.summary["max_dcm_error_m"])
    true, wanted = axes[2].get_lines()
    np.testing.assert_array_equal(true.get_ydata(), data.motion.com[:, 2])
    assert np.abs(np.mean(wanted.get_ydata()) - np.mean(true.get_ydata())) < 0.01


@pytest.mark.parametrize("length", [0.1, 35.8, 90.31, 300.0])
def test_no_frame_of_a_replay_is_left_out(length) -> None:
    """Drake's own count of the frames is ours."""
    rate = min(FRAME_RATE, MAX_FRAMES / length)
    recording = MeshcatAnimation(rate)
    frames = [recording.frame(time) for time in frame_times(0.0, length, rate)]
    assert frames == list(range(len(frames)))
    assert len(frames) == pytest.approx(rate * length, abs=1.01)


def test_the_replay_shows_what_was_seen_and_planned(crossed_folder) -> None:
    """The obstacle's top, as high as it is, before the first step that is planned."""
    overlays = read_overlays(read_run_data(crossed_folder))
    seen = next(one for one in overlays.seen if len(one.edges))
    assert any(abs(edge[:, 2] - 0.15).max() < 0.01 for edge in seen.edges)
    assert len(overlays.footholds) > 5
    assert {step.foot for step in overlays.footholds} == {"left", "right"}
    assert seen.time <= overlays.footholds[0].time


def test_the_top_view_shows_the_obstacle_as_it_was_seen(crossed_folder) -> None:
    """Its outline lies about the true one, 1.2 m across."""
    (ax,) = top_view(read_run_data(crossed_folder)).axes
    (seen,) = (p for p in ax.patches if p.get_label() == "obstacle seen")
    corners = seen.get_xy()
    np.testing.assert_allclose(corners.min(axis=0), [1.175, -0.6], atol=0.02)
    np.testing.assert_allclose(corners.max(axis=0), [1.225, 0.6], atol=0.02)


def test_figures_do_without_what_was_not_logged(run_folder) -> None:
    """All but the state may be missing."""
    for path in (run_folder / "signals").iterdir():
        if path.stem != "plant.state":
            path.unlink()
    assert len(plot_run(run_folder)) == 5
    (run_folder / "signals" / "plant.state.parquet").unlink()
    for make in (plot_run, replay_run):
        with pytest.raises(RunError, match=r"run: the run did not log plant\.state"):
            make(run_folder)


def test_replay_opens_without_a_server(run_folder) -> None:
    """One file that loads nothing and holds the robot, the stairs and the motion."""
    path = replay_run(run_folder)
    text = path.read_text()
    assert path == run_folder / "replay.html"
    assert f"{OPEN_CONTROLS}</body>" in path.read_text()
    assert 'src="http' not in text
    assert text.count("data:application/octet-binary;base64") > 40
    assert not list(run_folder.glob("*.partial"))


def test_long_runs_are_recorded_at_fewer_frames(standing) -> None:
    """So that the page of a run of five minutes stays below 15 MB."""
    task = standing.task()
    state = task.plant.GetPositionsAndVelocities(
        task.plant.CreateDefaultContext(), task.robot_instance
    )
    time = np.linspace(0.0, 300.0, 2 * MAX_FRAMES)
    page = replay_html(JVRC1, SceneParams(), time, np.tile(state, (len(time), 1)))
    assert len(page) < 15e6


def test_replay_of_another_robot_is_refused() -> None:
    """Its state has another size."""
    with pytest.raises(ValueError, match=r"state: expected shape \(2, 77\), got"):
        replay_html(JVRC1, SceneParams(), np.zeros(2), np.zeros((2, 10)))


def test_a_picture_that_fails_does_not_stop_the_others(
    run_folder, standing, monkeypatch
) -> None:
    """It is named."""

    def broken(_: object) -> None:
        raise RuntimeError("no\nink")

    monkeypatch.setattr("footfall.diagrams.figures.illustrations.plot_run", broken)
    complaints = illustrate(run_folder, standing.task().diagram)
    assert complaints == ["no figures: RuntimeError: no ink"]
    assert (run_folder / "replay.html").exists()
    assert (run_folder / "diagram.svg").exists()
    assert not (run_folder / "figures").exists()
