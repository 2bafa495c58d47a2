"""Checks parsed YAML against nested dataclasses and says in one line what is wrong.

Drake's `yaml_load_typed` loads what has passed here; the checks are here because its
own messages name neither the path to a field nor what it might have meant.
"""

import dataclasses
import difflib
import math
import re
import types
import typing
from typing import Any, TypeAlias

import yaml

from footfall.models.values.bounds import SHARED
from footfall.models.values.validation import Parameters

Mapping: TypeAlias = dict[str, Any]
"""A mapping as parsed YAML has it; its values are checked against the schema."""


class FieldError(ValueError):
    """Something is wrong with one field."""

    def __init__(self, path: str, reason: str) -> None:
        """Makes an error at a path, "scene.boxes[0].size" say; empty is the whole."""
        super().__init__(f"{path}: {reason}" if path else reason)
        self.path = path


class _UniqueKeyLoader(yaml.SafeLoader):
    """Refuses mappings in which a key occurs twice."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                continue
            if key.value in seen:
                raise yaml.MarkedYAMLError(
                    problem=f"the key {key.value!r} occurs twice",
                    problem_mark=key.start_mark,
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def parse_yaml(text: str) -> Any:
    """Parses a YAML document to plain data.

    Raises:
        FieldError: it is not YAML; the line is named.
    """
    try:
        return yaml.load(text, _UniqueKeyLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}" if mark else ""
        raise FieldError(where, f"not YAML: {_one_line(error.problem)}") from None
    except yaml.YAMLError as error:
        raise FieldError("", f"not YAML: {_one_line(error)}") from None


def set_field(data: Mapping, path: str, value: object) -> None:
    """Sets one field of parsed YAML, making the mappings on the way to it.

    Args:
        data: the document; changed in place.
        path: dotted, "scene.staircase.rise"; elements of lists as in "boxes[0].x".
        value: plain data.

    Raises:
        FieldError: the path runs through something that has no fields.
    """
    parts = [part for part in re.split(r"[.\[\]]+", path) if part]
    if not parts:
        raise FieldError("", "no field is named")
    target: Any = data
    for index, part in enumerate(parts):
        last = index == len(parts) - 1
        key: Any = part
        if isinstance(target, list):
            if not part.isdecimal() or int(part) >= len(target):
                raise FieldError(path, f"no element {part}; the list has {len(target)}")
            key = int(part)
        elif not isinstance(target, dict):
            raise FieldError(".".join(parts[:index]), "has no fields")
        if last:
            target[key] = value
        else:
            if isinstance(target, dict) and target.get(key) is None:
                target[key] = {}
            target = target[key]


def check(data: object, schema: Any, path: str = "") -> None:
    """Checks parsed YAML against a schema.

    Args:
        data: plain data.
        schema: bool, int, float, str, a dataclass, a list of one of them, a dict from
            str to one of them, or one of them or None.
        path: where the data lies in the document.

    Raises:
        FieldError: a field does not exist, has the wrong type or is not finite.
        TypeError: the schema holds another type.
    """
    origin, arguments = typing.get_origin(schema), typing.get_args(schema)
    if origin in (typing.Union, types.UnionType):
        if data is not None:
            check(data, arguments[0], path)
    elif origin is list:
        if not isinstance(data, list):
            raise FieldError(path, f"must be a list, got {_shown(data)}")
        for index, item in enumerate(data):
            check(item, arguments[0], f"{path}[{index}]")
    elif origin is dict:
        if not isinstance(data, dict):
            raise FieldError(path, f"must hold fields, got {_shown(data)}")
        for name, item in data.items():
            check(item, arguments[1], _join(path, str(name)))
    elif dataclasses.is_dataclass(schema):
        _check_fields(data, schema, path)
    elif schema is bool:
        if not isinstance(data, bool):
            raise FieldError(path, f"must be true or false, got {_shown(data)}")
    elif schema is str:
        if not isinstance(data, str):
            raise FieldError(path, f"must be a text, got {_shown(data)}")
    elif schema in (int, float):
        _check_number(data, schema, path)
    else:
        raise TypeError(f"{path}: a scenario cannot hold a {schema}")


def plain(value: Any) -> Any:
    """Plain data that `check` accepts, from a dataclass and all that it holds."""
    if isinstance(value, list):
        return [plain(item) for item in value]
    if not dataclasses.is_dataclass(value):
        return value
    return {
        item.name: plain(getattr(value, item.name))
        for item in dataclasses.fields(value)
        if not item.metadata.get(SHARED)
    }


def validate(value: Parameters) -> None:
    """Checks the fields of a value and of all its parts.

    Raises:
        FieldError: one of them is wrong.
    """
    try:
        value.validate()
    except ValueError as error:
        path, _, reason = _one_line(error).partition(": ")
        raise FieldError(path, reason) from None


def _check_fields(data: object, schema: Any, path: str) -> None:
    if not isinstance(data, dict):
        raise FieldError(path, f"must hold fields, got {_shown(data)}")
    fields = {item.name: item for item in dataclasses.fields(schema)}
    one = {name: item.metadata.get(SHARED) for name, item in fields.items()}
    known = {
        name: kind
        for name, kind in typing.get_type_hints(schema).items()
        if not one[name]
    }
    for name in data:
        if name not in known:
            shared = one.get(name)
            hint = f"; did you mean {shared}?" if shared else _hint(name, known)
            raise FieldError(_join(path, str(name)), f"no such field{hint}")
    for name, item in data.items():
        check(item, known[name], _join(path, name))


def _check_number(data: object, schema: type, path: str) -> None:
    kind = "a whole number" if schema is int else "a number"
    wrong = FieldError(path, f"must be {kind}, got {_shown(data)}")
    # YAML 1.1 reads 1e-3, without a point, as text; Drake takes it for a number.
    readable = (int, float, str) if schema is float else (int, float)
    if isinstance(data, bool) or not isinstance(data, readable):
        raise wrong
    try:
        number = float(data)
    except (ValueError, OverflowError):
        raise wrong from None
    if not math.isfinite(number):
        raise FieldError(path, f"must be finite, got {number}")
    if schema is int and not number.is_integer():
        raise wrong


def _hint(name: object, known: Mapping) -> str:
    close = difflib.get_close_matches(str(name), list(known), n=1)
    if close:
        return f"; did you mean {close[0]}?"
    return f"; there are {', '.join(known)}"


def _join(path: str, name: str) -> str:
    return f"{path}.{name}" if path else name


def _shown(data: object) -> str:
    if data is None:
        return "nothing"
    if isinstance(data, dict):
        return "fields"
    return "a list" if isinstance(data, list) else repr(data)


def _one_line(text: object) -> str:
    return " ".join(str(text).split())
