"""FU in its quasi-static form: Eqs. 6 and 8, and the knee that carries."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.obstacle import Feasibility
from footfall.systems.planning.crossing.feasibility_unit import (
    FeasibilityParams,
    check_double_support,
    feasibility_unit,
)
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.crossing.quasi_static_check import balance_of
from footfall.systems.planning.crossing.quasi_static_unit import (
    Balance,
    QuasiStaticCrossingParams,
    quasi_static_unit,
)
from tests.systems.planning.crossing.crossing_cases import WAIST, body, scratch

QUASI = QuasiStaticCrossingParams()
MARGINS = FeasibilityParams()


def _asked(
    height: float,
    width: float = 0.05,
    quasi: QuasiStaticCrossingParams = QUASI,
    **changed: float,
) -> Feasibility:
    balance = replace(balance_of(body(), scratch(), quasi), **changed)
    return quasi_static_unit(
        Section(width, height), WAIST, body().leg, MARGINS, quasi, balance
    )


@pytest.mark.parametrize("height", [0.05, 0.15])
def test_both_ends_of_phase_2_meet_their_constraints(height: float) -> None:
    """Reach, limits and room, checked again; the CoM over the sole that carries."""
    key = _asked(height).key
    assert key is not None
    assert key.X_end is not None
    assert key.Z_end is not None
    balance = balance_of(body(), scratch(), QUASI)
    sole = body().leg.sole
    over_rear = key.X_hds - balance.waist_begin
    over_front = key.X_end - balance.waist_end - key.X_ads
    for place in (over_rear, over_front):
        assert QUASI.margin - sole.heel <= place <= sole.toe - QUASI.margin
    inflated = Section(0.05 + 2.0 * MARGINS.s_w, height + MARGINS.s_h)
    checked = check_double_support(
        inflated,
        np.full(2, key.X_ads),
        np.array([key.X_hds, key.X_end]),
        np.array([key.Z_hds, key.Z_end]),
        np.full(2, key.front - MARGINS.s_w),
        body().leg,
    )
    assert (checked.reached == 1.0).all()
    assert (checked.limits <= -MARGINS.joint_margin).all()
    assert (checked.gap > 0.0).all()
    levers = np.diag(checked.knees) - [over_rear, over_front + key.X_ads]
    carried = balance.weight * levers
    assert (carried <= QUASI.torque_share * balance.knee_effort).all()


def test_the_waist_has_to_travel_and_is_lower_than_dynamically() -> None:
    """Remark 1 of the paper: the ends of phase 2 limit the quasi-static crossing."""
    slow = _asked(0.15).key
    fast = feasibility_unit(Section(0.05, 0.15), WAIST, body().leg, MARGINS).key
    assert slow is not None
    assert slow.X_end is not None
    assert fast is not None
    assert fast.X_end is None
    assert slow.X_end - slow.X_hds > 0.2
    assert slow.Z_hds < fast.Z_hds


def test_it_names_the_equation_that_fails() -> None:
    """Obstacle, knee, sole and width, each as itself."""
    high = _asked(0.30)
    assert high.key is None
    assert high.constraint.startswith("Eq. 6, the CoM over the rear foot: Eq. 5")
    weak = _asked(0.15, knee_effort=40.0)
    assert weak.key is None
    assert weak.constraint.startswith("Eq. 6, the CoM over the rear foot: the knee")
    assert "more than 38 Nm" in weak.constraint
    far = replace(QUASI, com_end=-0.07)
    assert "Eq. 8: the CoM is to be 0.005 m inside" in _asked(0.1, quasi=far).constraint
    assert "0.40 m wide" in _asked(0.1, width=0.4).constraint


def test_without_lean_and_arms_the_front_knee_cannot_carry() -> None:
    """What the posture is for: Eq. 8 fails by torque, with it there is room."""
    stiff = replace(QUASI, lean=0.0, arms=0.0)
    assert _asked(0.15, quasi=stiff).key is None
    answer = _asked(0.05, quasi=stiff)
    assert answer.key is None
    assert answer.constraint.startswith("Eq. 8, the CoM over the front foot")
    assert "the knee would carry" in answer.constraint
    assert _asked(0.15).key is not None


def test_the_balance_is_that_of_the_whole_body() -> None:
    """Weight of JVRC-1, its knee's effort, and a waist that leaning holds back."""
    upright, leaning = (
        balance_of(body(), scratch(), replace(QUASI, lean=lean, arms=arms))
        for lean, arms in ((0.0, 0.0), (0.3, 0.8))
    )
    assert isinstance(upright, Balance)
    assert upright.weight == pytest.approx(62.4 * 9.81, abs=1.0)
    assert upright.knee_effort == 100.0
    assert upright.waist_begin == pytest.approx(leaning.waist_begin, abs=1e-9)
    assert leaning.waist_end < upright.waist_end - 0.05


def test_validation() -> None:
    """A field out of range is named."""
    with pytest.raises(ValueError, match="rest: must be shorter"):
        replace(QUASI, rest=2.0).validate()
    with pytest.raises(ValueError, match="single_support"):
        replace(QUASI, single_support=0.0).validate()
