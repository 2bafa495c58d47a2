"""Messages of Foxglove's schemas as plain JSON data, and the schemas themselves.

Foxglove knows what a message is by its schema's name (`foxglove.FrameTransforms`,
`foxglove.SceneUpdate`; docs.foxglove.dev, message schemas). W is the frame `world`.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.colors import to_rgb
from pydrake.math import RigidTransform, RotationMatrix

from footfall.models.scenes.solids import TriangleMesh
from footfall.models.values.vector import Vector

Message: TypeAlias = dict[str, Any]
WORLD = "world"
NANO = 1_000_000_000
LINE_LIST = 2
"""Of a line primitive: pairs of points."""
PRIMITIVES = (
    *("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts"),
    "models",
)
"""What an entity may be made of."""


class Look(NamedTuple):
    """How something is drawn."""

    color: str
    """As matplotlib spells it."""
    alpha: float = 1.0

    def message(self) -> Message:
        """Gives it as `foxglove.Color`."""
        red, green, blue = to_rgb(self.color)
        return {"r": red, "g": green, "b": blue, "a": self.alpha}


def stamp(time: float) -> Message:
    """Splits a time, s, as messages have it."""
    seconds, rest = divmod(nanoseconds(time), NANO)
    return {"sec": seconds, "nsec": rest}


def nanoseconds(time: float) -> int:
    """Rounds a time, s, to whole nanoseconds."""
    return round(time * NANO)


def xyz(point: Vector) -> Message:
    """Names the elements of a point or a vector, (3,)."""
    return dict(zip("xyz", (float(value) for value in point), strict=True))


def pose(X_WA: RigidTransform) -> Message:
    """Gives a pose as `foxglove.Pose`."""
    return {"position": xyz(X_WA.translation()), "orientation": _turn(X_WA.rotation())}


def transforms(time: float, poses: Mapping[str, RigidTransform]) -> Message:
    """Gives poses in W, by the names of their frames, as `foxglove.FrameTransforms`."""
    return {
        "transforms": [
            {
                "timestamp": stamp(time),
                "parent_frame_id": WORLD,
                "child_frame_id": name,
                "translation": xyz(X_WA.translation()),
                "rotation": _turn(X_WA.rotation()),
            }
            for name, X_WA in poses.items()
        ]
    }


def scene_update(time: float, name: str, **primitives: Sequence[Message]) -> Message:
    """Gives an entity in W, which takes the place of one of the same name.

    Args:
        time: from when on it is shown, s.
        name: of the entity.
        primitives: what it is made of, by the names of `PRIMITIVES`.
    """
    made = {kind: list(primitives.get(kind, ())) for kind in PRIMITIVES}
    entity = {
        "timestamp": stamp(time),
        "frame_id": WORLD,
        "id": name,
        "lifetime": stamp(0.0),
        "frame_locked": False,
        "metadata": [],
        **made,
    }
    return {"deletions": [], "entities": [entity]}


def sphere(center: Vector, radius: float, look: Look) -> Message:
    """Gives a sphere about a point in W, (3,), m."""
    size = np.full(3, 2.0 * radius)
    place = pose(RigidTransform(center))
    return {"pose": place, "size": xyz(size), "color": look.message()}


def box(X_WB: RigidTransform, size: Vector, look: Look) -> Message:
    """Gives a box by its pose and its edges, (3,), m."""
    return {"pose": pose(X_WB), "size": xyz(size), "color": look.message()}


def arrow(begin: Vector, span: Vector, radius: float, look: Look) -> Message | None:
    """Gives an arrow from a point along a vector, (3,) each, m; None if that is 0."""
    length = float(np.linalg.norm(span))
    if length == 0.0:
        return None
    along: Vector = span / length
    R_WA = RotationMatrix.MakeFromOneVector(along, 0)
    return {
        "pose": pose(RigidTransform(R_WA, begin)),
        "shaft_length": 0.8 * length,
        "shaft_diameter": 2.0 * radius,
        "head_length": 0.2 * length,
        "head_diameter": 4.0 * radius,
        "color": look.message(),
    }


def lines(ends: Vector, width: float, look: Look) -> Message:
    """Gives line segments by both ends of each, (k, 2, 3), m."""
    return {
        "type": LINE_LIST,
        "pose": pose(RigidTransform()),
        "thickness": width,
        "scale_invariant": False,
        "points": [xyz(point) for point in ends.reshape(-1, 3)],
        "color": look.message(),
        "colors": [],
        "indices": [],
    }


def triangles(mesh: TriangleMesh, look: Look) -> Message:
    """Gives a mesh in W."""
    return {
        "pose": pose(RigidTransform()),
        "points": [xyz(point) for point in mesh.vertices],
        "color": look.message(),
        "colors": [],
        "indices": mesh.triangles.reshape(-1).tolist(),
    }


def _turn(rotation: RotationMatrix) -> Message:
    quaternion = rotation.ToQuaternion()
    return {name: float(getattr(quaternion, name)()) for name in "xyzw"}


def _object(title: str, properties: Mapping[str, Any]) -> Message:
    named = {"title": title} if title else {}
    return {**named, "type": "object", "properties": dict(properties)}


def _array(items: Message) -> Message:
    return {"type": "array", "items": items}


def _numbers(names: Iterable[str]) -> dict[str, Message]:
    return {name: {"type": "number"} for name in names}


_TIME = _object("time", {name: {"type": "integer"} for name in ("sec", "nsec")})
_TEXT: Message = {"type": "string"}
_XYZ = _object("foxglove.Vector3", _numbers("xyz"))
_TURN = _object("foxglove.Quaternion", _numbers("xyzw"))
_POSE = _object("foxglove.Pose", {"position": _XYZ, "orientation": _TURN})
_COLOR = _object("foxglove.Color", _numbers("rgba"))
_DRAWN = {"pose": _POSE, "color": _COLOR}
_SOLID = {**_DRAWN, "size": _XYZ}
_OUTLINE = {
    **_DRAWN,
    "points": _array(_XYZ),
    "colors": _array(_COLOR),
    "indices": _array({"type": "integer"}),
}
_ARROW = (*("shaft_length", "shaft_diameter"), *("head_length", "head_diameter"))
_KINDS = {
    "arrows": _object("foxglove.ArrowPrimitive", {**_DRAWN, **_numbers(_ARROW)}),
    "cubes": _object("foxglove.CubePrimitive", _SOLID),
    "spheres": _object("foxglove.SpherePrimitive", _SOLID),
    "lines": _object(
        "foxglove.LinePrimitive",
        {
            **_OUTLINE,
            "type": {"type": "integer"},
            "thickness": {"type": "number"},
            "scale_invariant": {"type": "boolean"},
        },
    ),
    "triangles": _object("foxglove.TriangleListPrimitive", _OUTLINE),
}
_ENTITY = _object(
    "foxglove.SceneEntity",
    {
        "timestamp": _TIME,
        "frame_id": _TEXT,
        "id": _TEXT,
        "lifetime": _object("duration", _TIME["properties"]),
        "frame_locked": {"type": "boolean"},
        "metadata": _array(_object("foxglove.KeyValuePair", {})),
        **{kind: _array(_KINDS.get(kind, _object("", {}))) for kind in PRIMITIVES},
    },
)
_TRANSFORM = _object(
    "foxglove.FrameTransform",
    {
        "timestamp": _TIME,
        "parent_frame_id": _TEXT,
        "child_frame_id": _TEXT,
        "translation": _XYZ,
        "rotation": _TURN,
    },
)
SCHEMAS: Mapping[str, Message] = {
    "foxglove.FrameTransforms": _object(
        "foxglove.FrameTransforms", {"transforms": _array(_TRANSFORM)}
    ),
    "foxglove.SceneUpdate": _object(
        "foxglove.SceneUpdate",
        {
            "deletions": _array(_object("foxglove.SceneEntityDeletion", {})),
            "entities": _array(_ENTITY),
        },
    ),
}
"""By name the JSON schemas of those of Foxglove's messages that are written."""


def signal_schema(name: str, attrs: Mapping[str, Any]) -> Message:
    """Describes the messages of a vector signal: a number a column.

    Args:
        name: "SYSTEM.PORT".
        attrs: of its data frame: `units`, `limits` and `frame`.
    """
    properties = {}
    for column, unit in attrs["units"].items():
        about: Message = {"type": ["number", "null"], "description": f"[{unit}]"}
        if column in attrs["limits"]:
            low, high = attrs["limits"][column]
            about["description"] += f", limits {low:g} to {high:g}"
        properties[column] = about
    return _object(name, properties) | {"description": attrs["frame"]}
