"""The JSON schema takes what a scenario may hold, and nothing that is refused alone."""

from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator

from footfall.diagrams.fields.json_schema import json_schema
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.diagrams.schema import plain
from footfall.diagrams.shipped import shipped_scenarios

SCHEMA = json_schema(Scenario, "A scenario")
VALIDATOR = Draft202012Validator(SCHEMA)


def test_it_is_a_schema() -> None:
    """Of draft 2020-12."""
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize(("name", "text"), sorted(shipped_scenarios().items()))
def test_shipped_scenarios_pass(name: str, text: str) -> None:
    """As they are written, and with every field spelt out."""
    VALIDATOR.validate(yaml.safe_load(text))
    VALIDATOR.validate(plain(load_scenario(name)))


@pytest.mark.parametrize(
    ("text", "path"),
    [
        ("{scene: {stairs: {}}}", ["scene"]),
        ("{scene: {staircase: {rise: 0}}}", ["scene", "staircase", "rise"]),
        ("{scene: {staircase: {rise: high}}}", ["scene", "staircase", "rise"]),
        ("{scene: {staircase: {steps: 2.5}}}", ["scene", "staircase", "steps"]),
        ("{scene: {room: null}}", ["scene", "room"]),
        ("{scene: {boxes: [{size: [1, 1]}]}}", ["scene", "boxes", 0, "size"]),
        ("{task: {kind: fly}}", ["task", "kind"]),
        ("{parameters: {ik: {period: 0.1}}}", ["parameters", "ik"]),
        ("{simulation: {time_step: 1}}", ["simulation", "time_step"]),
        ("[1]", []),
    ],
)
def test_wrong_documents_do_not(text: str, path: list[Any]) -> None:
    """The field is pointed at."""
    errors = [*VALIDATOR.iter_errors(yaml.safe_load(text))]
    assert [list(error.absolute_path) for error in errors] == [path]


def test_names_with_an_underscore_are_free() -> None:
    """At the top, as in a scenario."""
    VALIDATOR.validate({"_note": [1, 2], "scene": {"staircase": None}})


def test_editors_are_told_meaning_unit_and_default() -> None:
    """Of each field."""
    rise = SCHEMA["properties"]["scene"]["properties"]["staircase"]["properties"][
        "rise"
    ]
    assert rise["description"].startswith("[m] Height of each step")
    assert (rise["default"], rise["exclusiveMinimum"]) == (0.2, 0.0)
