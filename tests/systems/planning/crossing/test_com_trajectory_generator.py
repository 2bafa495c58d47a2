"""CWTG1 in its three forms, alone and in a whole crossing."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import GRAVITY, ZmpPreviewParams
from footfall.systems.planning.crossing.com_trajectory_generator import (
    FORMS,
    com_tracker,
)
from footfall.systems.planning.crossing.params import CrossingParams
from tests.systems.planning.crossing.crossing_cases import planned

PARAMS = ZmpPreviewParams(com_height=0.85)
N = 1200


def _steps() -> Vector:
    """Rest, a step aside and ahead, rest."""
    zmp: Vector = np.zeros((N, 2))
    zmp[400:, 0] = 0.2
    zmp[400:560, 1] = 0.09
    return zmp


def _level() -> Vector:
    return np.full(N, PARAMS.com_height / GRAVITY)


@pytest.mark.parametrize("form", FORMS)
def test_the_zmp_follows_its_reference(form: str) -> None:
    """From rest to rest; in the middle of a long single support within 3 mm."""
    motion = com_tracker(form, PARAMS, np.zeros(2))(_steps(), _level())
    assert np.abs(motion.zmp - _steps())[430:530].max() < 3e-3
    np.testing.assert_allclose(motion.com[0], 0.0, atol=1e-9)
    np.testing.assert_allclose(motion.com[-1], [0.2, 0.0], atol=1e-3)
    assert np.abs(motion.velocity[[0, -1]]).max() < 5e-3


@pytest.mark.parametrize("form", FORMS)
def test_it_begins_where_the_com_rests(form: str) -> None:
    """Beside the first reference, as the eyes may have it."""
    start = np.array([0.01, -0.005])
    motion = com_tracker(form, PARAMS, start)(_steps(), _level())
    np.testing.assert_allclose(motion.com[0], start, atol=1e-9)
    np.testing.assert_allclose(motion.velocity[0], 0.0, atol=1e-9)


def test_kajitas_form_and_the_window_move_the_com_alike() -> None:
    """Two forms of one idea; the exact one is near as long as the height is level."""
    preview, window, exact = (
        com_tracker(form, PARAMS, np.zeros(2))(_steps(), _level()).com
        for form in ("preview", "window", "exact")
    )
    assert np.abs(preview - window).max() < 3e-3
    assert np.abs(preview - exact).max() < 3e-3


def test_only_the_exact_form_knows_of_the_height() -> None:
    """A CoM a tenth lower has a ZMP that the cart's forms do not see."""
    lower = 0.9 * _level()
    for form, same in (("preview", True), ("window", True), ("exact", False)):
        track = com_tracker(form, PARAMS, np.zeros(2))
        apart = np.abs(track(_steps(), lower).com - track(_steps(), _level()).com).max()
        assert (apart < 1e-12) == same


def test_all_three_plan_the_crossing() -> None:
    """The filter brings each ZMP to its reference; the CoMs are a millimetre apart.

    While the feet step: before and after "exact" leaves the ZMP free.
    """
    coms = {}
    for form in FORMS:
        motion, _ = planned(0.05, 0.15, replace(CrossingParams(), cwtg1=form))
        report = motion.report
        for before, after in zip(
            report.zmp_error_before, report.zmp_error_after, strict=True
        ):
            assert after < before / 5.0
        assert report.gap > 0.035
        assert report.short == 0.0
        lift, land = motion.phases[0].end, motion.phases[-1].start
        rows = slice(round(lift / motion.period), round(land / motion.period))
        coms[form] = motion.com[rows]
    assert 1e-4 < np.abs(coms["preview"] - coms["window"]).max() < 2e-3
    assert 1e-4 < np.abs(coms["preview"] - coms["exact"]).max() < 2e-3


def test_another_form_is_refused() -> None:
    """With those that there are."""
    with pytest.raises(ValueError, match="form: must be one of exact, preview, window"):
        com_tracker("guess", PARAMS, np.zeros(2))
    with pytest.raises(ValueError, match="cwtg1: must be one of"):
        CrossingParams(cwtg1="guess").validate()
