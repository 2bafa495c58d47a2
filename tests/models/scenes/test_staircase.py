"""The staircase's dimensions are those asked for."""

import numpy as np
import pytest

from footfall.models.scenes.staircase import StaircaseParams


def test_steps_rise_by_rise_and_recede_by_run() -> None:
    """Treads and boxes lie where rise, run and width put them."""
    stairs = StaircaseParams(steps=4, rise=0.18, run=0.265, width=1.23, x=0.6)
    for index, (tread, solid) in enumerate(
        zip(stairs.treads(), stairs.solids(), strict=True)
    ):
        assert tread.name == solid.name == f"staircase/step_{index + 1}"
        p_WR = tread.X_WR.translation()
        assert p_WR == pytest.approx(
            [0.6 + (index + 0.5) * 0.265, 0, (index + 1) * 0.18]
        )
        assert tread.size == pytest.approx([0.265, 1.23])
        assert solid.size == pytest.approx([0.265, 1.23, (index + 1) * 0.18])
        bottom = solid.X_WB.translation()[2] - solid.size[2] / 2.0
        assert bottom == pytest.approx(0.0, abs=1e-12)


def test_open_steps_are_plates_under_their_treads() -> None:
    """Without risers the tread stays where it was."""
    stairs = StaircaseParams(closed_risers=False, tread_thickness=0.03)
    for tread, solid in zip(stairs.treads(), stairs.solids(), strict=True):
        assert solid.size == pytest.approx([0.27, 0.5, 0.03])
        top = solid.X_WB.translation()[2] + 0.015
        assert top == pytest.approx(tread.X_WR.translation()[2])


def test_yaw_turns_the_stairs_about_their_foot() -> None:
    """The frame of each tread keeps x up the stairs."""
    stairs = StaircaseParams(x=1.0, y=2.0, yaw=np.pi / 2.0)
    tread = stairs.treads()[2]
    assert tread.X_WR.translation() == pytest.approx([1.0, 2.0 + 2.5 * 0.27, 0.6])
    assert tread.X_WR.rotation().col(0) == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)
    assert tread.X_WR.rotation().col(2) == pytest.approx([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("steps", 0, "steps: must be at least 1, got 0"),
        ("rise", -0.2, "rise: must be positive, got -0.2 m"),
        ("run", 0.0, "run: must be positive, got 0 m"),
        ("width", float("nan"), "width: must be finite, got nan m"),
        ("friction", -1.0, "friction: must be positive, got -1"),
        ("yaw", float("inf"), "yaw: must be finite, got inf rad"),
    ],
)
def test_wrong_field_is_named(field: str, value: float, message: str) -> None:
    """Every field that can be wrong is refused under its name."""
    stairs = StaircaseParams()
    setattr(stairs, field, value)
    with pytest.raises(ValueError, match=message):
        stairs.solids()


def test_open_steps_thicker_than_the_rise_are_refused() -> None:
    """Plates that touch would be closed risers."""
    stairs = StaircaseParams(closed_risers=False, rise=0.1, tread_thickness=0.1)
    with pytest.raises(ValueError, match="tread_thickness: must be less than the rise"):
        stairs.solids()
