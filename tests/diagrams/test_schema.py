"""Every way in which a document can be wrong is said in one line."""

from dataclasses import dataclass, field
from typing import Any

import pytest

from footfall.diagrams.schema import FieldError, check, parse_yaml, set_field, validate
from footfall.models.values.validation import Parameters, number


@dataclass(kw_only=True)
class Wheel(Parameters):
    """A part."""

    radius: float = number(0.3, "m", above=0.0)
    spokes: int = number(12, least=1)


@dataclass(kw_only=True)
class Cart(Parameters):
    """A whole."""

    name: str = "cart"
    braked: bool = False
    wheel: Wheel = field(default_factory=Wheel)
    spare: Wheel | None = None
    load: list[float] = field(default_factory=list)
    others: list[Wheel] = field(default_factory=list)


@pytest.mark.parametrize(
    "text",
    [
        "{}",
        "{name: a, braked: true, wheel: {radius: 1, spokes: 3.0}}",
        "{spare: null, load: [1, 2.5, 1e-3], others: [{radius: 2}, {}]}",
        "{spare: {radius: 0.1}}",
    ],
)
def test_right_documents_pass(text: str) -> None:
    """Whole numbers are numbers, and fields may be left out."""
    check(parse_yaml(text), Cart)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{nam: a}", "nam: no such field; did you mean name?"),
        (
            "{wheel: {zzz: 1}}",
            "wheel.zzz: no such field; there are radius, spokes",
        ),
        ("{name: 3}", "name: must be a text, got 3"),
        ("{braked: 1}", "braked: must be true or false, got 1"),
        ("{wheel: 3}", "wheel: must hold fields, got 3"),
        ("{wheel: null}", "wheel: must hold fields, got nothing"),
        ("{wheel: {radius: wide}}", "wheel.radius: must be a number, got 'wide'"),
        ("{wheel: {radius: true}}", "wheel.radius: must be a number, got True"),
        ("{wheel: {radius: .nan}}", "wheel.radius: must be finite, got nan"),
        ("{wheel: {radius: -.inf}}", "wheel.radius: must be finite, got -inf"),
        ("{wheel: {spokes: 2.5}}", "wheel.spokes: must be a whole number, got 2.5"),
        ("{wheel: {spokes: [2]}}", "wheel.spokes: must be a whole number, got a list"),
        ("{spare: {spoke: 2}}", "spare.spoke: no such field; did you mean spokes?"),
        ("{load: 3}", "load: must be a list, got 3"),
        ("{load: [1, b]}", "load[1]: must be a number, got 'b'"),
        ("{others: [{}, {radius: {}}]}", "others[1].radius: must be a number, got f"),
        ("[1]", "must hold fields, got a list"),
    ],
)
def test_wrong_documents_are_refused_under_the_field(text: str, message: str) -> None:
    """The message begins with the path to the field."""
    with pytest.raises(FieldError) as raised:
        check(parse_yaml(text), Cart)
    assert str(raised.value).startswith(message)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: [1", "line 1: not YAML: "),
        ("a: 1\nb: {c: 1}\na: 2", "line 3: not YAML: the key 'a' occurs twice"),
        ("? [1]\n: 2", "line 1: not YAML: found unhashable key"),
        ("a: \x00", "not YAML: unacceptable character"),
        ("a: !!python/object:os.system {}", "line 1: not YAML: could not determine"),
    ],
)
def test_what_is_no_yaml_is_refused_under_the_line(text: str, message: str) -> None:
    """One line, and never a traceback of the parser's."""
    with pytest.raises(FieldError) as raised:
        parse_yaml(text)
    assert str(raised.value).startswith(message)
    assert "\n" not in str(raised.value)


def test_set_field_reaches_into_mappings_and_lists() -> None:
    """Mappings on the way are made, elements of lists must exist."""
    data: dict[str, Any] = {"others": [{}, {"radius": 1.0}], "spare": None}
    set_field(data, "others[1].radius", 2.0)
    set_field(data, "others[0]", {"spokes": 3})
    set_field(data, "wheel.radius", 4.0)
    set_field(data, "spare.radius", 5.0)
    assert data == {
        "others": [{"spokes": 3}, {"radius": 2.0}],
        "wheel": {"radius": 4.0},
        "spare": {"radius": 5.0},
    }


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("others[2].radius", r"others\[2\].radius: no element 2; the list has 1"),
        ("others.radius", "others.radius: no element radius; the list has 1"),
        ("name.first", "name: has no fields"),
        ("", "no field is named"),
    ],
)
def test_set_field_refuses_what_is_not_there(path: str, message: str) -> None:
    """A path that leads nowhere is an error, not a new field."""
    with pytest.raises(FieldError, match=message):
        set_field({"others": [{}], "name": "cart"}, path, 1.0)


def test_validate_names_the_field_of_the_part() -> None:
    """A part knows nothing of the whole; the path is put before its message."""
    cart = Cart(others=[Wheel(), Wheel(spokes=0)])
    with pytest.raises(FieldError, match=r"^others\[1\].spokes: must be at least 1"):
        validate(cart)
    validate(Cart())


def test_schema_with_another_type_is_a_programming_error() -> None:
    """What cannot be checked is not let through."""
    with pytest.raises(TypeError, match="cannot hold"):
        check(1, complex, "x")
