"""Thinking takes time: how long, and what holds a result until it is there."""

import dataclasses
from dataclasses import dataclass, field
from math import ceil
from typing import Self

from footfall.models.values.validation import Parameters, number
from footfall.models.values.value import Value

ROUNDING = 1e-6
"""Times that differ by less are the same, s."""


@dataclass(kw_only=True)
class ThinkingParams(Parameters):
    """How long perception and planning take, s of simulated time.

    A result rests on what was sensed when the thinking began and is there at the first
    update after that time. The defaults are the 95th percentiles that
    `tests/benchmarks/thinking_time.py` measured, rounded up to 10 ms; it writes them
    here and, with the machine that it measured on, to `thinking_time.md` beside it.
    """

    segmentation: float = number(0.33, "s", least=0.0)
    """From a finished sweep to the staircase."""
    obstacle_finding: float = number(0.29, "s", least=0.0)
    """From a finished sweep to the obstacles on the floor."""
    room_perception: float = number(0.08, "s", least=0.0)
    """From a frame of the ceiling camera to floor and boxes."""
    climb_planning: float = number(0.48, "s", least=0.0)
    """Footsteps on a staircase and the motion along them."""
    quasi_static_climb_planning: float = number(1.97, "s", least=0.0)
    """The same where the motion is to be quasi-static."""
    crossing_planning: float = number(0.4, "s", least=0.0)
    """Footsteps over obstacles and the motion along them."""
    quasi_static_crossing_planning: float = number(0.35, "s", least=0.0)
    """The same where the motion is to be quasi-static."""
    room_planning: float = number(0.09, "s", least=0.0)
    """A path through a room, the footsteps along it and their motion."""
    stopping: float = number(0.06, "s", least=0.0)
    """A motion that ends a walk early."""


@dataclass(frozen=True, eq=False)
class Thought(Value):
    """Base of a System's state of which the next one may already be worked out."""

    coming: Self | None = field(default=None, kw_only=True)
    """What this becomes; None where nothing is being worked out."""
    ready: float = field(default=0.0, kw_only=True)
    """When it becomes that, s."""

    def until(self, ready: float, coming: Self) -> Self:
        """Keeps this state until a time, s, and another from then on."""
        return dataclasses.replace(self, coming=coming, ready=ready)

    def at(self, time: float) -> Self:
        """Gives the state at a time, s; itself where nothing has come."""
        state = self
        while state.coming is not None and time >= state.ready - ROUNDING:
            state = state.coming
        return state


def ready_time(time: float, latency: float, period: float) -> float:
    """Computes when the result of thinking is there: at an update, as early as may be.

    Args:
        time: of the update at which the thinking begins, s.
        latency: how long it takes, s.
        period: between updates, s.
    """
    return time + ceil((latency - ROUNDING) / period) * period
