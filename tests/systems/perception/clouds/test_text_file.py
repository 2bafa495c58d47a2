"""Reading tables of points: separators, decimals, names, marks, and what is refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.text_file import read_table

POINTS = [[1.5, -2.25, 3.0], [1e-3, 0.0, 7.5]]


def read(text: str | bytes, folder: Path) -> Vector:
    """Writes text to a file and reads it."""
    path = folder / "cloud.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_table(path)


@pytest.mark.parametrize(
    "text",
    [
        "1.5 -2.25 3\n1e-3 0 7.5\n",
        "  1.5   -2.25 3  \n\n1e-3\t0 7.5",
        "1.5,-2.25,3\r\n1e-3,0,7.5\r\n",
        "1.5, -2.25, 3\n1e-3, 0, 7.5\n",
        "1.5 ,-2.25 ,3\n1e-3 ,0 ,7.5\n",
        "1.5;-2.25;3\n1e-3;0;7.5\n",
        "1,5;-2,25;3\n1e-3;0;7,5\n",
        "1,5 -2,25 3\n1e-3 0 7,5\n",
        "1,5\t-2,25\t3\n1e-3\t0\t7,5\n",
        '"1.5","-2.25","3"\n"1e-3","0","7.5"\n',
        "\ufeff1.5 -2.25 3\n1e-3 0 7.5\n",
        "\ufeffx,y,z\n1.5,-2.25,3\n1e-3,0,7.5\n",
        "x,y,z\n1.5,-2.25,3\n1e-3,0,7.5\n",
        "X Y Z\n1.5 -2.25 3\n1e-3 0 7.5\n",
        '"x";"y";"z"\n1,5;-2,25;3\n1e-3;0;7,5\n',
        "x [m], y [m], z(m)\n1.5,-2.25,3\n1e-3,0,7.5\n",
        "time,z,y,x\n8,3,-2.25,1.5\n9,7.5,0,1e-3\n",
        "//X Y Z I\n1.5 -2.25 3 200\n1e-3 0 7.5 201\n",
        "# z y x\n3 -2.25 1.5\n7.5 0 1e-3\n",
        "# made by a scanner\n1.5 -2.25 3 # first\n// half way\n1e-3 0 7.5\n",
        "% x y z of each\n\n1.5 -2.25 3 1 2\n1e-3 0 7.5 1 2\n",
        "1.5 -2.25 3\n1e-3 0 7.5\n".encode("utf-16"),
    ],
)
def test_tables_that_are_read(text: str | bytes, tmp_path: Path) -> None:
    """The same two points however they are written."""
    np.testing.assert_array_equal(read(text, tmp_path), POINTS)


@settings(deadline=None, derandomize=True)
@given(
    points=npst.arrays(
        np.float64,
        st.tuples(st.integers(1, 30), st.integers(3, 7)),
        elements=st.floats(allow_infinity=False) | st.just(0.5),
    ),
    separator=st.sampled_from([" ", "\t", ", ", ",", ";", " ; "]),
    comma=st.booleans(),
    names=st.booleans(),
)
def test_doubles_survive(
    points: Vector,
    separator: str,
    comma: bool,
    names: bool,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """Every double between every separator, with a decimal comma where it may be."""
    points[0] = 0.5
    rows = [separator.join(map(repr, row)) for row in points.tolist()]
    if comma and "," not in separator:
        rows = [row.replace(".", ",") for row in rows]
    if names:
        rows.insert(0, separator.join("xyzabcd"[: points.shape[1]]))
    found = read("\n".join(rows), tmp_path_factory.mktemp("text"))
    np.testing.assert_array_equal(found, points[:, :3])


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1,5,2,25,3,0\n1,0,2,0,3,0\n", "may be decimal commas"),
        ('"1,5","2,25","3,0"\n"1,0","2,0","3,0"\n', "may be decimal commas"),
        ("x,y,z\n1,5,2,25,3,0\n", "the names 'x,y,z' over 6 columns"),
        ("a,b,c\n1.0,2.0,3.0\n", "the names 'a,b,c' over 3 columns"),
        ("x [mm],y [mm],z [mm]\n1.0,2.0,3.0\n", "in metres"),
        ("x,y,z\nx,y,z\n1.0,2.0,3.0\n", "line 2"),
        ("x,y,z\n", "not a table of numbers"),
        ("1 2 3\n1 2\n", "line 2 has 2 columns, those before it 3"),
        ("1 2 3\n\n1 2 3 4\n", "line 3 has 4 columns, those before it 3"),
        ("1 2\n", "has 2 columns"),
        ("1 2 3\n1 two 3\n", "'two'"),
        ("1.5 2 3\n1,5 2 3\n", "'1,5'"),
        ("1,2,3\n1,,3\n", "''"),
        (b"\x89PNG\r\n\x1a\n\x00", "is not text"),
        (b"\x00\x01\x02\x03", r"not a table of numbers \('\\x00"),
    ],
)
def test_tables_that_are_refused(
    text: str | bytes, reason: str, tmp_path: Path
) -> None:
    """Each with its reason and, where there is one, its line."""
    with pytest.raises(ValueError, match=reason):
        read(text, tmp_path)


def test_whole_numbers_that_are_named_are_points(tmp_path: Path) -> None:
    """A line of names tells six whole numbers from three with decimal commas."""
    found = read("x,y,z,r,g,b\n1,5,2,25,3,0\n", tmp_path)
    np.testing.assert_array_equal(found, [[1.0, 5.0, 2.0]])


def test_a_table_of_nothing(tmp_path: Path) -> None:
    """Comments and blank lines hold no point."""
    assert read("\n# nothing\n", tmp_path).shape == (0, 3)


@settings(deadline=None, derandomize=True)
@given(data=st.binary(max_size=100))
def test_garbage_is_read_or_refused(
    data: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Nothing but a ValueError comes of any bytes, or points of three."""
    try:
        found = read(data, tmp_path_factory.mktemp("text"))
    except ValueError:
        return
    assert found.shape[1] == 3
