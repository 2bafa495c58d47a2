"""How long planning takes: footsteps, a step's way, the crossing of an obstacle."""

from typing import Any

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.perceived import PlaneSegment, Staircase
from footfall.systems.planning.crossing.feasibility_unit import feasibility_unit
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import plan_footsteps
from footfall.systems.planning.motion.swing_trajectory import (
    SwingParams,
    swing_trajectory,
)
from tests.systems.planning.crossing.crossing_cases import WAIST, body, planned

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)


def rectangle(p: list[float], depth: float, width: float) -> PlaneSegment:
    """A level plane segment about p whose polygon is its rectangle."""
    half = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    corners = np.array(p) + np.hstack(
        [half * np.array([depth, width]) / 2.0, np.zeros((4, 1))]
    )
    return PlaneSegment(
        corners,
        RigidTransform(p),
        np.array([depth, width]),
        np.array([0.0, 0.0, 1.0]),
        depth * width,
        100,
    )


@pytest.mark.parametrize("distance", [0.3, 1.5, 4.0])
def test_footstep_planning(benchmark: Any, distance: float) -> None:
    """From a start turned by 15 deg and 15 cm off the middle of eleven treads."""
    treads = tuple(
        rectangle([0.265 * (i + 0.5), 0.0, 0.18 * (i + 1)], 0.265, 1.23)
        for i in range(11)
    )
    stairs = Staircase(treads, rectangle([-3.0, 0.0, 0.0], 6.0, 4.0))
    X_WM = RigidTransform(
        RollPitchYaw(0.0, 0.0, 0.26), np.array([-distance - 0.15, 0.15, 0.0])
    )
    left = X_WM @ RigidTransform([0.0, 0.095, 0.0])
    right = X_WM @ RigidTransform([0.0, -0.095, 0.0])
    params = FootstepPlannerParams()
    plan = benchmark(plan_footsteps, stairs, left, right, params, SOLE)
    assert plan.status == "planned"


def test_swing_trajectory(benchmark: Any) -> None:
    """Up a tread of 18 cm in 0.85 s, sampled every 5 ms."""
    X_WStart, X_WEnd = RigidTransform([-0.2, 0, 0]), RigidTransform([0.095, 0, 0.18])
    edges = np.array([[0.0, 0.0, 0.18]])
    swing = benchmark(
        swing_trajectory, X_WStart, X_WEnd, 0.85, 0.005, edges, SOLE, SwingParams()
    )
    assert swing.status == "ok"


@pytest.mark.parametrize("height", [0.15, 0.25, 0.35])
def test_feasibility_unit(benchmark: Any, height: float) -> None:
    """FU over 5 cm: soon found, found late, and refused."""
    margins = CrossingParams().feasibility
    answer = benchmark(
        feasibility_unit, Section(0.05, height), WAIST, body().leg, margins
    )
    assert (answer.key is None) == (height > 0.3)


@pytest.mark.parametrize("height", [0.15, 0.20])
def test_crossing(benchmark: Any, height: float) -> None:
    """FU to FTA for six steps over 5 cm."""
    motion, _ = benchmark(planned, 0.05, height)
    assert motion.report.gap > 0.0
