"""Predicted torques against statics, gaps against geometry."""

import numpy as np
import pytest

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.planned import MotionPlan
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_prediction import SELF_RANGE, edge_gaps
from footfall.systems.planning.motion.motion_task import MotionTask, Walker

AHEAD = np.array([1.0, 0.0])
BOX = np.array([[x, 0.0, z] for x in (-0.1, 0.1) for z in (-0.1, 0.1)])


def standing(com_x: float = 0.035) -> MotionPlan:
    """A plan that stands."""
    feet = np.zeros((2, 6))
    feet[:, 1] = (0.095, -0.095)
    com = np.array([com_x, 0.0, 0.85])
    walker = Walker(MotionPlannerParams(), ZmpPreviewParams(), JVRC1)
    return plan_motion(MotionTask(feet, com), walker)


@pytest.mark.parametrize(
    ("edge", "gap"),
    [
        ((0.3, 0.0), 0.2),
        ((0.0, -0.3), 0.2),
        ((0.13, -0.14), 0.05),
        ((0.05, 0.3), -0.05),
        ((-0.5, 0.02), -0.12),
    ],
)
def test_gap_to_a_step(edge: tuple[float, float], gap: float) -> None:
    """Before it, above it, across its edge, and within it."""
    edges = np.array([[edge[0], 7.0, edge[1]]])
    (found,) = edge_gaps(BOX, [0], edges, AHEAD)
    assert found == pytest.approx(gap, abs=1e-3)


def test_gap_counts_the_worst_step_along_the_stairs() -> None:
    """With the stairs turned by 90 deg."""
    turned = BOX[:, [1, 0, 2]]
    edges = np.array([[0.0, 0.3, 0.0], [0.0, 0.12, 0.5]])
    (gap,) = edge_gaps(turned, [0], edges, np.array([0.0, 1.0]))
    assert gap == pytest.approx(0.02, abs=1e-4)


def test_gaps_are_told_body_by_body() -> None:
    """Of three boxes the second is over the step, the third runs into it."""
    places = np.array([[0.0, 0.0, 0.0], [0.5, 0.0, 0.25], [0.25, 0.0, -0.4]])
    bodies = [BOX + place for place in places]
    edges = np.array([[0.2, 0.0, 0.1]])
    gaps = edge_gaps(np.vstack(bodies), [0, 4, 8], edges, AHEAD)
    np.testing.assert_allclose(gaps, [0.1, 0.05, -0.15], atol=1e-3)


def test_standing_is_within_reach_and_symmetric(jvrc1) -> None:
    """Both legs carry the same; nothing is missed."""
    found = jvrc1.predictor.predict(standing(), np.zeros((0, 3)), 0.0)
    torque = dict(zip(found.joints, found.torques[-1], strict=True))
    for joint in ("KNEE", "HIP_P", "ANKLE_P"):
        assert torque[f"L_{joint}"] == pytest.approx(torque[f"R_{joint}"], abs=0.5)
    assert found.foot_error.max() < 1e-3
    assert found.com_error.max() < 1e-3
    assert found.posture_error.max() < 0.05
    assert np.isinf(found.gaps).all()
    assert found.worst_torque()[0] < 0.5


def test_ankles_carry_the_weight_at_its_lever(jvrc1) -> None:
    """At rest the ankles together hold weight times the CoM's way ahead of them."""
    weight = 9.81 * jvrc1.plant.CalcTotalMass(jvrc1.plant.CreateDefaultContext())
    sums = []
    for x in (0.02, 0.07):
        found = jvrc1.predictor.predict(standing(x), np.zeros((0, 3)), 0.0)
        torque = dict(zip(found.joints, found.torques[0], strict=True))
        sums.append(torque["L_ANKLE_P"] + torque["R_ANKLE_P"])
    assert sums[1] - sums[0] == pytest.approx(weight * 0.05, rel=0.05)


def test_prediction_may_begin_later(jvrc1) -> None:
    """Times count from the plan's start."""
    found = jvrc1.predictor.predict(standing(), np.zeros((0, 3)), 0.0, 0.02, 0.4)
    assert found.time[0] == pytest.approx(0.4)
    assert len(found.time) == 21


def test_a_climb_is_held_against_the_robot_itself(jvrc1, step_24cm) -> None:
    """Its thigh comes near the pelvis, and meets it where the foot swings straight."""

    def nearest(**shape: float) -> tuple[float, tuple[str, str]]:
        params, preview = (
            MotionPlannerParams(**shape),
            ZmpPreviewParams(com_height=0.85),
        )
        plan = plan_motion(step_24cm, Walker(params, preview, JVRC1))
        found = jvrc1.predictor.predict(plan, step_24cm.edges, 0.0)
        worst, when = found.worst_self_distance()
        assert worst == found.self_distances[int(np.searchsorted(found.time, when))]
        return worst.distance, worst.bodies

    kept, bodies = nearest()
    assert 0.003 < kept < SELF_RANGE
    assert bodies == ("PELVIS_S", "R_HIP_Y_S")
    met, bodies = nearest(climb_inward=0.0, climb_roll=0.0)
    assert met < -0.005
    assert bodies == ("PELVIS_S", "R_HIP_Y_S")
