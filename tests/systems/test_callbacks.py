"""Callbacks that do not keep their object alive."""

import gc
import weakref
from functools import partial

from footfall.systems.callbacks import weakly_bound


class Adder:
    """Adds to what it was made with."""

    def __init__(self, number: int) -> None:
        self.number = number

    def add(self, other: int, *, twice: bool = False) -> int:
        """The sum, or twice the sum."""
        return (self.number + other) * (2 if twice else 1)


def test_a_method_is_called_as_it_is() -> None:
    """Arguments and result pass through, those of a `partial` first."""
    adder = Adder(3)
    assert weakly_bound(adder.add)(4) == 7
    assert weakly_bound(adder.add)(4, twice=True) == 14
    assert weakly_bound(partial(adder.add, 5, twice=True))() == 16


def test_neither_method_nor_partial_keeps_the_object() -> None:
    """It goes with its last other reference."""
    adder = Adder(3)
    callbacks = [weakly_bound(adder.add), weakly_bound(partial(adder.add, 5))]
    gone = weakref.ref(adder)
    del adder
    gc.collect()
    assert gone() is None
    assert len(callbacks) == 2


def test_a_function_is_given_back() -> None:
    """There is nothing to let go of."""
    assert weakly_bound(len) is len
