"""Falls: by height, by tilt, by what bears the robot."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.falls import Fall, base_height, fall_sign, find_fall
from footfall.models.values.vector import Vector

NOTHING: Vector = np.zeros(0)


@pytest.mark.parametrize(
    ("height", "torso_up", "others", "sign"),
    [
        (0.8, 1.0, 0.0, None),
        (0.52, 1.0, 0.0, None),
        (0.5, 1.0, 0.0, "its base sank to 0.50 m above its feet"),
        (0.8, 0.51, 0.0, None),
        (0.8, 0.49, 0.0, "its torso leaned by 61 deg"),
        (0.8, 1.0, 0.09, None),
        (0.8, 1.0, 0.1, "something else than its soles bore 10% of its weight"),
    ],
)
def test_each_sign_of_a_fall_is_one(height, torso_up, others, sign) -> None:
    """Below 0.6 of the height, beyond 60 deg, from a tenth of the weight on."""
    assert fall_sign(height, 0.85, torso_up, others) == sign


def test_climbing_is_no_fall(climb: Evidence) -> None:
    """Base and feet rise: only the height between them counts."""
    np.testing.assert_allclose(base_height(climb.motion)[0], 0.85)
    assert find_fall(climb.motion, NOTHING, NOTHING) is None


def test_the_first_sign_is_the_fall(climb: Evidence) -> None:
    """Whichever it is."""
    up = climb.motion.torso_up.copy()
    up[400:] = 0.2
    motion = replace(climb.motion, torso_up=up)
    time: Vector = np.array([3.0, 3.5])
    found = find_fall(motion, time, np.array([0.0, 0.3]))
    assert found == Fall(3.5, "something else than its soles bore 30% of its weight")
    found = find_fall(motion, time, np.array([0.0, 0.0]))
    assert found == Fall(4.0, "its torso leaned by 78 deg")
