"""A scenario as fields by their paths, to compare it with another."""

from collections.abc import Iterator
from typing import Any

import yaml

from footfall.diagrams.fields.commented_yaml import commented_yaml
from footfall.models.values.validation import Parameters


def flat_fields(scenario: Parameters) -> dict[str, Any]:
    """Lists the fields that act in a scenario, by dotted path, as plain data.

    Args:
        scenario: a `Scenario`, every field resolved.
    """
    return dict(_flat(yaml.safe_load(commented_yaml(scenario)), ""))


def _flat(data: dict[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for name, value in data.items():
        if isinstance(value, dict) and value:
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value
