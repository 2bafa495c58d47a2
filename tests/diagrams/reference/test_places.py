"""Where Systems stand in a closed loop, and the pages that say so."""

from pathlib import Path

from footfall.diagrams.figures.block_diagram import Block, Wire
from footfall.diagrams.reference.places import neighbourhood
from footfall.diagrams.reference.system_docs import find_systems
from footfall.diagrams.reference.write_reference import write_reference


def block(name: str, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> Block:
    """A block all of whose ports are connected."""
    return Block(name, name, "#fff", inputs, outputs, "", frozenset(), frozenset())


def test_a_neighbourhood_keeps_the_wires_of_one_block() -> None:
    """Of the others what these wires end at."""
    blocks = [
        block("source", (), ("x", "y")),
        block("middle", ("x", "open"), ("z",)),
        block("sink", ("z", "y"), ()),
        block("stranger", ("y",), ()),
    ]
    wires = [
        Wire("source", "x", "middle", "x", False),
        Wire("middle", "z", "sink", "z", True),
        Wire("source", "y", "sink", "y", False),
        Wire("source", "y", "stranger", "y", False),
    ]
    near, kept = neighbourhood("middle", blocks, wires)
    assert [(b.name, b.inputs, b.outputs) for b in near] == [
        ("source", (), ("x",)),
        ("middle", ("x", "open"), ("z",)),
        ("sink", ("z",), ()),
    ]
    assert kept == wires[:2]


def test_pages_say_where_a_system_stands(tmp_path: Path) -> None:
    """One a System, and its list; one that no loop holds has no picture."""
    written = write_reference(tmp_path / "systems", ["stand"])
    names = {path.name for path in written}
    for system in find_systems():
        assert f"{system.__qualname__}.md" in names
    page = (tmp_path / "systems" / "Imu.md").read_text("utf-8")
    assert "| `stand` | `imu` | `robot_station` |" in page
    assert "| `angular_rate` | vector of 3 | true, of the unit in itself" in page
    assert "    params: ImuParams,\n    period: float,\n" in page
    assert "![Imu and what it is connected to](Imu.svg)" in page
    assert "imu</title>" in (tmp_path / "systems" / "Imu.svg").read_text("utf-8")
    other = (tmp_path / "systems" / "PlaneSegmenter.md").read_text("utf-8")
    assert "In none of the shipped closed loops" in other
    assert "PlaneSegmenter.svg" not in names
    assert "| [Imu](Imu.md) | Integrates" in written[0].read_text("utf-8")
    for path in written:
        assert " at 0x" not in path.read_text("utf-8"), path.name
