"""FU: yes with a configuration, no with the constraint that fails."""

import re
from dataclasses import replace

import numpy as np
import pytest

from footfall.systems.planning.crossing import feasibility_unit as unit
from footfall.systems.planning.crossing.feasibility_maps import SHARES, feasibility_maps
from footfall.systems.planning.crossing.feasibility_unit import (
    Checked,
    FeasibilityParams,
    check_about,
    check_double_support,
    feasibility_unit,
    step_lengths,
)
from footfall.systems.planning.crossing.leg_clearance import Section
from tests.systems.planning.crossing.crossing_cases import WAIST, body


@pytest.mark.parametrize("height", [0.0, 0.05, 0.15, 0.20, 0.25])
def test_the_key_configuration_meets_its_constraints(height: float) -> None:
    """Checked again at the waist's place and at both ends of its way."""
    params, leg = FeasibilityParams(), body().leg
    key = feasibility_unit(Section(0.05, height), WAIST, leg, params).key
    assert key is not None
    assert key.X_hds == pytest.approx(params.delta_ds * key.X_ads)
    assert params.lowest_waist <= key.Z_hds <= WAIST
    inflated = Section(0.05 + 2.0 * params.s_w, height + params.s_h)
    travel = np.array([-params.waist_travel, 0.0, params.waist_travel])
    ones = np.ones(3)
    checked = check_double_support(
        inflated,
        key.X_ads * ones,
        key.X_hds + travel,
        key.Z_hds * ones,
        (key.front - params.s_w) * ones,
        leg,
    )
    assert (checked.reached == 1.0).all()
    assert (checked.limits <= -params.joint_margin + 1e-9).all()
    assert (checked.gap > 0.0).all()
    # Feet and margins fit exactly: the search begins with the least step.
    assert key.X_ads >= leg.outline.toe + leg.outline.heel + inflated.width - 1e-9


@pytest.mark.parametrize("delta_ds", [0.4, 0.55])
def test_the_waist_is_at_its_share_of_the_step(delta_ds: float) -> None:
    """Eq. 22, X_hds = delta_DS X_ads, from the rear ankle; also off the middle."""
    section, leg = Section(0.05, 0.1), body().leg
    params = replace(FeasibilityParams(), delta_ds=delta_ds, waist_travel=0.0)
    key = feasibility_unit(section, WAIST, leg, params).key
    assert key is not None
    assert key.X_hds == pytest.approx(delta_ds * key.X_ads)


@pytest.mark.parametrize("delta_ds", [0.3, 0.5, 0.7])
def test_the_dynamic_map_has_the_waist_at_its_share(delta_ds: float) -> None:
    """Eq. 22 again: each cell by itself, from bent to stretched legs."""
    section, leg = Section(0.05, 0.1), body().leg
    feet = leg.outline.toe + leg.outline.heel + section.width
    X, Z = np.array([0.40, 0.44]), np.arange(0.56, 0.90, 0.01)

    def stands(x: float, z: float) -> bool:
        """Whether the obstacle may lie somewhere between the feet."""
        found = check_double_support(
            section,
            np.full(len(SHARES), x),
            np.full(len(SHARES), delta_ds * x),
            np.full(len(SHARES), z),
            leg.outline.toe + np.array(SHARES) * (x - feet),
            leg,
        )
        return bool((found.within(0.0) & (found.gap > 0.0)).any())

    wanted = [[stands(x, z) for x in X] for z in Z]
    assert 0 < np.sum(wanted) < np.size(wanted)
    maps = feasibility_maps(section, leg, X, Z, delta_ds)
    np.testing.assert_array_equal(maps.dynamic, wanted)


def test_higher_obstacles_want_longer_steps_or_lower_waists() -> None:
    """Monotone in the height."""
    steps = []
    for height in (0.05, 0.15, 0.20, 0.25):
        answer = feasibility_unit(
            Section(0.05, height), WAIST, body().leg, FeasibilityParams()
        )
        assert answer.key is not None
        steps.append(answer.key.X_ads)
    assert steps == sorted(steps)
    assert steps[-1] > steps[0] + 0.03


def test_it_says_which_constraint_fails() -> None:
    """Too wide, legs too short, and legs that meet the obstacle."""
    leg, params = body().leg, FeasibilityParams()
    wide = feasibility_unit(Section(0.4, 0.1), WAIST, leg, params)
    assert wide.key is None
    assert "0.40 m wide" in wide.constraint
    high = replace(params, lowest_waist=0.88)
    short = feasibility_unit(Section(0.05, 0.1), 0.90, leg, high)
    assert "Eq. 1" in short.constraint
    assert "too short" in short.constraint
    tall = feasibility_unit(Section(0.05, 0.75), WAIST, leg, params)
    assert tall.key is None
    assert "Eq. 5" in tall.constraint


@pytest.mark.parametrize("height", [0.27, 0.35])
def test_a_refusal_says_how_deep(height: float) -> None:
    """More than nothing; with margins smaller by that and half a grid step it goes."""
    leg, params = body().leg, FeasibilityParams()
    answer = feasibility_unit(Section(0.05, height), WAIST, leg, params)
    found = re.search(r"the best is (-?\d+) mm too deep", answer.constraint)
    assert found is not None
    depth = 1e-3 * int(found[1])
    assert depth >= 0.001
    room = depth + 0.5 * params.step_increment
    less = replace(params, s_w=params.s_w - room, s_h=params.s_h - room)
    assert feasibility_unit(Section(0.05, height), WAIST, leg, less).key is not None


def test_feet_that_would_touch_their_margins_have_no_room() -> None:
    """The least step is not long enough; one increment more may be."""
    leg, params = body().leg, FeasibilityParams()
    feet = leg.outline.toe + leg.outline.heel + 2.0 * params.s_w
    width = params.max_step_length - feet
    narrow = Section(width - params.step_increment, 0.0)
    assert feasibility_unit(narrow, WAIST, leg, params).key is not None
    tried = np.concatenate(list(step_lengths(0.40, params)))
    np.testing.assert_allclose(tried, np.arange(0.41, 0.565, 0.01), atol=1e-9)
    refused = feasibility_unit(Section(width - 0.004, 0.0), WAIST, leg, params)
    assert "a step over it is 0.57 m long at least" in refused.constraint


@pytest.mark.parametrize("batch", [1, 100])
def test_step_lengths_in_one_pass_are_as_one_by_one(
    monkeypatch: pytest.MonkeyPatch, batch: int
) -> None:
    """The same answer, be it yes or no."""
    sections = [Section(0.05, h) for h in (0.0, 0.15, 0.21, 0.25, 0.30)]

    def answers() -> list[object]:
        return [
            feasibility_unit(section, WAIST, body().leg, FeasibilityParams())
            for section in sections
        ]

    usual = answers()
    monkeypatch.setattr(unit, "BATCH", batch)
    assert answers() == usual


def test_the_worst_while_the_waist_travels() -> None:
    """Of each place of the waist by itself, where the legs can."""
    leg, section = body().leg, Section(0.05, 0.2)
    grid = np.meshgrid([0.40, 0.48, 0.60], [0.6, 0.7, 0.79], [0.1, 0.2], indexing="ij")
    X, Z, front = (part.ravel() for part in grid)
    found = check_about(section, X, 0.5 * X, Z, front, leg, 0.07, 0.05)
    parts = [
        check_double_support(section, X, 0.5 * X + way, Z, front, leg)
        for way in (-0.07, 0.0, 0.07)
    ]
    np.testing.assert_array_equal(
        found.reached, np.min([part.reached for part in parts], axis=0)
    )
    np.testing.assert_allclose(
        found.limits, np.max([part.limits for part in parts], axis=0), atol=1e-12
    )
    within = found.within(0.05)
    assert 0 < within.sum() < len(X)
    gap = np.min([part.gap for part in parts], axis=0)
    np.testing.assert_allclose(found.gap[within], gap[within], atol=1e-12)
    np.testing.assert_allclose(found.knees[within], parts[1].knees[within], atol=1e-12)
    assert (found.gap[~within] == -np.inf).all()


def test_dynamic_maps_allow_higher_waists_than_quasi_static_ones() -> None:
    """Remarks 1 and 2 of the paper, for this robot."""
    X, Z = np.arange(0.34, 0.60, 0.04), np.arange(0.54, 0.86, 0.04)
    maps = feasibility_maps(Section(0.05, 0.15), body().leg, X, Z)
    assert maps.within.sum() >= max(maps.begin.sum(), maps.end.sum())
    assert not (maps.quasi_static > maps.within).any()
    highest = [
        Z[np.flatnonzero(table.any(axis=1))].max()
        for table in (maps.quasi_static, maps.dynamic)
    ]
    assert highest[1] > highest[0] + 0.03
    long = X >= 0.46
    tops = [
        max(
            (z for z, row in zip(Z, table[:, long], strict=True) if row.any()),
            default=0,
        )
        for table in (maps.quasi_static, maps.dynamic)
    ]
    assert tops[1] > tops[0]


def test_validation() -> None:
    """A field out of range is named."""
    with pytest.raises(ValueError, match="delta_ds: must be less than 1"):
        replace(FeasibilityParams(), delta_ds=1.5).validate()


def _checked(X_ads: float, X_hds: float, Z_hds: float, section: Section) -> Checked:
    """One double support, the obstacle in the middle between the ankles."""
    front = np.array([0.5 * (X_ads - section.width)])
    return check_double_support(
        section,
        np.array([X_ads]),
        np.array([X_hds]),
        np.array([Z_hds]),
        front,
        body().leg,
    )


def test_limits_are_those_of_the_worse_leg() -> None:
    """Whichever is the rear one: mirrored, other joints of the other leg decide."""
    section = Section(0.05, 0.05)
    behind = _checked(0.42, 0.0, 0.62, section).limits[0]
    ahead = _checked(0.42, 0.42, 0.62, section).limits[0]
    middle = _checked(0.42, 0.21, 0.62, section).limits[0]
    hip, knee, ankle = 0, 3, 5
    # The leg under the waist is bent most, whether it is the rear or the front one.
    assert behind[knee] == pytest.approx(ahead[knee], abs=1e-9)
    assert behind[knee] > middle[knee] + 0.1
    # A leg far behind the waist bends its ankle and stretches its hip most.
    assert ahead[ankle] > behind[ankle] + 0.2
    assert ahead[hip] > middle[hip] + 0.2


def test_the_thigh_keeps_off_the_obstacle_too() -> None:
    """A narrow post under the front thigh, 7 cm off both shanks."""
    post = Section(0.03, 0.60)
    gap = check_double_support(
        post,
        np.array([0.56]),
        np.array([0.28]),
        np.array([0.78]),
        np.array([0.36]),
        body().leg,
    ).gap[0]
    assert 0.0 < gap < 0.03


def test_the_knees_are_ahead_of_their_ankles() -> None:
    """Rear and front, where the waist is low."""
    rear, front = _checked(0.42, 0.21, 0.65, Section(0.05, 0.05)).knees[0]
    assert 0.1 < rear < 0.42
    assert front > 0.42
