"""Descriptions of fields: their texts at run time, their domains, `help` of a class."""

import inspect
import pydoc
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from footfall.models.values import field_texts as module
from footfall.models.values.description import class_text, describe
from footfall.models.values.field_texts import field_texts
from footfall.models.values.validation import Parameters, choice, number

ROOT = Path(__file__).resolve().parents[3]


@dataclass(kw_only=True)
class Wheel(Parameters):
    """A part.

    It turns.
    """

    radius: float = number(0.3, "m", above=0.0, shared="size")
    """From the hub
    to the ground, m."""
    spokes: int = number(12, least=3, most=99)
    """How many."""
    tilt: float = number(0.0, "rad", above=-1.0, below=1.0)


@dataclass(kw_only=True)
class Cart(Parameters):
    """A whole."""

    load: list[float] = number([1.0, 2.0], "kg", least=0.0, fewest=1)
    """What lies on it, kg."""
    place: list[float] | None = number(None, "m", length=2)
    kind: str = choice("hand", ("hand", "ox"))
    name: str = ""
    braked: bool = False
    wheel: Wheel = field(default_factory=lambda: Wheel(spokes=5))
    """What it rolls on."""
    spare: Wheel | None = None
    others: list[Wheel] = field(default_factory=list)


@dataclass(kw_only=True)
class OxCart(Cart):
    """A whole with an ox."""

    kind: str = "ox"
    """Who pulls."""


def test_texts_are_read_from_the_source() -> None:
    """On one line; those of a base, too, and a class may say its own instead."""
    assert field_texts(Wheel) == {
        "radius": "From the hub to the ground, m.",
        "spokes": "How many.",
    }
    assert field_texts(OxCart) == {**field_texts(Cart), "kind": "Who pulls."}


def test_a_class_in_a_function_has_its_texts() -> None:
    """Found below the function."""

    @dataclass
    class Spoke:
        length: float = 0.3
        """From hub to rim, m."""

    assert field_texts(Spoke) == {"length": "From hub to rim, m."}


@pytest.mark.parametrize(
    ("name", "domain", "default"),
    [
        ("load", "list of at least 1 numbers in [0, 1000000] kg", "[1.0, 2.0] kg"),
        ("place", "list of 2 numbers in [-1000, 1000] m, or null", "null"),
        ("kind", "one of hand, ox", "hand"),
        ("name", "text", '""'),
        ("braked", "true or false", "false"),
        ("wheel", "Wheel", ""),
        ("spare", "Wheel, or null", "null"),
        ("others", "list of Wheel", "[]"),
    ],
)
def test_a_field_says_what_it_may_be(name: str, domain: str, default: str) -> None:
    """And what it is unless given."""
    one = next(item for item in describe(Cart) if item.name == name)
    assert (one.domain(), one.shown_default()) == (domain, default)


def test_bounds_that_are_excluded_are_told_apart() -> None:
    """By round brackets."""
    radius, spokes, tilt = describe(Wheel)
    assert radius.domain() == "number in (0, 1000] m"
    assert spokes.domain() == "whole number in [3, 99]"
    assert tilt.domain() == "number in (-1, 1) rad"
    assert (radius.shared, radius.unit, spokes.unit) == ("size", "m", "")


def test_defaults_of_a_part_are_those_of_its_place() -> None:
    """Not those of its class."""
    assert describe(Wheel, Cart().wheel)[1].default == 5
    assert describe(Wheel)[1].default == 12


def test_another_type_is_a_programming_error() -> None:
    """What cannot be described is not left out."""

    @dataclass
    class Odd:
        value: complex = 0j

    with pytest.raises(TypeError, match="value: parameters cannot hold"):
        describe(Odd)


def test_help_shows_every_field() -> None:
    """Below the class's own docstring, which stays as it is written."""
    text = pydoc.render_doc(Wheel, renderer=pydoc.plaintext)
    assert "A part." in text
    assert "It turns." in text
    assert "radius: number in (0, 1000] m; 0.3 m by default" in text
    assert "From the hub to the ground, m." in text
    assert class_text(Wheel) == "A part.\n\nIt turns."
    assert class_text(Cart) == "A whole."
    assert max(map(len, (inspect.getdoc(Cart) or "").splitlines())) <= 80


def test_help_says_so_where_the_source_is_not_at_hand(monkeypatch) -> None:
    """And shows what is known without it."""

    def hidden(_: object) -> str:
        raise OSError("could not get source code")

    monkeypatch.setattr(inspect, "getsource", hidden)
    for cached in (module._own_texts, module._module):
        cached.cache_clear()
    text = inspect.getdoc(Wheel) or ""
    for cached in (module._own_texts, module._module):
        cached.cache_clear()
    assert "(without texts: their source, " in text
    assert "is not at hand)" in text
    assert "radius: number in (0, 1000] m; 0.3 m by default" in text


def test_importing_reads_no_source() -> None:
    """It would cost every start; it is read when somebody asks."""
    code = (
        "from footfall.diagrams import scenario;"
        "from footfall.models.values import field_texts as module;"
        "print(module._module.cache_info().misses)"
    )
    run = subprocess.run(
        [sys.executable, "-c", code],
        check=True,
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    assert run.stdout.strip() == "0"
