"""A mean over the last stretch of time, whatever the step it is sampled at."""

import numpy as np

from footfall.models.values.vector import Vector


def window_weights(window: float, step: float) -> Vector:
    """Weights of the samples of a moving mean, the latest first, (n,), sum 1.

    Every sample stands for the step that led to it. Where the window is no multiple of
    the step, the oldest sample counts with the share of it that lies inside; a step
    longer than the window is averaged over itself.

    Args:
        window: s.
        step: between samples, s.
    """
    steps = max(window / step, 1.0)
    whole = int(np.floor(steps + 1e-9))
    rest = steps - whole
    weights = np.ones(whole + (rest > 1e-9))
    if rest > 1e-9:
        weights[-1] = rest
    return np.asarray(weights / steps)
