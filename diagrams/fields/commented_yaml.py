"""A scenario as YAML with units and meanings as comments; what does not act is out."""

import dataclasses
import re
from collections.abc import Iterator
from typing import Any

import yaml

from footfall.diagrams.fields.acting import unmet
from footfall.diagrams.fields.field_tree import plain_key
from footfall.models.values.description import FieldDescription, describe

WIDTH = 88
"""Of a line with its comment, columns; longer meanings are for `footfall fields`."""
CUTS = re.compile(r"[;:] | \(")
"""Where a sentence may end early."""
SENTENCE_END = re.compile(r"(?<!Eq)(?<!Eqs)(?<!Sec)(?<!Fig)\. ")
HEAD = (
    "# Every field that acts in this task; `footfall fields KEY` tells more of each.\n"
)


def commented_yaml(scenario: object) -> str:
    """The YAML text of a scenario, every field that acts spelt out.

    What does not act in its task is left out, unless it differs from its default: then
    it is kept, and the comment says why it does not act. So the text loads back equal.

    Args:
        scenario: a parameter class with a `task`.
    """
    lines = _group(scenario, None, "", "", scenario)
    return HEAD + "".join(f"{line}\n" for line in lines)


def _group(
    value: object, defaults: object, path: str, indent: str, scenario: object
) -> Iterator[str]:
    """Yields the lines of a group's fields."""
    for item in describe(type(value), defaults):
        if item.shared:
            continue
        held, key = getattr(value, item.name), f"{path}{item.name}"
        idle = unmet(plain_key(key), scenario)
        if idle and held == item.default:
            continue
        note = f"Does not act: {idle}" if idle else _meaning(item)
        if dataclasses.is_dataclass(held):
            parts = [*_group(held, item.default, f"{key}.", f"{indent}  ", scenario)]
            if parts:
                yield _line(f"{indent}{item.name}:", note)
            yield from parts
        elif item.is_group and held:
            yield _line(f"{indent}{item.name}:", note)
            for index, part in enumerate(held):
                first, *rest = _group(
                    part, None, f"{key}[{index}].", f"{indent}  ", scenario
                )
                yield f"{indent}- {first.lstrip()}"
                yield from rest
        elif item.named and held:
            yield _line(f"{indent}{item.name}:", note, item.unit)
            for name, part in held.items():
                yield f"{indent}  {_scalar(name)}: {_scalar(part)}"
        else:
            text = f"{indent}{item.name}: {_scalar(held)}"
            yield _line(text, note, item.unit)


def _line(text: str, note: str, unit: str = "") -> str:
    """The line with its unit, and with as much of the note as fits."""
    unit = f"[{unit}]" if unit else ""
    room = WIDTH - len(f"{text}  # {unit} ")
    cuts = [len(note), *(cut.start() for cut in reversed([*CUTS.finditer(note)]))]
    fits = (note[:cut] for cut in cuts if cut <= room and _reads(note[:cut]))
    comment = " ".join(part for part in (unit, next(fits, "")) if part)
    return f"{text}  # {comment}" if comment else text


def _reads(clause: str) -> bool:
    """Whether a clause says something by itself."""
    return " " in clause and clause.count("(") == clause.count(")")


def _meaning(item: FieldDescription) -> str:
    """The first sentence of a field's text; of a choice, what it may be."""
    if item.choices:
        return item.domain()
    sentence = SENTENCE_END.split(item.text, maxsplit=1)[0].removesuffix(".")
    if not item.unit:
        return sentence
    unit = rf", {re.escape(item.unit)}(?=$|[;:,]| \()"
    return re.sub(unit, "", sentence, count=1)


def _scalar(value: Any) -> str:
    """A number, text, list of them or null in one line, as `safe_dump` writes it."""
    text = yaml.safe_dump(value, default_flow_style=True, width=float("inf"))
    return text.removesuffix("\n").removesuffix("\n...")
