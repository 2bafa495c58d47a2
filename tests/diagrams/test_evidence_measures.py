"""The figures of a judgement, one by one."""

from dataclasses import replace

import numpy as np
import pytest

from diagrams.evidence import Evidence
from diagrams.evidence_measures import (
    climb_time,
    com_error,
    crossing_figures,
    dcm_error,
    foot_contacts,
    foot_wrenches,
    footsteps,
    joint_torques,
    largest_force,
    largest_slip,
    min_static_margin,
    steps_climbed,
    worst_fraction,
)
from tests.diagrams.climb_evidence import LEFT, frame, motion_of


def test_contacts_footsteps_and_forces(climb: Evidence) -> None:
    """Three footsteps; the foot that stands alone bears the whole weight."""
    wrenches = foot_wrenches(climb)
    contacts = foot_contacts(climb, wrenches)
    assert contacts is not None
    assert contacts["left"] == [(0, 1), (2, 3), (4, 7)]
    assert footsteps(climb, contacts) == 3
    assert largest_force(climb, wrenches) == pytest.approx(1.0)
    assert largest_slip(climb, wrenches) == 0.0
    assert foot_wrenches(replace(climb, frames={})) is None
    assert foot_contacts(climb, None) is None


def test_the_worst_fraction_names_its_joint() -> None:
    """Whatever its sign; None without any samples."""
    values = {"HIP": np.array([1.0, -3.0]), "KNEE": np.array([2.0, 2.0])}
    assert worst_fraction(values, {"HIP": 6.0, "KNEE": 10.0}) == (0.5, "HIP")
    assert worst_fraction({"HIP": np.zeros(0)}, {"HIP": 1.0}) == (None, None)


def test_a_climb_crosses_nothing(climb: Evidence) -> None:
    """Only the clearance of its soles is measured."""
    assert set(crossing_figures(climb, foot_wrenches(climb))) == {"min_clearance_m"}


def test_a_step_is_climbed_by_both_feet(climb: Evidence) -> None:
    """One foot on the second tread and one on the floor have climbed none."""
    motion = motion_of(LEFT, ["floor"] * 7)
    evidence = replace(climb, motion=motion)
    contacts = foot_contacts(evidence, foot_wrenches(evidence))
    assert steps_climbed(evidence, contacts) == 0


def test_climb_time_counts_motion_only(climb: Evidence) -> None:
    """From 1 s to the last touch-down at 5 s, without half a second of scanning."""
    contacts = foot_contacts(climb, foot_wrenches(climb))
    assert climb_time(climb, contacts) == pytest.approx(1.0 + 2.5)


def test_errors_of_com_and_dcm(climb: Evidence) -> None:
    """Against the reference, the true CoM in space, the measured DCM in the plane."""
    com = climb.motion.com
    frames = {
        **climb.frames,
        "reference.com": frame(com + np.array([0.0, 0.03, 0.04])),
        "balance_state.dcm": frame(com + np.array([0.3, 0.4, 9.0])),
        "reference.dcm": frame(com),
    }
    evidence = replace(climb, frames=frames)
    assert com_error(evidence) == pytest.approx(0.05)
    assert dcm_error(evidence) == pytest.approx(0.5)
    assert com_error(climb) is None
    assert dcm_error(climb) is None


def test_static_margin_is_the_least_where_there_is_a_polygon(climb: Evidence) -> None:
    """A moment without any polygon has no margin."""
    margins = np.full((len(climb.motion.time), 1), 0.05)
    margins[0], margins[1] = -np.inf, -0.01
    frames = {**climb.frames, "static_stability.margin": frame(margins)}
    assert min_static_margin(replace(climb, frames=frames)) == pytest.approx(-0.01)
    assert min_static_margin(climb) is None


def test_torques_of_another_number_of_joints_are_refused(climb: Evidence) -> None:
    """A column too many would be given another joint's name."""
    frames = {**climb.frames, "plant.net_actuation": frame(np.zeros((7, 3)))}
    with pytest.raises(ValueError, match="has 3 columns, expected one for each of 2"):
        joint_torques(replace(climb, frames=frames))
