"""Callbacks that Drake may hold without keeping a System alive."""

import inspect
import weakref
from collections.abc import Callable
from functools import partial
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def weakly_bound(callback: Callable[P, R]) -> Callable[P, R]:
    """Makes a method, or a `partial` of one, that does not keep its object alive.

    Drake holds a System's callbacks where Python's collector of cycles does not see
    them: a System that declares its own methods is never freed, nor is the diagram
    that it is part of.

    Args:
        callback: its object lives for as long as the callback may be called. Other
            callables are given back as they are; they must not hold the System.
    """
    if isinstance(callback, partial):
        function = weakly_bound(callback.func)
        return partial(function, *callback.args, **callback.keywords)
    if not inspect.ismethod(callback):
        return callback
    method, owner = callback.__func__, weakref.ref(callback.__self__)

    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        result: R = method(owner(), *args, **kwargs)
        return result

    return call
