"""What the robot's own sensors share: seeded noise, samples that arrive late."""

import math

import numpy as np

from footfall.models.values.vector import Vector

_BLOCK = 512
"""Steps whose noise is drawn at once."""


class NoiseSource:
    """White noise that is a function of the step alone: the same for every context."""

    def __init__(self, seed: int, stream: str, size: int) -> None:
        """Draws nothing yet.

        Args:
            seed: of the run.
            stream: a name, by which the sensors' noises differ.
            size: numbers a step.
        """
        self._entropy = (seed, *stream.encode())
        self._size = size
        self._number = -1
        self._block: Vector = np.zeros((0, size))

    def at(self, step: int) -> Vector:
        """Standard normal numbers of a step, (size,), from step 0."""
        number, row = divmod(step, _BLOCK)
        if number != self._number:
            rng = np.random.default_rng((*self._entropy, number))
            self._block = rng.standard_normal((_BLOCK, self._size))
            self._number = number
        drawn: Vector = self._block[row]
        return drawn


def latency_steps(latency: float, period: float) -> int:
    """Counts the samples that lie between sampling and arrival, at least one.

    A sensor samples with the plant's step; who asks at the next one is told.

    Args:
        latency: s.
        period: of sampling, s.
    """
    return max(1, math.ceil(latency / period - 1e-9))


def shifted(samples: Vector, newest: Vector) -> Vector:
    """Puts a sample behind those before it; the oldest, at the front, is dropped.

    Args:
        samples: (steps, size).
        newest: (size,).
    """
    if len(samples) == 1:
        return newest[np.newaxis]
    return np.vstack([samples[1:], newest])
