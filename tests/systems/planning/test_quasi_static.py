"""Segments of quasi-static climbing and the motion that carries them out."""

import dataclasses
from itertools import pairwise

import numpy as np
import pytest

from models.jvrc1 import JVRC1
from systems.balance.convex_polygon import signed_margin
from systems.balance.sole_contacts import carrying_contact
from systems.balance.stability_polygon import static_polygon
from systems.balance.zmp_preview import ZmpPreviewParams
from systems.planning.motion_choice import MotionTask
from systems.planning.motion_params import MotionPlannerParams
from systems.planning.quasi_static import Climb, plan_segments, unstable_segment
from systems.planning.quasi_static_motion import play_segments
from systems.planning.quasi_static_params import QuasiStaticParams
from systems.values import MotionPlan

PARAMS = MotionPlannerParams()
CLIMB = Climb(lean=0.6, toe_off=0.8, lifted_height=0.7, forward=0.12)


def segments_of(task: MotionTask, params: MotionPlannerParams = PARAMS) -> tuple:
    """The segments of one step."""
    return plan_segments(task.feet, task.com, task.footsteps, CLIMB, params, JVRC1)


def played(task: MotionTask) -> MotionPlan:
    """The motion of one step."""
    return play_segments(
        segments_of(task), task.footsteps, task.edges, PARAMS, ZmpPreviewParams(), JVRC1
    )


def test_a_step_is_the_paper_s_five_segments(step_24cm: MotionTask) -> None:
    """The third in two parts, as the rear heel rises in the second."""
    segments = segments_of(step_24cm)
    assert [(segment.stance, segment.swing) for segment in segments] == [
        (("left", "right"), None),
        (("left",), "right"),
        (("left", "right"), None),
        (("left", "right"), None),
        (("right",), "left"),
        (("left", "right"), None),
    ]
    np.testing.assert_allclose(segments[0].com[1][:2], [0.035, 0.087])
    np.testing.assert_allclose(segments[3].com[1], [0.327 + 0.12, -0.087, 0.24 + 0.7])
    np.testing.assert_allclose(segments[4].com[1][2], 0.24 + 0.85)
    np.testing.assert_allclose(segments[5].com[1], [0.327 + 0.035, 0.0, 0.24 + 0.85])
    np.testing.assert_allclose(segments[3].lengths, [0.01, JVRC1.sole.length])
    for before, after in pairwise(segments):
        np.testing.assert_array_equal(before.com[1], after.com[0])
        np.testing.assert_array_equal(before.end, after.start)
        assert before.lean[1] == after.lean[0]


def test_com_stays_inside_the_polygon_all_along(step_24cm: MotionTask) -> None:
    """Of the contacts that the plan itself names, row by row."""
    plan = played(step_24cm)
    for row in range(0, len(plan.com), 20):
        contacts = [
            carrying_contact(
                plan.foot_poses[row, i], plan.contact_lengths[row, i], JVRC1.sole, 0.6
            )
            for i in range(2)
            if plan.contacts[row, i] > 0.5
        ]
        polygon = static_polygon(contacts).vertices
        assert signed_margin(polygon, plan.com[row, :2]) > 0.019


def test_lines_are_straight_and_slow(step_24cm: MotionTask) -> None:
    """Between rests, and the ZMP of the cart stays near the CoM."""
    plan = played(step_24cm)
    for segment, phase in zip(segments_of(step_24cm), plan.phases, strict=True):
        rows = slice(round(phase.start / 0.005), round(phase.end / 0.005) + 1)
        start, end = segment.com
        way = end - start
        off = plan.com[rows] - start
        share = off @ way / max(way @ way, 1e-12)
        np.testing.assert_allclose(off, share[:, None] * way, atol=1e-9)
        np.testing.assert_allclose(plan.com_velocity[rows][[0, -1]], 0.0, atol=1e-3)
    assert np.abs(plan.cart_zmp - plan.com[:, :2]).max() < 0.03
    np.testing.assert_array_equal(plan.zmp[:, :2], plan.com[:, :2])
    np.testing.assert_array_equal(plan.foot_poses[-1, :, 2], 0.24)


def test_a_line_that_ends_too_near_to_an_edge_is_told(step_24cm: MotionTask) -> None:
    """By segment and margin."""
    assert unstable_segment(segments_of(step_24cm), PARAMS, JVRC1) == ""
    far = dataclasses.replace(PARAMS, quasi_static=QuasiStaticParams(forward=0.14))
    reason = unstable_segment(segments_of(step_24cm, far), far, JVRC1)
    assert reason == (
        "segment 1 (CoM over the left foot): its CoM line ends 0.010 m inside the "
        "static-stability polygon, less than 0.020 m"
    )


def test_a_stance_that_cannot_hold_is_told(step_24cm: MotionTask) -> None:
    """Soles rolled by 40 deg on the ground of friction 0.6 carry nothing."""
    segments = segments_of(step_24cm)
    tilted = segments[0].start.copy()
    tilted[:, 3] = np.deg2rad(40.0)
    broken = (dataclasses.replace(segments[1], start=tilted),)
    reason = unstable_segment(broken, PARAMS, JVRC1)
    assert reason == (
        "segment 1 (right foot to its place): its contacts cannot hold the robot, the "
        "polygon is empty"
    )


@pytest.mark.parametrize(
    ("field", "value"),
    [("com_speed", 0.0), ("foot_speed", -1.0), ("margin", -0.1), ("friction", 0.0)],
)
def test_parameters_out_of_range_are_refused(field: str, value: float) -> None:
    """By name."""
    with pytest.raises(ValueError, match=f"{field}: must"):
        QuasiStaticParams(**{field: value}).validate()
