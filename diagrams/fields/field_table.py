"""The fields of a scenario as text on 80 columns."""

import textwrap
from collections.abc import Iterable, Iterator

from footfall.diagrams.fields.acting import told
from footfall.diagrams.fields.field_tree import ScenarioField
from footfall.models.values.description import class_text

WIDTH = 80
"""Columns."""
INDENT = "    "


def field_lines(fields: Iterable[ScenarioField]) -> Iterator[str]:
    """Yields what is known of each field: a head, then its meaning, indented.

    A head reads "KEY = DEFAULT UNIT" and what the field may be.
    """
    first = True
    for one in fields:
        if one.item.is_group and not first:
            yield ""
        first = False
        yield from _head(one)
        for paragraph in _meaning(one):
            yield from textwrap.wrap(
                paragraph, WIDTH, initial_indent=INDENT, subsequent_indent=INDENT
            )


def _head(one: ScenarioField) -> Iterator[str]:
    default, domain = one.item.shown_default(), one.item.domain()
    key = f"{one.path} = {default}" if default else one.path
    gap = WIDTH - len(key) - len(domain)
    if gap >= 2:
        yield key + " " * gap + domain
    else:
        yield key
        yield from textwrap.wrap(
            domain, WIDTH, initial_indent=INDENT, subsequent_indent=INDENT
        )


def _meaning(one: ScenarioField) -> Iterator[str]:
    if one.item.text:
        yield one.item.text
    if one.item.is_group:
        yield from class_text(one.item.kind).split("\n\n")
    when = told(one.key)
    if when:
        yield f"Acts where {when}."
