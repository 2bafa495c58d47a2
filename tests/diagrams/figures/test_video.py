"""A run as a video."""

import subprocess

import imageio_ffmpeg
import numpy as np
import pytest

from footfall.diagrams.figures.video import FRAME_RATE, SIZE, render_video, steady
from footfall.diagrams.signals import RunError
from footfall.diagrams.simulation import run_task


@pytest.fixture
def run_folder(tmp_path, standing):
    """A run of a moment in front of a staircase."""
    scenario = standing.scenario()
    run_task(standing.task(end=0.01, scene=scenario.scene), scenario, tmp_path / "run")
    return tmp_path / "run"


def test_a_video_plays_as_fast_as_the_robot_moved(run_folder, tmp_path) -> None:
    """With the robot in it; nothing is left beside it."""
    told = []
    out = tmp_path / "videos" / "run.mp4"
    path = render_video(run_folder, out, 0.0, 0.2, lambda *a: told.append(a))
    assert path == out
    assert [file.name for file in out.parent.iterdir()] == ["run.mp4"]
    assert told == [(number, 5) for number in range(1, 6)]
    assert imageio_ffmpeg.count_frames_and_secs(out) == (5, 5 / FRAME_RATE)
    decode = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", "-i", str(out)]
    decode += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    decoded = subprocess.run(decode, capture_output=True, check=True)
    assert decoded.stderr == b""
    pictures = np.frombuffer(decoded.stdout, np.uint8).reshape(5, *SIZE, 3)
    color = pictures[-1].astype(int)
    orange = color[:, :, 0] - color[:, :, 2] > 60
    assert orange.sum() > 6000


def test_what_cannot_be_rendered_leaves_no_file(run_folder, tmp_path) -> None:
    """Nothing between two moments; a frame that fails."""

    def broken(done, of):
        raise RuntimeError("broken")

    with pytest.raises(RunError, match="nothing to render between 3 and"):
        render_video(run_folder, tmp_path / "v" / "a.mp4", start=3.0)
    with pytest.raises(RuntimeError, match="broken"):
        render_video(run_folder, tmp_path / "v" / "a.mp4", 0.0, 0.1, broken)
    assert list((tmp_path / "v").iterdir()) == []


def test_the_camera_does_not_sway() -> None:
    """It stays where the robot stays, and follows where it goes, half a step wide."""
    time = np.arange(0.0, 10.0, 1.0 / FRAME_RATE)
    path = np.column_stack(
        [0.3 * time, 0.06 * np.sin(2 * np.pi * time / 1.5), 0 * time]
    )
    followed = steady(path)
    middle = (time > 1.0) & (time < 9.0)
    np.testing.assert_allclose(followed[middle, 0], path[middle, 0], atol=0.01)
    assert np.abs(followed[middle, 1]).max() < 0.003
