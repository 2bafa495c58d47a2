"""What the figures of a summary mean: the texts that stand below its fields."""

import dataclasses
from dataclasses import dataclass
from functools import cache

from footfall.diagrams.judge.summary import Summary
from footfall.models.values.field_texts import field_texts


@dataclass(frozen=True)
class Meaning:
    """A text, and the figures that it explains."""

    names: tuple[str, ...]
    """Keys of `summary.json`."""
    text: str
    """In one line, without a full stop; names of figures in backticks."""


@cache
def summary_meanings() -> tuple[Meaning, ...]:
    """Explains every figure of a summary once, in the order of its fields.

    A field without a text of its own shares that of the next field that has one.

    Raises:
        LookupError: the last fields have none.
    """
    texts = field_texts(Summary)
    meanings: list[Meaning] = []
    names: list[str] = []
    for field in dataclasses.fields(Summary):
        names.append(field.name)
        if field.name in texts:
            text = texts[field.name].removesuffix(".")
            meanings.append(Meaning(tuple(names), text))
            names = []
    if names:
        raise LookupError(f"no text below {', '.join(names)}")
    return tuple(meanings)


def meanings_table() -> str:
    """Writes the meanings as the Markdown table that the README holds."""
    rows = [
        f"| {', '.join(f'`{name}`' for name in meaning.names)} | {meaning.text} |"
        for meaning in summary_meanings()
    ]
    return "\n".join(["| figure | is |", "|---|---|", *rows])
