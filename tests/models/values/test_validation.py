"""Bounds beside fields: their words, parts and lists, and numbers that are shared."""

import math
from dataclasses import dataclass, field

import pytest

from footfall.models.values.validation import (
    Parameters,
    choice,
    number,
    require_at_least,
    share,
)


@dataclass(kw_only=True)
class Wheel(Parameters):
    """A part."""

    radius: float = number(0.3, "m", above=0.0, shared="size")
    spokes: int = number(12, least=3, most=99)
    tilt: float = number(0.0, "rad", above=-1.0, below=1.0)


@dataclass(kw_only=True)
class Cart(Parameters):
    """A whole."""

    load: list[float] = number([1.0, 2.0], "kg", least=0.0, fewest=1)
    place: list[float] | None = number(None, "m", length=2)
    kind: str = choice("hand", ("hand", "ox"))
    wheel: Wheel = field(default_factory=Wheel)
    others: list[Wheel] = field(default_factory=list)


@pytest.mark.parametrize(
    ("cart", "message"),
    [
        (Cart(wheel=Wheel(radius=0.0)), "wheel.radius: must be positive, got 0 m"),
        (Cart(wheel=Wheel(radius=2e3)), "wheel.radius: must be at most 1000 m, got"),
        (Cart(wheel=Wheel(radius=math.nan)), "wheel.radius: must be finite, got nan"),
        (Cart(wheel=Wheel(spokes=2)), "wheel.spokes: must be at least 3, got 2"),
        (Cart(others=[Wheel(), Wheel(tilt=-1.0)]), "others[1].tilt: must be more than"),
        (Cart(others=[Wheel(tilt=1.0)]), "others[0].tilt: must be less than 1 rad, go"),
        (Cart(load=[]), "load: must have at least 1 elements, got 0"),
        (Cart(load=[1.0, -1.0]), "load[1]: must be at least 0 kg, got -1 kg"),
        (Cart(load=[1.0, 1e7]), "load[1]: must be at most 1e+06 kg, got 1e+07 kg"),
        (Cart(place=[1.0]), "place: must have 2 elements, got 1"),
        (Cart(kind="dog"), "kind: must be one of hand, ox, got 'dog'"),
    ],
)
def test_what_is_out_of_bounds_is_refused_by_its_path(cart: Cart, message: str) -> None:
    """What it must be, and what it is, with its unit."""
    with pytest.raises(ValueError) as raised:  # noqa: PT011
        cart.validate()
    assert str(raised.value).startswith(message)


def test_defaults_are_not_shared_between_objects() -> None:
    """A list of numbers is copied, as a default factory does."""
    first, second = Cart(), Cart(place=[1.0, -1.0])
    first.load.append(3.0)
    assert second.load == [1.0, 2.0]
    first.validate()
    second.validate()


def test_a_shared_number_gets_its_value_in_the_parts() -> None:
    """In a copy."""
    cart = Cart()
    given = share(cart, {"size": 0.5})
    assert (given.wheel.radius, given.wheel.spokes) == (0.5, 12)
    assert cart.wheel.radius == 0.3


def test_an_argument_is_refused_alike() -> None:
    """By its name, with its unit."""
    require_at_least("latency", 0.0, 0.0, "s")
    for value in (-0.1, math.nan, math.inf):
        with pytest.raises(ValueError, match=r"^latency: must be .*, got .* s$"):
            require_at_least("latency", value, 0.0, "s")
