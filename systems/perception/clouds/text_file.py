"""Reading clouds from tables in text: .xyz, .txt and .csv."""

import codecs
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_claims import MAX_POINTS

COMMENTS = ("#", "//", "%")
"""First characters of a line that is no point."""
DECIMAL_COMMA = re.compile(r"[+-]?\d+(,\d+)?([eE][+-]?\d+)?")
"""A number whose decimals come after a comma, or a whole one."""
AXIS = re.compile(r"([xyz])\s*(\[m\]|\(m\))?")
"""The name of a column that holds a coordinate in metres, in lower case."""
SEPARATORS = re.compile(r"[;,\s]+")


@dataclass(frozen=True)
class TableLayout:
    """Layout of a table of points."""

    separator: str | None
    """Separator of columns; None for blanks."""
    decimal_comma: bool
    """Whether decimals come after a comma."""
    width: int
    """Number of columns."""
    axes: tuple[int, int, int]
    """The columns of x, y and z."""
    named: bool
    """Whether a line of names says which columns these are."""


def read_table(path: Path) -> Vector:
    """Reads the points of a table, (n, 3), a point a line, three or more columns.

    Columns stand between commas, semicolons, tabs or blanks; decimals after a point,
    or after a comma where columns stand between something else. A line of names
    before the points says which columns are x, y and z; without one they are the
    first three. Lines that start with #, // or % are comments. UTF-8, or UTF-16 with
    its mark.

    Raises:
        ValueError: it is no such table; the message names the line.
    """
    with path.open("rb") as file:
        start = file.read(2)
    wide = start in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
    try:
        with path.open(encoding="utf-16" if wide else "utf-8-sig") as text:
            return _read_lines(text)
    except UnicodeError as error:
        raise ValueError("is not text") from error


def _read_lines(lines: Iterator[str]) -> Vector:
    numbered = ((n, _clean(line)) for n, line in enumerate(lines, start=1))
    names: list[str] = []
    said = False
    for number, line in numbered:
        if not line:
            continue
        if line.startswith(COMMENTS):
            names = names if said else [line.lstrip("#/% ")]
        elif _is_number(SEPARATORS.split(line)[0]):
            break
        elif said:
            raise ValueError(
                f"is not a table of numbers (line {number}: {line[:40]!a})"
            )
        else:
            names, said = [line], True
    else:
        if said:
            raise ValueError(f"is not a table of numbers ({names[0][:40]!a})")
        return np.zeros((0, 3))
    layout = find_layout(line, names[0] if names else None, said)
    rows = _rows(itertools.chain([(number, line)], numbered), layout)
    try:
        table = np.loadtxt(
            rows,
            dtype=np.float64,
            comments=None,
            delimiter=layout.separator,
            usecols=layout.axes,
            ndmin=2,
        )
    except _RowError as error:
        raise ValueError(str(error)) from error
    except UnicodeError:
        raise
    except ValueError as error:
        raise ValueError(f"is not a table of numbers ({error})") from error
    doubtful = layout.separator == "," and layout.width in range(6, 99, 2)
    if doubtful and not layout.named and np.all(table == np.round(table)):
        raise ValueError(
            f"has {layout.width} columns of whole numbers between commas, which may be "
            "decimal commas: name the columns or separate them by semicolons"
        )
    return table


def find_layout(line: str, names: str | None, said: bool) -> TableLayout:
    """Finds how a table is written from its first point and its names.

    Args:
        line: the first point.
        names: the line before it; None for none.
        said: whether that line is one of names and no comment.

    Raises:
        ValueError: there are less than three columns, or names without x, y and z.
    """
    words = line.split()
    separator: str | None = None
    if ";" in line:
        separator = ";"
    elif "\t" in line:
        separator = "\t"
    elif "," in line and not (
        len(words) >= 3 and all(DECIMAL_COMMA.fullmatch(word) for word in words)
    ):
        separator = ","
    width = len(line.split(separator))
    if width < 3:
        raise ValueError(f"has {width} columns, expected 3 or more")
    axes = _find_axes(names or "", separator, width)
    if axes is None and said:
        raise ValueError(
            f"has the names {(names or '')[:80]!a} over {width} columns, expected one "
            "a column, and among them x, y and z in metres"
        )
    return TableLayout(
        separator=separator,
        decimal_comma=separator != "," and "," in line,
        width=width,
        axes=axes or (0, 1, 2),
        named=axes is not None,
    )


def _find_axes(
    names: str, separator: str | None, width: int
) -> tuple[int, int, int] | None:
    """Finds the columns called x, y and z, when each column has a name."""
    for titles in (names.split(separator), SEPARATORS.split(names)):
        found = [AXIS.fullmatch(title.strip().lower()) for title in titles]
        axes = [match.group(1) if match else "" for match in found]
        if len(axes) == width and all(axes.count(axis) == 1 for axis in "xyz"):
            return axes.index("x"), axes.index("y"), axes.index("z")
    return None


class _RowError(Exception):
    """A row of a table is unlike those before it."""


def _rows(numbered: Iterable[tuple[int, str]], layout: TableLayout) -> Iterator[str]:
    """Reads the points of a table with NumPy, each with its number of columns."""
    points = 0
    for number, line in numbered:
        if not line or line.startswith(COMMENTS):
            continue
        width = len(line.split(layout.separator))
        if width != layout.width:
            raise _RowError(
                f"is not a table of numbers (line {number} has {width} columns, those "
                f"before it {layout.width})"
            )
        points += 1
        if points > MAX_POINTS:
            raise _RowError(
                f"has more than the {MAX_POINTS:,} points that are read: thin it out "
                "first"
            )
        yield line.replace(",", ".") if layout.decimal_comma else line


def _clean(line: str) -> str:
    """Strips quotes, and a comment behind the numbers, from a line."""
    line = line.replace('"', "").strip()
    return line if line.startswith("#") else line.partition("#")[0].rstrip()


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
