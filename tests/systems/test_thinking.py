"""Thinking takes time: states that come, when they come, and how long by default."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import pytest

from footfall.systems.thinking import ThinkingParams, Thought, ready_time

MEASURED = Path(__file__).parents[1] / "benchmarks" / "thinking_time.json"


@dataclass(frozen=True, eq=False)
class Answer(Thought):
    """A state."""

    text: str


def test_a_thought_is_there_when_it_is_ready() -> None:
    """Until then the state is the very same, what is held included."""
    waiting = Answer("?").until(1.5, Answer("42"))
    assert waiting.at(1.49) is waiting
    assert waiting.text == "?"
    # A clock that is late by rounding does not hold it back.
    for time in (1.5 - 1e-9, 1.5, 9.0):
        assert waiting.at(time) == Answer("42")
    assert Answer("42").at(9.0).text == "42"


def test_thoughts_that_follow_each_other_come_in_turn() -> None:
    """Each at its time; all of them where all are late."""
    last = Answer("c")
    first = Answer("a").until(1.0, Answer("b").until(2.0, last))
    assert [first.at(time).text for time in (0.5, 1.0, 1.9, 2.0)] == [
        "a",
        "b",
        "b",
        "c",
    ]
    assert first.at(5.0) is last


@pytest.mark.parametrize(
    ("latency", "ready"),
    [(0.0, 3.0), (0.01, 3.025), (0.025, 3.025), (0.026, 3.05), (0.3, 3.3)],
)
def test_a_result_is_ready_at_an_update(latency: float, ready: float) -> None:
    """The first one that is not before its time; at once where it takes none."""
    assert ready_time(3.0, latency, 0.025) == pytest.approx(ready, abs=1e-9)
    assert ready_time(3.0, 0.0, 0.025) == 3.0


def test_defaults_are_what_was_measured() -> None:
    """Every one of them; `tests/benchmarks/thinking_time.py` writes both."""
    thoughts = json.loads(MEASURED.read_text())["thoughts"]
    assert asdict(ThinkingParams()) == {
        name: row["default"] for name, row in thoughts.items()
    }
    for row in thoughts.values():
        assert row["p95"] <= row["default"] < row["p95"] + 0.011


@pytest.mark.parametrize("name", list(asdict(ThinkingParams())))
@pytest.mark.parametrize("value", [-0.01, np.nan, np.inf])
def test_a_time_that_makes_no_sense_is_refused(name: str, value: float) -> None:
    """By name; none at all is a time."""
    with pytest.raises(ValueError, match=rf"^{name}: must be .*, got "):
        ThinkingParams(**{name: value}).validate()
    ThinkingParams(**{name: 0.0}).validate()
