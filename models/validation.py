"""Checks that parameters share, so that every message reads "field: reason, got x"."""

import math
from collections.abc import Sequence


def require_finite(field: str, value: float, unit: str = "") -> None:
    """Raises ValueError unless the value is a finite number."""
    if not math.isfinite(value):
        raise ValueError(f"{field}: must be finite, got {_with_unit(value, unit)}")


def require_positive(field: str, value: float, unit: str = "") -> None:
    """Raises ValueError unless the value is finite and greater than zero."""
    require_finite(field, value, unit)
    if not value > 0.0:
        raise ValueError(f"{field}: must be positive, got {_with_unit(value, unit)}")


def require_at_least(field: str, value: float, least: float, unit: str = "") -> None:
    """Raises ValueError unless the value is finite and no less than `least`."""
    require_finite(field, value, unit)
    if not value >= least:
        raise ValueError(
            f"{field}: must be at least {_with_unit(least, unit)}, "
            f"got {_with_unit(value, unit)}"
        )


def require_length(field: str, value: Sequence[float], length: int) -> None:
    """Raises ValueError unless the value has `length` elements."""
    if len(value) != length:
        raise ValueError(f"{field}: must have {length} elements, got {len(value)}")


def require_one_of(field: str, value: str, choices: Sequence[str]) -> None:
    """Raises ValueError unless the value is one of the choices."""
    if value not in choices:
        raise ValueError(f"{field}: must be one of {', '.join(choices)}, got {value!r}")


def _with_unit(value: float, unit: str) -> str:
    return f"{value:g} {unit}".rstrip()
