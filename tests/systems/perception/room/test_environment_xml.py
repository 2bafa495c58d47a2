"""The environment as XML: exact round trips, hand-written files, errors by line."""

from pathlib import Path

import numpy as np
import pytest
from pydrake.common.value import AbstractValue

from footfall.models.values.room import Environment, FloorPlane, ObstacleBox
from footfall.systems.perception.room.environment_exchange import EnvironmentExchange
from footfall.systems.perception.room.environment_xml import (
    EnvironmentFileError,
    load_environment,
    read_environment,
    write_environment,
)

ROOM = """<environment>
  <floor>
    <vertex x="-3" y="-2"/>
    <vertex x="3" y="-2"/>
    <vertex x="3" y="2"/>
    <vertex x="-3" y="2"/>
  </floor>
  <box name="bucket" yaw="0.3">
    <center x="0.5" y="-0.2" z="0.2"/>
    <size x="0.3" y="0.3" z="0.4"/>
  </box>
</environment>
"""


def random_environment(seed: int) -> Environment:
    """A sloping floor of any outline and boxes with awkward numbers and names."""
    rng = np.random.default_rng(seed)
    normal = rng.normal([0, 0, 5], 0.3)
    normal /= np.linalg.norm(normal)
    plane = np.append(normal, rng.normal())
    angles = np.sort(rng.uniform(0, 2 * np.pi, 12))
    xy = rng.uniform(1, 4) * np.column_stack([np.cos(angles), np.sin(angles)])
    z = -(xy @ normal[:2] + plane[3]) / normal[2]
    names = ["a & b <c>", 'quoted "box"', "Kübel", "box_3", " "]
    boxes = tuple(
        ObstacleBox(
            name,
            rng.normal(size=3) * 10.0 ** rng.integers(-9, 9),
            float(rng.normal()),
            np.abs(rng.normal(size=3)) + 1e-300,
            int(rng.integers(0, 5000)),
        )
        for name in names
    )
    floor = FloorPlane(plane, np.column_stack([xy, z]), float(rng.random()))
    return Environment(floor, boxes)


@pytest.mark.parametrize("seed", range(50))
def test_round_trip_is_exact(seed: int) -> None:
    """What is read back equals what was written, bit for bit."""
    environment = random_environment(seed)
    text = write_environment(environment)
    assert read_environment(text) == environment
    assert read_environment(text.encode()) == environment
    assert write_environment(read_environment(text)) == text


def test_no_floor_round_trip() -> None:
    """The reason why there is no floor is kept."""
    environment = Environment(reason="no floor in view: 3 points < 20 %")
    assert read_environment(write_environment(environment)) == environment
    assert read_environment(write_environment(Environment())) == Environment()


def test_hand_written_file(tmp_path: Path) -> None:
    """What is left out has the documented values."""
    path = tmp_path / "room.xml"
    path.write_text(ROOM)
    environment = load_environment(path)
    assert environment.floor is not None
    np.testing.assert_array_equal(environment.floor.coefficients, [0, 0, 1, 0])
    assert environment.floor.inlier_share == 1.0
    np.testing.assert_array_equal(environment.floor.polygon[:, 2], 0.0)
    (box,) = environment.boxes
    assert (box.name, box.yaw, box.support_count) == ("bucket", 0.3, 0)
    np.testing.assert_array_equal(box.size, [0.3, 0.3, 0.4])


def test_height_of_a_vertex_is_the_planes() -> None:
    """A vertex without z lies on the plane."""
    floor = read_environment(ROOM.replace("<floor>", '<floor d="-0.25">')).floor
    assert floor is not None
    np.testing.assert_array_equal(floor.polygon[:, 2], 0.25)


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('z="0.4"', 'z="0"', 8, "box: size must be positive, got 0.3, 0.3, 0.0"),
        ('z="0.4"', 'z="-1"', 8, "box: size must be positive"),
        ('z="0.4"', 'z="high"', 10, "size: z must be a number, got 'high'"),
        ('z="0.4"', 'z="inf"', 10, "size: z must be finite"),
        ('z="0.4"', "", 10, "size: needs the attribute z"),
        ('z="0.4"', 'z="0.4" w="1"', 10, "size: unknown attribute w"),
        ("</box>", "<size/></box>", 8, "box: needs exactly one size, got 2"),
        ('name="bucket"', "", 8, "box: needs the attribute name"),
        ('yaw="0.3"', 'support_count="1.5"', 8, "box: support_count must be a whole"),
        ("</box>", "</bax>", 11, "not well-formed XML: mismatched tag"),
        ("</environment>", "", 13, "not well-formed XML: no element found"),
        ("<box", "hello <box", 8, "environment: text is not allowed here"),
        ("<floor>", "<sky/><floor>", 2, "sky: unknown element in environment"),
        ("<floor>", '<floor c="2">', 2, "floor: (a, b, c) must be a unit normal"),
        ("<floor>", '<floor c="-1">', 2, "floor: (a, b, c) must be a unit normal"),
        ("<floor>", '<floor inlier_share="2">', 2, "floor: inlier_share must lie"),
        ('x="3" y="2"', 'x="-9" y="0"', 2, "floor: vertices must bound a convex area"),
        ('x="-3" y="2"', 'x="3" y="2"', 2, None),
        ("</environment>", "<floor/></environment>", 12, "floor: only one floor"),
        ("<environment>", '<environment reason="fog">', 1, "environment: a reason why"),
        ("environment>", "room>", 1, "room: must be the outermost element"),
    ],
)
def test_errors_name_file_and_line(
    old: str, new: str, line: int, message: str | None, tmp_path: Path
) -> None:
    """What is wrong is told with the file, the line and the element."""
    path = tmp_path / "room.xml"
    path.write_text(ROOM.replace(old, new))
    if message is None:
        # A corner given twice bounds the same area.
        assert load_environment(path).floor is not None
        return
    with pytest.raises(EnvironmentFileError) as caught:
        load_environment(path)
    assert str(caught.value).startswith(f"{path}:{line}: {message}")


@pytest.mark.parametrize("corners", [2, 0])
def test_too_few_vertices(corners: int) -> None:
    """Two corners bound nothing."""
    lines = [text for text in ROOM.splitlines() if "vertex" not in text]
    lines[2:2] = ['<vertex x="0" y="0"/>'] * corners
    with pytest.raises(EnvironmentFileError, match="at least three vertex"):
        read_environment("\n".join(lines))


def test_same_name_twice() -> None:
    """The second of them is where the error is."""
    box = ROOM[ROOM.index("  <box") : ROOM.index("</env")]
    with pytest.raises(EnvironmentFileError, match="room:12: box: name must be unique"):
        read_environment(ROOM.replace("</env", box + "</env"), "room")


@pytest.mark.parametrize("document", ["", "bucket", "<environment"])
def test_no_xml(document: str) -> None:
    """Other files are told apart from XML."""
    with pytest.raises(EnvironmentFileError, match="room:1: not well-formed XML"):
        read_environment(document, "room")


def test_missing_file(tmp_path: Path) -> None:
    """A file that is not there is named."""
    with pytest.raises(EnvironmentFileError, match=r"none\.xml: No such file"):
        load_environment(tmp_path / "none.xml")


def test_what_cannot_be_read_back_is_not_written() -> None:
    """Numbers that are not finite and names with control characters are refused."""
    box = ObstacleBox("box", np.array([0.0, np.nan, 0.0]), 0.0, np.ones(3))
    with pytest.raises(ValueError, match="finite"):
        write_environment(Environment(boxes=(box,)))
    box = ObstacleBox("b\x00x", np.zeros(3), 0.0, np.ones(3))
    with pytest.raises(ValueError, match="printable"):
        write_environment(Environment(boxes=(box,)))


def test_exchange_hands_on_the_same_environment() -> None:
    """Through the document and back, on the ports."""
    environment = random_environment(0)
    system = EnvironmentExchange()
    context = system.CreateDefaultContext()
    system.GetInputPort("environment").FixValue(
        context, AbstractValue.Make(environment)
    )
    xml = system.GetOutputPort("xml").Eval(context)
    assert xml == write_environment(environment)
    assert system.GetOutputPort("environment").Eval(context) == environment
