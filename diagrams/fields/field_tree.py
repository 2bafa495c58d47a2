"""Every field of a scenario by its dotted path, with what is known of it."""

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from footfall.diagrams.schema import FieldError
from footfall.models.values.description import FieldDescription, describe


@dataclass(frozen=True)
class ScenarioField:
    """One field of a scenario, or one group of fields."""

    path: str
    """Dotted, e.g. "scene.boxes[].size", "[]" after what is a list of groups."""
    item: FieldDescription

    @property
    def key(self) -> str:
        """The path without brackets."""
        return plain_key(self.path)


def plain_key(path: str) -> str:
    """A path without the brackets of lists, "scene.boxes[0].x" as "scene.boxes.x"."""
    return re.sub(r"\[[^\]]*\]", "", path)


def walk_fields(
    kind: type, prefix: str = "", defaults: object = None
) -> Iterator[ScenarioField]:
    """Yields the fields of a parameter class, each group before what it holds.

    Args:
        kind: a dataclass.
        prefix: put before each path, with its dot.
        defaults: one of the class whose values are the defaults, where they are not
            the class's own.
    """
    for item in describe(kind, defaults):
        path = f"{prefix}{item.name}" + ("[]" if item.is_group and item.many else "")
        yield ScenarioField(path, item)
        if item.is_group:
            held = None if item.many else item.default
            yield from walk_fields(item.kind, f"{path}.", held)


def select_fields(
    fields: Sequence[ScenarioField], key: str
) -> tuple[ScenarioField, ...]:
    """The field or the group of that path, with all that the group holds.

    Args:
        fields: all there are.
        key: dotted; list elements may have an index.

    Raises:
        FieldError: there is none; what comes nearest is named.
    """
    wanted = plain_key(key)
    found = tuple(
        one for one in fields if f"{one.key}.".startswith(f"{wanted}.") and wanted
    )
    if not found:
        raise FieldError(key, f"no such field; {_nearest(fields, wanted)}")
    if found[0].item.shared:
        raise FieldError(key, f"no such field; did you mean {found[0].item.shared}?")
    return tuple(one for one in found if not one.item.shared)


def _nearest(fields: Sequence[ScenarioField], wanted: str) -> str:
    own = [one.key for one in fields if not one.item.shared]
    same = [key for key in own if key.endswith(f".{wanted}")] if wanted else []
    longer = [key for key in own if key.startswith(wanted)] if wanted else []
    close = sorted(same, key=lambda key: key.count("."))[:3] or longer[:1]
    close = close or difflib.get_close_matches(wanted, own, n=1)
    if not close:
        last = {key.rpartition(".")[2]: key for key in own}
        names = difflib.get_close_matches(wanted.rpartition(".")[2], last, n=1)
        close = [last[name] for name in names]
    if close:
        return f"did you mean {' or '.join(close)}?"
    return f"there are {', '.join(key for key in own if '.' not in key)}"
