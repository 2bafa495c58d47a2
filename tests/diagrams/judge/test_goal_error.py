"""How far from a goal the robot stands, and how far it faces past it."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.evidence_measures import goal_error
from tests.diagrams.judge.climb_evidence import motion_of


@pytest.mark.parametrize("heading", [-2.5, -0.4, 0.7, 3.0])
@pytest.mark.parametrize("past", [-0.2, 0.3])
def test_the_turn_is_from_the_goals_heading(
    climb: Evidence, heading: float, past: float
) -> None:
    """Whatever that is, and across the turn of pi; the feet's middle is elsewhere."""
    motion = motion_of(["floor"] * 7, ["floor"] * 7)
    c, s = np.cos(heading + past), np.sin(heading + past)
    R = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    poses = {}
    for foot, X_WF in motion.X_WF.items():
        poses[foot] = X_WF.copy()
        poses[foot][:, :3, :3] = R
        poses[foot][:, :3, 3] = [1.0, 2.0, 0.0] + R @ X_WF[0, :3, 3]
    evidence = replace(
        climb, motion=replace(motion, X_WF=poses), goal=(1.3, 2.4, heading)
    )
    assert goal_error(evidence) == pytest.approx((0.5, abs(past)))
