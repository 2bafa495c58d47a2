"""A logged signal is given again at the ticks at which it was logged."""

import numpy as np
import pytest

from footfall.systems.ports import eval_vector
from footfall.systems.signal_playback import SignalPlayback


@pytest.mark.parametrize(
    ("now", "sample"),
    [(0.0, 1.0), (0.0049, 1.0), (0.005, 2.0), (0.0099, 2.0), (9.0, 3.0)],
)
def test_the_last_sample_before_now(now: float, sample: float) -> None:
    """Also where the clock's last bits differ."""
    time = np.array([0.0, 0.005 + 1e-12, 0.01])
    system = SignalPlayback(time, np.array([[1.0], [2.0], [3.0]]))
    context = system.CreateDefaultContext()
    context.SetTime(now)
    assert eval_vector(system.get_output_port(0), context) == [sample]


def test_nothing_to_play_is_refused() -> None:
    """And samples without times."""
    for count in (0, 2):
        with pytest.raises(ValueError, match=r"^samples: must be one a time"):
            SignalPlayback(np.zeros(count), np.zeros((0, 3)))
