"""The command that measures thinking: its percentiles, and the defaults it sets."""

from pathlib import Path

import pytest

from footfall.systems import thinking
from tests.benchmarks.thinking_cases import Sample
from tests.benchmarks.thinking_time import figures, set_defaults


def test_the_default_is_the_95th_percentile_rounded_up() -> None:
    """To 10 ms, of the clock that was asked for."""
    samples = [Sample("stopping", 0.00098 * i, 9.0) for i in range(101)]
    assert figures(samples, "wall")["stopping"] == {
        "samples": 101,
        "median": 0.049,
        "p95": 0.0931,
        "most": 0.098,
        "default": 0.1,
    }
    assert figures(samples, "cpu")["stopping"]["default"] == 9.0


def test_defaults_are_set_where_they_are_declared() -> None:
    """Nothing else changes; a thought without a field is an error."""
    source = Path(thinking.__file__).read_text()
    changed = set_defaults(source, {"stopping": {"default": 7.25}})
    assert '    stopping: float = number(7.25, "s", least=0.0)\n' in changed
    lines = zip(source.splitlines(), changed.splitlines(), strict=True)
    assert sum(before != after for before, after in lines) == 1
    with pytest.raises(ValueError, match=r"^dreaming: found 0 times"):
        set_defaults(source, {"dreaming": {"default": 1.0}})
