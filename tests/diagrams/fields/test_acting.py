"""What is said not to act in a task is not looked at when the task is built."""

import dataclasses
from typing import Any

import pytest

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.controller_params import ControllerParams
from footfall.diagrams.fields.acting import ACTS, acts_in_task, told, unmet
from footfall.diagrams.fields.field_tree import walk_fields
from footfall.diagrams.scenario import Scenario, load_scenario

PREFIX = "parameters."


class Tripwire:
    """Stands for parameters that nobody may look at."""

    def __init__(self, path: str) -> None:
        """Knows which."""
        self._path = path

    def __getattr__(self, name: str) -> Any:
        """Tells who looked."""
        raise AssertionError(f"{self._path}.{name} was looked at")


def _trip(value: object, path: str, whole: str) -> None:
    """Puts a tripwire in the place of a group; numbers are checked with their group."""
    *groups, last = path.split(".")
    for name in groups:
        value = getattr(value, name)
        if isinstance(value, Tripwire):
            return
    if dataclasses.is_dataclass(getattr(value, last)):
        setattr(value, last, Tripwire(whole))


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("stairs-exp1", []),
        ("stairs-exp1", ["task.mode=quasi_static"]),
        ("obstacle-15cm", []),
        ("obstacle-15cm", ["task.mode=quasi_static"]),
        ("room", []),
        ("stand", []),
    ],
)
def test_a_task_is_built_without_what_does_not_act(
    name: str, changes: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever looks at it trips."""
    scenario, untouched = load_scenario(name, changes), load_scenario(name, changes)
    idle = [path for path in ACTS if unmet(path, scenario)]
    assert idle
    controllers = Scenario.controllers

    def guarded(self: Scenario) -> ControllerParams:
        # What several share is written into each, whether that acts or not.
        params = controllers(untouched)
        for path in idle:
            if path.startswith(PREFIX):
                _trip(params, path.removeprefix(PREFIX), path)
            elif path.startswith("sensors."):
                _trip(self, path, path)
        return params

    monkeypatch.setattr(Scenario, "controllers", guarded)
    build_task(scenario)


def test_what_acts_is_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """The check above can fail."""
    controllers = Scenario.controllers

    def guarded(self: Scenario) -> ControllerParams:
        params = controllers(self)
        _trip(params, "segmenter", "parameters.segmenter")
        return params

    monkeypatch.setattr(Scenario, "controllers", guarded)
    with pytest.raises(AssertionError, match=r"parameters\.segmenter\.\w+ was looked"):
        build_task(load_scenario("stairs-exp1"))


def test_every_path_is_a_field() -> None:
    """One that is renamed does not go on silently."""
    paths = {one.key for one in walk_fields(Scenario)}
    assert set(ACTS) - paths == set()


def test_it_is_said_in_words() -> None:
    """For the table of fields and for the comments of a scenario."""
    room = load_scenario("room")
    assert unmet("parameters.segmenter", room) == "task.kind is not stair_climbing"
    assert unmet("parameters.floor", room) == ""
    assert told("parameters.path_planner") == "task.kind is room_crossing"
    assert not acts_in_task("parameters.segmenter.seed", "room_crossing")
    assert acts_in_task("parameters.segmenter.seed", "stair_climbing")
