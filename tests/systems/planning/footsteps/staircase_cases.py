"""Made-up estimates of staircases, robots before them and what a plan must keep."""

from math import degrees

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import other_foot
from footfall.models.values.geometry import heading
from footfall.models.values.perceived import PlaneSegment, Staircase
from footfall.models.values.planned import FootstepPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import sole_corners
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

PARAMS = FootstepPlannerParams(foothold_bias=0.0)
SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)


def rectangle(X_WR: RigidTransform, depth: float, width: float) -> PlaneSegment:
    """A plane segment whose polygon is its rectangle."""
    size = np.array([depth, width])
    half = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * size / 2.0
    corners = np.array([X_WR.multiply(np.array([*p, 0.0])) for p in half])
    normal: Vector = X_WR.rotation().matrix()[:, 2]
    return PlaneSegment(corners, X_WR, size, normal, depth * width, 100)


def staircase(
    runs: list[float],
    rises: list[float],
    width: float = 0.8,
    yaw: float = 0.0,
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    noise: float = 0.0,
    turn_noise: float = 0.0,
    rng: np.random.Generator | None = None,
) -> Staircase:
    """Treads from an origin on the floor at the middle of the first riser.

    `noise` shrinks the rectangles (m) and shifts their heights, `turn_noise` turns
    them (rad); both are uniform.
    """
    rng = np.random.default_rng(0) if rng is None else rng
    X_WS = RigidTransform(RollPitchYaw(0.0, 0.0, yaw), np.array(origin))
    treads, x, z = [], 0.0, 0.0
    for run, rise in zip(runs, rises, strict=True):
        z += rise
        cut = rng.uniform(0.0, noise, 4)
        middle = np.array(
            [
                x + (run + cut[0] - cut[1]) / 2.0,
                (cut[2] - cut[3]) / 2.0,
                z + rng.uniform(-0.3, 0.3) * noise,
            ]
        )
        turn = RollPitchYaw(0.0, 0.0, rng.uniform(-turn_noise, turn_noise))
        treads.append(
            rectangle(
                X_WS @ RigidTransform(turn, middle),
                run - cut[0] - cut[1],
                width - cut[2] - cut[3],
            )
        )
        x += run
    floor = rectangle(X_WS @ RigidTransform([-1.1, 0.0, 0.0]), 2.0, 3.0)
    return Staircase(tuple(treads), floor)


def feet_at(
    stairs_yaw: float,
    origin: tuple[float, float, float],
    x: float,
    y: float,
    yaw: float,
    z: float = 0.0,
    stance_width: float = 0.19,
) -> tuple[RigidTransform, RigidTransform]:
    """Left and right sole side by side about (x, y, z) in the staircase's frame."""
    X_WS = RigidTransform(RollPitchYaw(0.0, 0.0, stairs_yaw), np.array(origin))
    X_WM = X_WS @ RigidTransform(RollPitchYaw(0.0, 0.0, yaw), np.array([x, y, z]))
    half = stance_width / 2.0
    return (
        X_WM @ RigidTransform([0.0, half, 0.0]),
        X_WM @ RigidTransform([0.0, -half, 0.0]),
    )


def check_steps(
    plan: FootstepPlan,
    stairs: Staircase,
    feet: tuple[RigidTransform, RigidTransform],
    params: FootstepPlannerParams = PARAMS,
) -> None:
    """Every step within its limits, every sole on its tread, feet side by side."""
    assert plan.status == "planned", plan.reason
    now = dict(zip(("left", "right"), feet, strict=True))
    for before, after in zip(plan.footsteps, plan.footsteps[1:], strict=False):
        assert after.foot == other_foot(before.foot)
    for step in plan.footsteps:
        stance = now[other_foot(step.foot)]
        X_SF = stance.inverse() @ step.X_WF
        x, y, _ = X_SF.translation()
        turn = RollPitchYaw(X_SF.rotation()).yaw_angle()
        side = 1.0 if step.foot == "left" else -1.0
        reach = params.max_step_length if step.plane < 0 else params.max_climb_length
        assert -params.max_back_step - 1e-6 <= x <= reach + 1e-6
        assert side * y <= params.max_stance_width + 1e-6
        assert abs(turn) <= params.max_turn + 1e-6
        inner = side * (stance.inverse().multiply(sole_corners(step.X_WF, SOLE).T))[1]
        assert inner.min() >= SOLE.half_width + params.sole_gap - 1e-6
        p_W = sole_corners(step.X_WF, SOLE)
        if step.plane < 0:
            X_R1W = stairs.treads[0].X_WR.inverse()
            ahead = X_R1W.multiply(p_W.T)[0] + stairs.treads[0].size[0] / 2.0
            assert ahead.max() < 0.0
        else:
            tread = stairs.treads[step.plane]
            p_R = np.array(tread.X_WR.inverse().multiply(p_W.T))
            room = tread.size[:, None] / 2.0 - np.abs(p_R[:2])
            assert room[0].min() >= -params.max_heel_overhang - 1e-6
            toes = tread.size[0] / 2.0 - p_R[0].max()
            assert toes >= params.edge_margin - 1e-6
            assert room[1].min() >= params.side_margin - 1e-6
            np.testing.assert_allclose(p_R[2], 0.0, atol=1e-6)
        now[step.foot] = step.X_WF
    apart = now["right"].inverse() @ now["left"]
    p = apart.translation()
    assert abs(p[0]) < 0.012
    np.testing.assert_allclose(p[1:], [params.stance_width, 0.0], atol=1e-6)
    assert abs(degrees(heading(now["left"]) - heading(now["right"]))) < 1e-6
