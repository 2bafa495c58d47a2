"""Closed-form legs against the plant's own kinematics."""

import numpy as np
import pytest
import shapely  # type: ignore[import-untyped]
from pydrake.math import RollPitchYaw

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import body_meshes
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector
from footfall.systems.planning.whole_body.leg_model import (
    both_leg_angles,
    leg_angles,
    outline_points,
    rotations,
)
from tests.systems.planning.crossing.crossing_cases import body, scratch


@pytest.mark.parametrize("foot", FEET)
def test_angles_are_those_that_made_the_pose(foot: Foot) -> None:
    """Random postures: forward by the plant, back by the closed form."""
    plant, leg, context = body().plant, body().leg, scratch()
    rng = np.random.default_rng(3)
    low = np.array([-1.5, -0.2, -0.3, 0.25, -0.3, -1.2])
    high = np.array([0.4, 0.3, 0.3, 2.2, 0.3, 0.5])
    for _ in range(50):
        wanted = rng.uniform(low, high)
        rpy = rng.uniform(-0.3, 0.3, 3)
        q: Vector = np.zeros(plant.num_positions())
        q[:4] = RollPitchYaw(rpy).ToQuaternion().wxyz()
        q[4:7] = rng.uniform(-1.0, 1.0, 3)
        for name, angle in zip(JVRC1.leg_joints[foot], wanted, strict=True):
            q[plant.GetJointByName(name).position_start()] = angle
        plant.SetPositions(context, q)
        ankle = plant.GetBodyByName(JVRC1.foot_bodies[foot]).EvalPoseInWorld(context)
        p_AF: Vector = np.array([0.0, 0.0, -JVRC1.sole.ankle_height])
        sole = np.concatenate(
            [ankle.multiply(p_AF), RollPitchYaw(ankle.rotation()).vector()]
        )
        found = leg_angles(leg, foot, q[None, 4:7], rotations(rpy[None]), sole[None])
        np.testing.assert_allclose(found.angles[0], wanted, atol=1e-9)
        assert found.short[0] == 0.0
        knee = plant.GetJointByName(JVRC1.leg_joints[foot][3]).child_body()
        _, p_WK = outline_points(leg, foot, found.angles, sole[None])
        np.testing.assert_allclose(
            p_WK[0], knee.EvalPoseInWorld(context).translation(), atol=1e-9
        )


def test_both_legs_are_one_and_one() -> None:
    """In one pass as each by itself, one of them out of reach."""
    leg, n = body().leg, 12
    rng = np.random.default_rng(4)
    waist = np.array([0.0, 0.0, 0.65]) + rng.uniform(-0.03, 0.03, (n, 3))
    R_WP = rotations(rng.uniform(-0.2, 0.2, (n, 3)))
    soles = rng.uniform(-0.1, 0.1, (n, 2, 6))
    soles[:, :, 1] += [0.095, -0.095]
    soles[5, 1, 2] -= 0.3
    both = both_leg_angles(leg, waist, R_WP, soles)
    for i, foot in enumerate(FEET):
        one = leg_angles(leg, foot, waist, R_WP, soles[:, i])
        np.testing.assert_allclose(both.angles[:, i], one.angles, atol=1e-12)
        np.testing.assert_allclose(both.short[:, i], one.short, atol=1e-12)
    assert both.short[5, 1] > 0.1
    assert np.count_nonzero(both.short) == 1


def test_out_of_reach_is_told_by_how_much() -> None:
    """The leg hangs straight down and the ground is 5 cm too low."""
    leg = body().leg
    waist: Vector = np.array([[0.0, -leg.hips["left"][1], 0.0]])
    waist[0, 2] = leg.reach + leg.sole.ankle_height + 0.05
    found = leg_angles(leg, "left", waist, np.eye(3)[None], np.zeros((1, 6)))
    assert found.short[0] == pytest.approx(0.05)
    assert found.angles[0, 3] == pytest.approx(leg.lower[0, 3])


def test_outline_holds_the_sole_and_comes_from_the_mesh() -> None:
    """The foot's mesh reaches beyond the flat sole at both ends."""
    outline = body().leg.outline
    assert JVRC1.sole.toe < outline.toe < JVRC1.sole.toe + 0.02
    assert JVRC1.sole.heel < outline.heel < JVRC1.sole.heel + 0.03
    assert outline.shank[1, 0] > 0.08
    assert outline.shank[3, 0] < 0.0


def test_the_outline_holds_the_front_of_the_shank() -> None:
    """Shin and knee cap stick out of it by a few millimetres at most."""
    surfaces = {mesh.body: mesh.vertices for mesh in body_meshes(JVRC1)}
    knee = body().plant.GetJointByName(JVRC1.leg_joints["left"][3]).child_body().name()
    hull = shapely.MultiPoint(body().leg.outline.shank).convex_hull
    front = surfaces[knee][surfaces[knee][:, 0] > 0.05]
    outside = shapely.distance(hull, shapely.points(front[:, [0, 2]]))
    assert outside.max() < 0.015
