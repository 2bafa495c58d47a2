"""Bounds of a number, and the keys under which a field's metadata hold such limits."""

import math
import numbers
from dataclasses import dataclass

BOUNDS, CHOICES, SHARED = "bounds", "choices", "shared"
"""Keys of a field's metadata: what it may be, and which field it takes its value of."""


@dataclass(frozen=True)
class Bounds:
    """What a number, or each number of a list, may be."""

    unit: str
    """Empty where it has none."""
    above: float
    """It exceeds this."""
    least: float
    below: float
    """It is less than this."""
    most: float
    length: int | None
    """Of a list; None for any."""
    fewest: int
    """A list has at least so many elements."""

    def check(self, field: str, value: float, whole: bool) -> None:
        """Checks one number.

        Args:
            field: its name.
            value: the number.
            whole: whether it counts something.

        Raises:
            ValueError: it is no finite number within the bounds.
        """
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise ValueError(f"{field}: must be a number, got {value!r}")
        if not math.isfinite(value):
            reason = "finite"
        elif whole and not isinstance(value, numbers.Integral):
            reason = "a whole number"
        elif not value > self.above:
            more = f"more than {self._shown(self.above)}"
            reason = more if self.above else "positive"
        elif not value >= self.least:
            reason = f"at least {self._shown(self.least)}"
        elif not value < self.below:
            reason = f"less than {self._shown(self.below)}"
        elif not value <= self.most:
            reason = f"at most {self._shown(self.most)}"
        else:
            return
        raise ValueError(f"{field}: must be {reason}, got {self._shown(value)}")

    def interval(self) -> str:
        """The bounds as an interval without its unit, e.g. "(0, 1000]"."""
        low, high = f"[{_plain(self.least)}", f"{_plain(self.most)}]"
        if self.above >= self.least:
            low = f"({_plain(self.above)}"
        if self.below <= self.most:
            high = f"{_plain(self.below)})"
        return f"{low}, {high}"

    def _shown(self, value: float) -> str:
        return f"{value:g} {self.unit}".rstrip()


def _plain(value: float) -> str:
    """A bound without an exponent where it is a whole number."""
    return f"{value:.0f}" if float(value).is_integer() else f"{value:g}"
