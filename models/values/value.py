"""Base of the values on abstract ports: frozen, comparable, each with a JSON form.

World frame W: z up. A foot's sole frame F: origin on the sole under the ankle, x to
the toes, z up out of the ground.
"""

import dataclasses
from typing import Self, TypeAlias, cast

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.math import RigidTransform

from footfall.models.values.vector import Vector

Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"


def to_json(value: object) -> Json:
    """Converts a value of this package, or a part of one, to plain JSON data.

    Arrays become nested lists (non-finite numbers become null), poses become
    {"translation": [x, y, z], "quaternion": [w, x, y, z]}, dataclasses become
    objects keyed by field name.

    Raises:
        TypeError: the value has no JSON form.
    """
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, np.ndarray):
        return [to_json(item) for item in value]
    if isinstance(value, list | tuple):
        return [to_json(item) for item in value]
    if isinstance(value, dict):
        return {str(key): to_json(item) for key, item in value.items()}
    if isinstance(value, RigidTransform):
        return {
            "translation": to_json(value.translation()),
            "quaternion": to_json(value.rotation().ToQuaternion().wxyz()),
        }
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {
            item.name: to_json(getattr(value, item.name))
            for item in dataclasses.fields(value)
        }
    raise TypeError(f"{type(value).__name__} has no JSON form")


def pose_from_json(data: Json) -> RigidTransform:
    """Reads the pose that `to_json` wrote."""
    parts = cast(dict[str, list[float]], data)
    wxyz: Vector = np.array(parts["quaternion"], dtype=np.float64)
    p: Vector = np.array(parts["translation"], dtype=np.float64)
    return RigidTransform(Quaternion(wxyz), p)


class Value:
    """Base of the frozen dataclasses below: compares field by field, arrays too."""

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(
            _equal(getattr(self, item.name), getattr(other, item.name))
            for item in dataclasses.fields(self)  # type: ignore[arg-type]
        )

    __hash__ = None  # type: ignore[assignment]

    def __deepcopy__(self, memo: dict[int, object]) -> Self:
        """Returns the value itself: it is immutable, and Drake clones state often."""
        return self

    def to_json(self) -> Json:
        """Converts this value to plain JSON data."""
        return to_json(self)


def _equal(a: object, b: object) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.shape == b.shape and bool(np.array_equal(a, b, equal_nan=True))
    if isinstance(a, RigidTransform) and isinstance(b, RigidTransform):
        return a.IsExactlyEqualTo(b)
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(_equal, a, b))
    return bool(a == b)
