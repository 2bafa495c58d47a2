"""A JSON schema of scenario files, from which editors complete and check them."""

import math
from typing import Any

from footfall.diagrams.schema import Mapping
from footfall.models.values.bounds import Bounds
from footfall.models.values.description import FieldDescription, describe

DIALECT = "https://json-schema.org/draft/2020-12/schema"
TYPES = {bool: "boolean", float: "number", int: "integer", str: "string"}


def json_schema(kind: type, title: str) -> Mapping:
    """The schema of what may be written of a parameter class (draft 2020-12).

    It holds what each field states alone; what concerns several is checked where a
    scenario is loaded. Names that begin with an underscore are free at the top, as in
    a scenario.

    Args:
        kind: a dataclass.
        title: what it describes.
    """
    return {
        "$schema": DIALECT,
        "title": title,
        **_group(kind, None),
        "patternProperties": {"^_": True},
    }


def _group(kind: type, defaults: object) -> Mapping:
    return {
        "type": "object",
        "properties": {
            item.name: _property(item)
            for item in describe(kind, defaults)
            if not item.shared
        },
        "additionalProperties": False,
    }


def _property(item: FieldDescription) -> Mapping:
    described = item.text
    if item.unit:
        described = f"[{item.unit}] {item.text}"
    found: Mapping = {"description": described} if described else {}
    element: Mapping
    if item.is_group:
        element = _group(item.kind, None if item.many else item.default)
    else:
        found["default"] = item.default
        element = {"type": TYPES[item.kind], **_limits(item.bounds)}
        if item.choices:
            element["enum"] = list(item.choices)
    if item.many:
        element = {"type": "array", "items": element, **_lengths(item.bounds)}
    if item.named:
        element = {"type": "object", "additionalProperties": element}
    if item.optional:
        element["type"] = [element["type"], "null"]
    return {**found, **element}


def _limits(bounds: Bounds | None) -> Mapping:
    if bounds is None:
        return {}
    limits = {
        "exclusiveMinimum": bounds.above,
        "minimum": bounds.least,
        "exclusiveMaximum": bounds.below,
        "maximum": bounds.most,
    }
    return {name: limit for name, limit in limits.items() if math.isfinite(limit)}


def _lengths(bounds: Bounds | None) -> dict[str, Any]:
    if bounds is None:
        return {}
    if bounds.length is not None:
        return {"minItems": bounds.length, "maxItems": bounds.length}
    return {"minItems": bounds.fewest} if bounds.fewest else {}
