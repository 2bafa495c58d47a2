"""A run as a video, rendered without a display."""

from collections.abc import Callable
from pathlib import Path

import imageio_ffmpeg
import numpy as np
from scipy.ndimage import uniform_filter1d

from footfall.diagrams.figures.film_strip import shown_part
from footfall.diagrams.figures.rendering import render_states
from footfall.diagrams.run_data import mover_positions
from footfall.diagrams.signal_files import whole_file
from footfall.models.values.vector import Vector

FRAME_RATE = 25
"""Frames a second; the video plays as fast as the robot moved."""
SIZE = (720, 720)
"""Width and height, pixels; encoders want multiples of 16."""
QUALITY = 7
"""Of 10; the variable bit rate of x264 that imageio-ffmpeg makes of it."""
STEADY = 1.5
"""Over so long the robot's path is averaged that the camera follows, s: it does not
sway with every step."""


def render_video(
    folder: Path,
    out: Path,
    start: float | None = None,
    end: float | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Renders a run as an MP4 file (H.264); gives its path.

    Args:
        folder: of the run.
        out: the file; its folder is made if missing.
        start: when it begins, s; None for when the robot first moves or, where it
            crosses obstacles, a step before phase 1.
        end: when it ends, s; None for when the robot last moves or a step after
            phase 3.
        progress: is told after each frame how many there are, and of how many.

    Raises:
        RunError: the folder holds no run, one without the plant's state, or nothing
            between start and end.
        ScenarioError: its scenario cannot be read.
        OSError: the file cannot be written.
    """
    shown = shown_part(folder, start, end)
    first, last = shown.stretches[0][0], shown.stretches[-1][1]
    moments = np.arange(first, last, 1.0 / FRAME_RATE)
    rows = np.minimum(np.searchsorted(shown.time, moments), len(shown.time) - 1)
    frames = render_states(
        shown.run,
        shown.state[rows],
        shown.view,
        mover_positions(shown.run, shown.time[rows]),
        SIZE,
        steady(shown.state[rows, 4:7]),
    )
    out.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(out) as partial:
        writer = imageio_ffmpeg.write_frames(
            str(partial),
            SIZE,
            fps=FRAME_RATE,
            codec="libx264",
            quality=QUALITY,
            ffmpeg_log_level="error",
            # The name does not tell the kind until the file is whole; the index goes
            # first, so that it plays while it loads.
            output_params=["-f", "mp4", "-movflags", "+faststart"],
        )
        writer.send(None)
        try:
            for number, frame in enumerate(frames, start=1):
                writer.send(np.ascontiguousarray(frame))
                if progress is not None:
                    progress(number, len(rows))
        finally:
            writer.close()
    return out


def steady(path: Vector) -> Vector:
    """Averages a path, (n, 3), m, over `STEADY`, so that a camera may follow it."""
    count = max(1, round(STEADY * FRAME_RATE))
    averaged: Vector = uniform_filter1d(path, count, axis=0, mode="nearest")
    return averaged
