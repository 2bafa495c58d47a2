"""The figures of a judgement, one by one."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.evidence_measures import (
    climb_time,
    com_error,
    crossing_figures,
    dcm_error,
    foot_contacts,
    footsteps,
    max_friction_ratio,
    max_impact,
    max_slip,
    min_static_margin,
    steps_climbed,
)
from footfall.diagrams.judge.evidence_signals import foot_loads, foot_wrenches
from tests.diagrams.judge.climb_evidence import (
    LEFT,
    LOADS,
    SAMPLES,
    WEIGHT,
    frame,
    motion_of,
    wrenches,
)


def test_contacts_footsteps_and_forces(climb: Evidence) -> None:
    """Three footsteps; impact and friction as they were watched, at their largest."""
    felt = foot_wrenches(climb)
    contacts = foot_contacts(climb, felt)
    assert contacts is not None
    assert contacts["left"] == [(0, 100), (200, 300), (400, SAMPLES)]
    assert footsteps(climb, contacts) == 3
    impact = np.full((SAMPLES, 2), WEIGHT)
    impact[300:, 1] = 1.5 * WEIGHT
    frames = {**climb.frames, "contact_monitor.impact": frame(impact)}
    assert max_impact(replace(climb, frames=frames)) == pytest.approx(1.5)
    assert max_friction_ratio(climb) == pytest.approx(0.25)
    assert max_slip(climb, felt) == 0.0
    assert foot_wrenches(replace(climb, frames={})) is None
    assert foot_contacts(climb, None) is None


def test_a_climb_crosses_nothing(climb: Evidence) -> None:
    """Only the clearance of its soles is measured."""
    assert set(crossing_figures(climb, foot_wrenches(climb))) == {"min_clearance_m"}


def test_a_step_is_climbed_by_both_feet(climb: Evidence) -> None:
    """One foot on the second tread and one on the floor have climbed none."""
    motion = motion_of(LEFT, ["floor"] * 7)
    evidence = replace(climb, motion=motion)
    assert steps_climbed(evidence, foot_loads(evidence)) == 0
    assert steps_climbed(climb, foot_loads(climb)) == 2
    assert steps_climbed(climb, None) is None


def test_a_step_is_climbed_in_the_task_of_climbing_alone(climb: Evidence) -> None:
    """Stairs that stand about are not climbed."""
    evidence = replace(climb, kind="room_crossing")
    assert steps_climbed(evidence, foot_loads(evidence)) is None


def test_one_touch_of_a_tread_is_no_rest_on_it(climb: Evidence) -> None:
    """The right foot is loaded on the top for 0.1 s, then the robot sinks."""
    for touched, climbed in ((0.1, 0), (0.25, 2)):
        felt = wrenches(*LOADS).to_numpy(copy=True)
        felt[500:, 9] = 0.0
        felt[510 : 510 + round(100 * touched) + 1, 9] = 0.5 * WEIGHT
        frames = {**climb.frames, "station.foot_wrenches": frame(felt[:, 1:])}
        evidence = replace(climb, frames=frames)
        assert steps_climbed(evidence, foot_loads(evidence)) == climbed


def test_treads_that_are_lain_on_are_not_climbed(climb: Evidence) -> None:
    """What the soles touch after a fall does not count."""
    base = climb.motion.base.copy()
    base[450:, 2] = 0.5
    evidence = replace(climb, motion=replace(climb.motion, base=base))
    assert steps_climbed(evidence, foot_loads(evidence)) == 0


def test_a_sole_that_is_not_flat_does_not_rest(climb: Evidence) -> None:
    """6 mm above the tread it may be loaded as it likes."""
    corners = {foot: part.copy() for foot, part in climb.motion.sole_corners.items()}
    corners["right"][:, :, 2] += 0.006
    evidence = replace(climb, motion=replace(climb.motion, sole_corners=corners))
    assert steps_climbed(evidence, foot_loads(evidence)) == 0


def test_climb_time_counts_motion_only(climb: Evidence) -> None:
    """From 1 s to the last touch-down at 5 s, without half a second of scanning."""
    contacts = foot_contacts(climb, foot_wrenches(climb))
    assert climb_time(climb, contacts) == pytest.approx(1.0 + 2.5)


def test_errors_of_com_and_dcm(climb: Evidence) -> None:
    """Against the reference; the DCM is the true one, v / omega ahead of the CoM."""
    reference = np.zeros((SAMPLES, 9))
    reference[:, :3] = climb.motion.com + np.array([0.0, 0.03, 0.04])
    reference[300, 3] = 0.1
    frames = {
        **climb.frames,
        "reference.com": frame(reference),
        "balance_state.dcm": frame(np.full((SAMPLES, 2), 9.0)),
    }
    evidence = replace(climb, frames=frames)
    assert com_error(evidence) == pytest.approx(0.05)
    height = climb.motion.com[300, 2] - 0.1
    ahead = 0.1 * np.sqrt(height / 9.81)
    assert dcm_error(evidence) == pytest.approx(np.hypot(ahead, 0.03), rel=1e-6)
    assert com_error(climb) is None
    assert dcm_error(climb) is None


def test_static_margin_is_that_of_the_true_contacts(climb: Evidence) -> None:
    """What the controller believes of its contacts is not asked."""
    believed = {**climb.frames, "static_stability.margin": frame(np.full(SAMPLES, 9.0))}
    evidence = replace(climb, frames=believed)
    # The CoM is over the middle of feet of which one hangs in the air, 10 cm aside.
    alone = -(0.1 - 0.042)
    least = min_static_margin(evidence, foot_loads(evidence))
    assert least is not None
    assert least < alone + 1e-6
    stands = replace(
        evidence,
        motion=motion_of(["floor"] * 7, ["floor"] * 7),
        frames={"station.foot_wrenches": wrenches([0.5] * 7, [0.5] * 7)},
    )
    assert min_static_margin(stands, foot_loads(stands)) == pytest.approx(0.075)
    assert min_static_margin(climb, None) is None
