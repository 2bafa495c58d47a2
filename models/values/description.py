"""Descriptions of the fields of parameter classes, for people and for editors."""

import dataclasses
import inspect
import json
import sys
import textwrap
import types
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from footfall.models.values.bounds import BOUNDS, CHOICES, SHARED, Bounds
from footfall.models.values.field_texts import field_texts

WIDTH = 80
"""Of the lines of a class's documentation, columns."""
SCALARS = {bool: "true or false", float: "number", int: "whole number", str: "text"}
"""What the types of fields are called."""


@dataclass(frozen=True)
class FieldDescription:
    """What a field of a parameter class is, may be and means."""

    name: str
    kind: type
    """bool, float, int or str, of a list its elements'; of a group its class."""
    many: bool
    """Whether it is a list."""
    named: bool
    """Whether it maps names to values of that kind, or to lists of them."""
    optional: bool
    """Whether it may be null."""
    default: Any
    bounds: Bounds | None
    """Of a number, or of each number of a list."""
    choices: tuple[str, ...]
    """What a text may be; empty for any."""
    shared: str
    """Path of the scenario's field that it takes its value of; empty for its own."""
    text: str
    """What it means, on one line; empty where the source is not at hand."""

    @property
    def is_group(self) -> bool:
        """Whether it holds fields, or is a list of what holds fields."""
        return dataclasses.is_dataclass(self.kind)

    @property
    def unit(self) -> str:
        """Of the number or of each number of the list; empty where it has none."""
        return self.bounds.unit if self.bounds else ""

    def domain(self) -> str:
        """What it may be, e.g. "list of 3 numbers in [-1000, 1000] m, or null".

        Of an interval "(" and ")" exclude the bound; of a group it is the class.
        """
        if self.is_group:
            words = f"{'list of ' * self.many}{self.kind.__name__}"
        elif self.choices:
            words = f"one of {', '.join(self.choices)}"
        else:
            words = self._numbers() if self.many else SCALARS[self.kind]
        if self.bounds:
            words += f" in {self.bounds.interval()} {self.unit}".rstrip()
        if self.named:
            words += " by name"
        return f"{words}, or null" if self.optional else words

    def shown_default(self) -> str:
        """The default with its unit, as `--set` takes the value; "null" for none."""
        if self.is_group and not self.many:
            return "null" if self.default is None else ""
        if isinstance(self.default, str) and self.default:
            return self.default
        unit = self.unit if self.default not in (None, []) else ""
        return f"{json.dumps(self.default)} {unit}".rstrip()

    def _numbers(self) -> str:
        length = self.bounds.length if self.bounds else None
        fewest = self.bounds.fewest if self.bounds else 0
        count = f"{length} " if length else f"at least {fewest} " if fewest else ""
        return f"list of {count}{SCALARS[self.kind]}s"


def describe(kind: type, defaults: object = None) -> tuple[FieldDescription, ...]:
    """Describes every field of a parameter class, in their order.

    Args:
        kind: a dataclass.
        defaults: one of the class whose values are the defaults, where they are not
            the class's own.

    Raises:
        TypeError: a field is of a type that parameters do not have.
    """
    hints, texts = typing.get_type_hints(kind), field_texts(kind)
    return tuple(
        _describe(item, hints[item.name], _default(item, defaults), texts)
        for item in dataclasses.fields(kind)
    )


class ClassDocument:
    """Documentation of a class that lists its fields, made when it is asked for."""

    def __init__(self, own: str) -> None:
        """Keeps the docstring as it is written."""
        self.own = inspect.cleandoc(own)

    def __get__(self, instance: object, kind: type) -> str:
        """The docstring, then each field's domain, default and text."""
        # `dataclass` asks while it makes the class, and sets this at last.
        if "__match_args__" not in vars(kind):
            return self.own or kind.__name__
        lines = [self.own or kind.__name__, "", "Fields:"]
        if not field_texts(kind) and dataclasses.fields(kind):
            home = sys.modules.get(kind.__module__)
            where = getattr(home, "__file__", None) or kind.__module__
            lines.append(f"    (without texts: their source, {where}, is not at hand)")
        for item in describe(kind):
            lines += _documented(item)
        return "\n".join(lines)


def class_text(kind: type) -> str:
    """The docstring of a parameter class as it is written, without its fields."""
    document = vars(kind).get("__doc__")
    return document.own if isinstance(document, ClassDocument) else kind.__doc__ or ""


def _documented(item: FieldDescription) -> list[str]:
    default = item.shown_default()
    head = f"{item.name}: {item.domain()}"
    head += f"; {default} by default" if default else ""
    if item.shared:
        head += f"; of a scenario its {item.shared}"
    wrapped = textwrap.wrap(head, WIDTH - 4, subsequent_indent="    ")
    lines = [f"    {line}" for line in wrapped]
    return lines + [f"        {line}" for line in textwrap.wrap(item.text, WIDTH - 8)]


def _default(item: "dataclasses.Field[Any]", defaults: object) -> Any:
    if defaults is not None:
        return getattr(defaults, item.name)
    if item.default_factory is not dataclasses.MISSING:
        return item.default_factory()
    return None if item.default is dataclasses.MISSING else item.default


def _describe(
    item: "dataclasses.Field[Any]", hint: Any, default: Any, texts: Mapping[str, str]
) -> FieldDescription:
    optional = typing.get_origin(hint) in (typing.Union, types.UnionType)
    if optional:
        hint = typing.get_args(hint)[0]
    named = typing.get_origin(hint) is dict
    if named:
        hint = typing.get_args(hint)[1]
    many = typing.get_origin(hint) is list
    if many:
        hint = typing.get_args(hint)[0]
    if hint not in SCALARS and not dataclasses.is_dataclass(hint):
        raise TypeError(f"{item.name}: parameters cannot hold a {hint}")
    return FieldDescription(
        name=item.name,
        kind=hint,
        many=many,
        named=named,
        optional=optional,
        default=default,
        bounds=item.metadata.get(BOUNDS),
        choices=item.metadata.get(CHOICES, ()),
        shared=item.metadata.get(SHARED) or "",
        text=texts.get(item.name, ""),
    )
