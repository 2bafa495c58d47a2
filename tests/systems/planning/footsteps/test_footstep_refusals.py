"""Staircases, places and stances from which no footstep is planned, and why."""

import dataclasses
from math import radians

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.values.perceived import Staircase
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import plan_footsteps
from tests.systems.planning.footsteps.staircase_cases import (
    PARAMS,
    SOLE,
    feet_at,
    rectangle,
    staircase,
)


def refused(
    stairs: Staircase,
    x: float = -0.2,
    y: float = 0.0,
    yaw: float = 0.0,
    z: float = 0.0,
    params: FootstepPlannerParams = PARAMS,
) -> str:
    """The reason for refusing a robot at this place."""
    feet = feet_at(0.0, (0, 0, 0), x, y, yaw, z)
    plan = plan_footsteps(stairs, *feet, params, SOLE)
    assert plan.status == "infeasible"
    assert plan.footsteps == ()
    assert "\n" not in plan.reason
    return plan.reason


def tilted(stairs: Staircase, slope: float) -> Staircase:
    """The same with its first tread sloping down to the side, deg."""
    first = stairs.treads[0]
    X_WR = first.X_WR @ RigidTransform(
        RollPitchYaw(radians(slope), 0.0, 0.0), np.zeros(3)
    )
    first = rectangle(X_WR, *first.size)
    return dataclasses.replace(stairs, treads=(first, *stairs.treads[1:]))


@pytest.mark.parametrize(
    ("stairs", "pose", "reason"),
    [
        (Staircase(), {}, "no staircase seen"),
        (
            staircase([0.28], [0.40]),
            {},
            "tread 1 rises 0.40 m above the floor, more than the 0.25 m the robot can "
            "climb",
        ),
        (
            staircase([0.28] * 2, [0.2, 0.4]),
            {},
            "tread 2 rises 0.40 m above tread 1, more than the 0.25 m the robot can "
            "climb",
        ),
        (
            staircase([0.28] * 2, [0.2, -0.1]),
            {},
            "tread 2 lies 0.10 m below tread 1",
        ),
        (
            staircase([0.28], [0.2], width=0.3),
            {},
            "tread 1 is 0.300 m wide, less than the 0.334 m that both feet need",
        ),
        (
            staircase([0.23], [0.2]),
            {},
            "tread 1 is 0.230 m deep, too shallow for the 0.225 m sole: its heel would "
            "stand out by 0.010 m, more than 0.000 m",
        ),
        (
            staircase([0.44], [0.2]),
            {},
            "tread 1 needs a step of 0.38 m from the stance foot, more than 0.36 m",
        ),
        (
            tilted(staircase([0.28], [0.2]), 12.0),
            {},
            "tread 1 slopes by 12.0 deg, more than 10.0 deg",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": 0.1, "z": 0.3},
            "the feet are 0.100 m off the height of tread 1 where they stand",
        ),
        (
            staircase([0.28], [0.2]),
            {"z": -0.1},
            "the feet are 0.100 m below the floor that was seen",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": -1.0, "z": 0.1},
            "tread 1 needs a step of 1.10 m from the stance foot, more than 0.36 m; "
            "the feet stand on nothing that was seen",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": -1.0, "z": 0.5},
            "the feet stand 0.30 m above the highest tread, on nothing that was seen",
        ),
        (
            dataclasses.replace(staircase([0.28], [0.2]), floor=None),
            {"x": -1.0},
            "tread 1 needs a step of 1.10 m from the stance foot, more than 0.36 m; "
            "the feet stand on nothing that was seen",
        ),
        (
            staircase([0.28] * 3, [0.2] * 3),
            {"x": 0.3, "y": 0.8},
            "the way to the stand line leads through tread 1",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": -9.0},
            "the stand line, 8.80 m away, cannot be reached within 24 steps",
        ),
        (
            dataclasses.replace(
                staircase([0.28], [0.2]),
                floor=rectangle(RigidTransform([-1.5, 0.0, 0.0]), 1.0, 3.0),
            ),
            {"x": -1.0},
            "the stand line lies 0.95 m from the floor that was seen, more than 0.30 m",
        ),
    ],
)
def test_a_refusal_says_why(
    stairs: Staircase, pose: dict[str, float], reason: str
) -> None:
    """One line, with the numbers."""
    assert refused(stairs, **pose) == reason


def test_a_sloping_floor_is_refused() -> None:
    """The approach is for a flat floor."""
    stairs = staircase([0.28], [0.2])
    X_WR = RigidTransform(RollPitchYaw(0.0, radians(4.0), 0.0), np.array([-0.6, 0, 0]))
    stairs = dataclasses.replace(stairs, floor=rectangle(X_WR, 2.0, 3.0))
    reason = refused(stairs, x=-0.6)
    assert (
        reason == "the floor before the staircase slopes by 4.0 deg, more than 3.0 deg"
    )


def test_a_spiral_is_refused() -> None:
    """Two treads turned by 30 deg are each 15 deg off their mean."""
    first = rectangle(RigidTransform([0.15, 0.0, 0.2]), 0.3, 0.8)
    X_WR = RigidTransform(
        RollPitchYaw(0.0, 0.0, radians(30.0)), np.array([0.4, 0, 0.4])
    )
    stairs = Staircase((first, rectangle(X_WR, 0.3, 0.8)), None)
    stairs = dataclasses.replace(staircase([0.3], [0.2]), treads=stairs.treads)
    assert refused(stairs) == (
        "tread 1 is turned by 15.0 deg from the staircase, more than 10.0 deg"
    )


@pytest.mark.parametrize(
    ("right", "reason"),
    [
        (
            RigidTransform([-0.2, -0.095, 0.1]),
            "the right foot stands 0.100 m above the left one, more than 0.030 m",
        ),
        (
            RigidTransform(RollPitchYaw(0.3, 0.0, 0.0), [-0.2, -0.095, 0.0]),
            "the right sole is tilted by 17.2 deg, more than 10.0 deg",
        ),
        (
            RigidTransform([-0.2, 0.045, 0.0]),
            "the left foot is 0.050 m to the left of the right one, less than the "
            "0.084 m that the soles take",
        ),
    ],
)
def test_feet_that_do_not_stand_are_refused(right: RigidTransform, reason: str) -> None:
    """Only feet side by side on one level can start a plan."""
    left = RigidTransform([-0.2, 0.095, 0.0])
    plan = plan_footsteps(staircase([0.28], [0.2]), left, right, PARAMS, SOLE)
    assert (plan.status, plan.reason) == ("infeasible", reason)
