"""The environment as XML: the room paper's step between perception and planning.

Perception writes it, planning reads it, and one can write it by hand. Every number is
written so that it is read back bit for bit. Lengths are in m, angles in rad, W has z
up. The schema, by example:

.. code-block:: xml

    <environment>
      <floor a="0.0" b="0.0" c="1.0" d="0.0" inlier_share="0.93">
        <vertex x="-3.0" y="-2.0" z="0.0"/>
        <vertex x="3.0" y="-2.0" z="0.0"/>
        <vertex x="3.0" y="2.0" z="0.0"/>
        <vertex x="-3.0" y="2.0" z="0.0"/>
      </floor>
      <box name="bucket" yaw="0.3" support_count="812">
        <center x="0.5" y="-0.2" z="0.2"/>
        <size x="0.3" y="0.3" z="0.4"/>
      </box>
    </environment>

- `environment`: at most one `floor`, any number of `box`. `reason` (optional) is why
  there is no floor; then there must be none.
- `floor`: A x + B y + C z + D = 0 with a unit normal (A, B, C) that points up; 0, 0, 1
  and 0 where they are left out. `inlier_share` (optional, 1): share of the points in
  view that lie on it, 0 to 1. At least three `vertex`, the corners of its convex
  outline counter-clockwise from above; `z` is the plane's where it is left out.
- `box`: `name` is unique; `yaw` (optional, 0) the direction of its x about z;
  `support_count` (optional, 0) the points it was fitted to. One `center` and one `size`
  along its own axes, positive.

Anything else is an error that names the file and the line.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from math import isfinite, sqrt
from pathlib import Path
from typing import NoReturn
from xml.etree import ElementTree as ET
from xml.parsers import expat

import numpy as np

from footfall.models.values.room import Environment, FloorPlane, ObstacleBox
from footfall.models.values.vector import Vector

AXES = ("x", "y", "z")
UNIT_TOLERANCE = 1e-6
"""Tolerance of the length of a unit normal."""


class EnvironmentFileError(ValueError):
    """An environment that is no XML or breaks the schema; names file and line."""


def write_environment(environment: Environment) -> str:
    """Writes the environment as an XML document.

    Raises:
        ValueError: a number is not finite or a text is not printable, so that it could
            not be read back.
    """
    root = ET.Element("environment")
    if environment.reason:
        root.set("reason", _text("reason", environment.reason))
    floor = environment.floor
    if floor is not None:
        element = _add(root, "floor", zip("abcd", floor.coefficients, strict=True))
        element.set("inlier_share", _number(floor.inlier_share))
        for vertex in floor.polygon:
            _add(element, "vertex", zip(AXES, vertex, strict=True))
    for box in environment.boxes:
        element = ET.SubElement(root, "box", name=_text("name", box.name))
        element.set("yaw", _number(box.yaw))
        element.set("support_count", str(int(box.support_count)))
        _add(element, "center", zip(AXES, box.center, strict=True))
        _add(element, "size", zip(AXES, box.size, strict=True))
    ET.indent(root)
    document = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{document}\n'


def _add(
    parent: ET.Element, tag: str, numbers: Iterable[tuple[str, float]]
) -> ET.Element:
    attributes = {name: _number(value) for name, value in numbers}
    return ET.SubElement(parent, tag, attributes)


def _number(value: float) -> str:
    if not isfinite(value):
        raise ValueError(f"an environment's numbers must be finite, got {value}")
    return repr(float(value))


def _text(name: str, value: str) -> str:
    if not value.isprintable():
        raise ValueError(f"{name}: must be printable to be written, got {value!r}")
    return value


def load_environment(path: Path) -> Environment:
    """Reads an environment from a file.

    Raises:
        EnvironmentFileError: the file cannot be read, is no XML or breaks the schema:
            "room.xml:12: box: size must be positive, got ...".
    """
    try:
        document = path.read_bytes()
    except OSError as error:
        raise EnvironmentFileError(f"{path}: {error.strerror}") from error
    return read_environment(document, str(path))


def read_environment(document: str | bytes, source: str = "environment") -> Environment:
    """Reads an environment from an XML document.

    Args:
        document: as `write_environment` makes it, or written by hand.
        source: what errors call it, e.g. the file.

    Raises:
        EnvironmentFileError: the document is no XML or breaks the schema; the message
            begins with the source and the line.
    """
    root = _parse(document, source)
    if root.tag != "environment":
        root.fail(f"must be the outermost element environment, got {root.tag}")
    root.allow(attributes=("reason",), children=("floor", "box"))
    floors = root.named("floor")
    if len(floors) > 1:
        floors[1].fail("only one floor is allowed")
    reason = root.attributes.get("reason", "")
    if reason and floors:
        root.fail("a reason why there is no floor stands beside a floor")
    boxes: list[ObstacleBox] = []
    for element in root.named("box"):
        box = _box(element)
        if any(box.name == other.name for other in boxes):
            element.fail(f"name must be unique, got {box.name!r} again")
        boxes.append(box)
    return Environment(_floor(floors[0]) if floors else None, tuple(boxes), reason)


@dataclass
class _Element:
    """An XML element that knows its line."""

    tag: str
    attributes: Mapping[str, str]
    line: int
    source: str
    children: list["_Element"] = field(default_factory=list)

    def fail(self, reason: str) -> NoReturn:
        raise EnvironmentFileError(f"{self.source}:{self.line}: {self.tag}: {reason}")

    def allow(self, attributes: Iterable[str], children: Iterable[str] = ()) -> None:
        """Refuses attributes and children that the schema does not know."""
        known = tuple(attributes)
        for name in self.attributes:
            if name not in known:
                self.fail(f"unknown attribute {name}, expected {', '.join(known)}")
        known = tuple(children)
        for child in self.children:
            if child.tag not in known:
                expected = f"expected {', '.join(known)}" if known else "expected none"
                child.fail(f"unknown element in {self.tag}, {expected}")

    def named(self, tag: str) -> list["_Element"]:
        return [child for child in self.children if child.tag == tag]

    def only(self, tag: str) -> "_Element":
        found = self.named(tag)
        if len(found) != 1:
            self.fail(f"needs exactly one {tag}, got {len(found)}")
        return found[0]

    def number(self, name: str, default: float | None = None) -> float:
        text = self.attributes.get(name)
        if text is None:
            if default is None:
                self.fail(f"needs the attribute {name}")
            return default
        try:
            value = float(text)
        except ValueError:
            self.fail(f"{name} must be a number, got {text!r}")
        if not isfinite(value):
            self.fail(f"{name} must be finite, got {text!r}")
        return value


def _parse(document: str | bytes, source: str) -> _Element:
    """Parses the document's outermost element."""
    parser = expat.ParserCreate()
    top: list[_Element] = []
    path: list[_Element] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = _Element(tag, attributes, parser.CurrentLineNumber, source)
        (path[-1].children if path else top).append(element)
        path.append(element)

    def end(tag: str) -> None:
        path.pop()

    def text(characters: str) -> None:
        if characters.strip():
            line = parser.CurrentLineNumber
            raise EnvironmentFileError(
                f"{source}:{line}: {path[-1].tag}: text is not allowed here, "
                f"got {characters.strip()!r}"
            )

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    try:
        parser.Parse(document, True)
    except expat.ExpatError as error:
        message = expat.ErrorString(error.code)
        raise EnvironmentFileError(
            f"{source}:{error.lineno}: not well-formed XML: {message}"
        ) from error
    return top[0]


def _vector(element: _Element) -> Vector:
    element.allow(AXES)
    return np.array([element.number(axis) for axis in AXES])


def _floor(element: _Element) -> FloorPlane:
    element.allow((*"abcd", "inlier_share"), ("vertex",))
    plane = {"a": 0.0, "b": 0.0, "c": 1.0, "d": 0.0}
    a, b, c, d = (element.number(name, default) for name, default in plane.items())
    if abs(sqrt(a * a + b * b + c * c) - 1.0) > UNIT_TOLERANCE or c <= 0.0:
        element.fail(f"(a, b, c) must be a unit normal that points up, got {a, b, c}")
    share = element.number("inlier_share", 1.0)
    if not 0.0 <= share <= 1.0:
        element.fail(f"inlier_share must lie between 0 and 1, got {share!r}")
    corners = []
    for vertex in element.named("vertex"):
        vertex.allow(AXES)
        x, y = vertex.number("x"), vertex.number("y")
        corners.append([x, y, vertex.number("z", -(a * x + b * y + d) / c)])
    if len(corners) < 3:
        element.fail(f"needs at least three vertex, got {len(corners)}")
    polygon = np.array(corners)
    edges = np.roll(polygon, -1, axis=0)[:, :2] - polygon[:, :2]
    after = np.roll(edges, -1, axis=0)
    turns = edges[:, 0] * after[:, 1] - edges[:, 1] * after[:, 0]
    total = np.sum(np.arctan2(turns, np.sum(edges * after, axis=1)))
    # Turning left at every corner, once around in all.
    if np.any(turns < -1e-9) or not np.any(turns > 0.0) or total > 3.0 * np.pi:
        element.fail("vertices must bound a convex area, counter-clockwise from above")
    return FloorPlane(np.array([a, b, c, d]), polygon, share)


def _box(element: _Element) -> ObstacleBox:
    element.allow(("name", "yaw", "support_count"), ("center", "size"))
    name = element.attributes.get("name", "")
    if not name:
        element.fail("needs the attribute name")
    count = element.number("support_count", 0.0)
    if count < 0.0 or count != int(count):
        element.fail(f"support_count must be a whole number, got {count!r}")
    center, size = _vector(element.only("center")), _vector(element.only("size"))
    if not np.all(size > 0.0):
        got = ", ".join(repr(float(side)) for side in size)
        element.fail(f"size must be positive, got {got}")
    return ObstacleBox(name, center, element.number("yaw", 0.0), size, int(count))
