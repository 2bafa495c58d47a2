"""Flights whose steps differ, and platforms."""

import numpy as np
import pytest

from footfall.models.scenes.flight import FlightParams, PlatformParams
from footfall.models.scenes.staircase import StaircaseParams


def test_a_flight_of_equal_steps_is_the_staircase() -> None:
    """Treads and solids, closed and open."""
    for closed in (True, False):
        stairs = StaircaseParams(steps=2, x=0.7, yaw=0.3, closed_risers=closed)
        flight = FlightParams(
            rises=[0.2] * 2,
            runs=[0.27] * 2,
            width=0.5,
            x=0.7,
            yaw=0.3,
            closed_risers=closed,
        )
        for ours, theirs in zip(flight.treads(), stairs.treads(), strict=True):
            assert ours.X_WR.IsNearlyEqualTo(theirs.X_WR, 1e-12)
            np.testing.assert_allclose(ours.size, theirs.size)
        for ours, theirs in zip(flight.solids(), stairs.solids(), strict=True):
            assert ours.X_WB.IsNearlyEqualTo(theirs.X_WB, 1e-12)
            np.testing.assert_allclose(ours.size, theirs.size)
            assert ours.role == theirs.role == "stairs"


def test_steps_differ_and_a_platform_carries_a_second_flight() -> None:
    """Each run where the one before ends; the second flight stands on the platform."""
    first = FlightParams(rises=[0.14, 0.18], runs=[0.3, 0.9], x=0.5)
    heights = [tread.X_WR.translation()[2] for tread in first.treads()]
    np.testing.assert_allclose(heights, [0.14, 0.32])
    middles = [tread.X_WR.translation()[0] for tread in first.treads()]
    np.testing.assert_allclose(middles, [0.65, 1.25])
    platform = PlatformParams(top=0.5, size=[1.0, 2.0], thickness=0.1)
    (block,) = platform.solids()
    assert block.X_WB.translation()[2] == pytest.approx(0.45)
    second = FlightParams(z=0.5, rises=[0.2], runs=[0.3])
    (step,) = second.solids()
    assert step.X_WB.translation()[2] - step.size[2] / 2 == pytest.approx(0.5)
    assert second.treads()[0].X_WR.translation()[2] == pytest.approx(0.7)


@pytest.mark.parametrize(
    ("params", "message"),
    [
        (FlightParams(rises=[]), "rises: must have at least 1 elements, got 0"),
        (FlightParams(rises=[0.1, -0.1], runs=[1, 1]), r"rises\[1\]: must be positive"),
        (
            FlightParams(rises=[0.1]),
            "runs: must have as many elements as rises, 1, got",
        ),
        (
            FlightParams(closed_risers=False, tread_thickness=0.15),
            "tread_thickness: must be less than every rise",
        ),
        (FlightParams(name=""), "name: must not be empty"),
        (PlatformParams(thickness=0.6), "thickness: must be at most its top, 0.5 m"),
        (PlatformParams(name=""), "name: must not be empty"),
    ],
)
def test_what_is_wrong_is_told(params, message: str) -> None:
    """By field."""
    with pytest.raises(ValueError, match=message):
        params.solids()
