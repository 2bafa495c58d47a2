"""Bounds that parameters state beside their fields, and the one check of them.

A parameter class derives from `Parameters` and says with each default what unit the
field has and what it may be:

    rise: float = number(0.20, "m", above=0.0)

Every message reads "field: reason, got x".
"""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from footfall.models.values.bounds import BOUNDS, CHOICES, SHARED, Bounds
from footfall.models.values.description import ClassDocument

T = TypeVar("T")
P = TypeVar("P", bound="Parameters")

LARGEST = {"m": 1e3, "s": 1e5, "rad": 2.0 * math.pi, "deg": 360.0, "m/s": 100.0}
"""By unit, what no quantity of a robot and its surroundings exceeds either way."""
LARGEST_OF_OTHERS = 1e6
"""The same for every other unit, and for what has none."""
RIGHT_ANGLE = math.pi / 2.0
"""rad."""
MAX_SEED = 2**31 - 1


def number(
    default: T,
    unit: str = "",
    *,
    above: float = -math.inf,
    least: float | None = None,
    below: float = math.inf,
    most: float | None = None,
    length: int | None = None,
    fewest: int = 0,
    shared: str = "",
) -> T:
    """Declares a number of a parameter class, or a list of numbers.

    Args:
        default: what it is unless given; a list is copied.
        unit: empty where it has none.
        above: it exceeds this.
        least: it is no less than this; minus `LARGEST` of its unit if None.
        below: it is less than this.
        most: it does not exceed this; `LARGEST` of its unit if None.
        length: of a list; None for any.
        fewest: a list has at least so many elements.
        shared: the one field of a scenario that this and others take their value of,
            its path there; see `share`. Empty where it is a field of its own.

    Returns:
        The dataclass field; to a type checker it is the default.
    """
    largest = LARGEST.get(unit, LARGEST_OF_OTHERS)
    bounds = Bounds(
        unit,
        above,
        -largest if least is None else least,
        below,
        largest if most is None else most,
        length,
        fewest,
    )
    metadata = {BOUNDS: bounds, SHARED: shared}
    if isinstance(default, list):
        copied: Any = dataclasses.field(default_factory=default.copy, metadata=metadata)
    else:
        copied = dataclasses.field(default=default, metadata=metadata)
    return cast(T, copied)


def choice(default: str, choices: Sequence[str]) -> str:
    """Declares a text of a parameter class that is one of a few.

    Args:
        default: what it is unless given.
        choices: what it may be.

    Returns:
        The dataclass field; to a type checker it is the default.
    """
    found: Any = dataclasses.field(default=default, metadata={CHOICES: tuple(choices)})
    return cast(str, found)


@dataclass(kw_only=True)
class Parameters:
    """Base of the parameter classes: what their fields state is what they check.

    `help` of a derived class shows the text under each of its fields.
    """

    def __init_subclass__(cls) -> None:
        """Has the class's documentation list the fields when it is asked for."""
        super().__init_subclass__()
        own: Any = ClassDocument(vars(cls).get("__doc__") or "")
        cls.__doc__ = own

    def validate(self) -> None:
        """Checks every field, and those of the parts.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        for item in dataclasses.fields(self):
            value = getattr(self, item.name)
            if BOUNDS in item.metadata and value is not None:
                _check_numbers(item, value)
            elif CHOICES in item.metadata:
                _check_choice(item.name, value, item.metadata[CHOICES])
            elif isinstance(value, list):
                for index, part in enumerate(value):
                    _check_part(f"{item.name}[{index}]", part)
            else:
                _check_part(item.name, value)


def require_at_least(field: str, value: float, least: float, unit: str = "") -> None:
    """Checks an argument that is no field: a finite number, no less than `least`.

    Raises:
        ValueError: "field: reason, got x".
    """
    inf = math.inf
    Bounds(unit, -inf, least, inf, inf, None, 0).check(field, value, False)


def share(params: P, values: Mapping[str, float]) -> P:
    """Gives every shared number its value, in the parts of the parameters too.

    Args:
        params: not changed.
        values: by `shared` path.

    Returns:
        A copy with the values.
    """
    changes: dict[str, Any] = {}
    for item in dataclasses.fields(params):
        value = getattr(params, item.name)
        if item.metadata.get(SHARED):
            changes[item.name] = values[item.metadata[SHARED]]
        elif isinstance(value, Parameters):
            changes[item.name] = share(value, values)
    return dataclasses.replace(params, **changes)


def _check_numbers(item: "dataclasses.Field[Any]", value: Any) -> None:
    """Checks the number or the list of numbers that a field holds."""
    bounds: Bounds = item.metadata[BOUNDS]
    if not isinstance(value, list):
        bounds.check(item.name, value, item.type is int)
        return
    if bounds.length is not None and len(value) != bounds.length:
        raise ValueError(
            f"{item.name}: must have {bounds.length} elements, got {len(value)}"
        )
    if len(value) < bounds.fewest:
        raise ValueError(
            f"{item.name}: must have at least {bounds.fewest} elements, "
            f"got {len(value)}"
        )
    for index, element in enumerate(value):
        bounds.check(f"{item.name}[{index}]", element, False)


def _check_choice(name: str, value: str, choices: Sequence[str]) -> None:
    """Checks that a text is one of a few."""
    if value not in choices:
        raise ValueError(f"{name}: must be one of {', '.join(choices)}, got {value!r}")


def _check_part(name: str, value: object) -> None:
    """Checks the fields of a part, and says of which part a wrong one is."""
    if isinstance(value, Parameters):
        try:
            value.validate()
        except ValueError as error:
            raise ValueError(f"{name}.{error}") from None
