"""Segments of quasi-static climbing and the motion that carries them out."""

import dataclasses
from itertools import pairwise

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.planned import Footstep, MotionPlan
from footfall.systems.balance.convex_polygon import signed_margin
from footfall.systems.balance.sole_contacts import carrying_contact
from footfall.systems.balance.stability_polygon import static_polygon
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.motion.quasi_static import (
    Climb,
    plan_segments,
    unstable_segment,
)
from footfall.systems.planning.motion.quasi_static_motion import play_segments
from footfall.systems.planning.motion.quasi_static_params import QuasiStaticParams

PARAMS = MotionPlannerParams()
CLIMB = Climb(lean=0.6, toe_off=0.8, lifted_height=0.7, forward=0.12)


def segments_of(task: MotionTask, params: MotionPlannerParams = PARAMS) -> tuple:
    """The segments of one step."""
    return plan_segments(task, CLIMB, Walker(params, ZmpPreviewParams(), JVRC1))


def played(task: MotionTask) -> MotionPlan:
    """The motion of one step."""
    return play_segments(
        segments_of(task), task, Walker(PARAMS, ZmpPreviewParams(), JVRC1)
    )


def test_the_com_rests_over_the_lower_of_two_nearly_level_feet() -> None:
    """So that neither leg is stretched by what the ground is uneven."""
    feet = np.array([[0.0, 0.095, 0, 0, 0, 0], [0.0, -0.095, 0, 0, 0, 0]])
    com = np.array([PARAMS.zmp_forward, 0.0, PARAMS.com_height])
    uneven = 0.5 * PARAMS.climb_threshold
    for height, lower in ((uneven, 0.0), (-uneven, -uneven)):
        X_WF = RigidTransform(np.array([0.1, -0.095, height]))
        footstep = Footstep(foot="right", X_WF=X_WF, plane=-1)
        segments = segments_of(MotionTask(feet, com, (footstep,)))
        rest = [0.05 + PARAMS.zmp_forward, 0.0, lower + PARAMS.com_height]
        np.testing.assert_allclose(segments[-1].com[1], rest, atol=1e-12)


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
    assert segments[2].com[0][2] == segments[2].com[1][2]
    for before, after in pairwise(segments):
        np.testing.assert_array_equal(before.com[1], after.com[0])
        np.testing.assert_array_equal(before.end, after.start)
        assert before.lean[1] == after.lean[0]


def test_a_segment_takes_as_long_as_its_way(step_24cm: MotionTask) -> None:
    """The free foot's over the nosing, the CoM's line, or the least time."""
    quasi = PARAMS.quasi_static
    found = [segment.duration for segment in segments_of(step_24cm)]
    up_and_down = 2.0 * PARAMS.swing.apex_clearance
    rear = segments_of(step_24cm)[4]
    moved = np.abs(rear.end[0, :3] - rear.start[0, :3])
    along = np.hypot(0.327 + 0.12 - 0.035, -0.087 - 0.087)
    ways = [
        quasi.min_time,
        (0.327 + 0.24 + up_and_down) / quasi.foot_speed,
        None,
        None,
        (np.hypot(*moved[:2]) + moved[2] + up_and_down) / quasi.foot_speed,
        None,
    ]
    for duration, wanted in zip(found, ways, strict=True):
        if wanted is not None:
            assert wanted - 1e-9 <= duration <= wanted + PARAMS.period
    line = float(np.hypot(along, 0.24 + 0.7 - 0.85)) / quasi.com_speed
    assert found[2] + found[3] >= line - 1e-9


def test_walking_up_to_a_step_is_level_and_upright(step_24cm: MotionTask) -> None:
    """The CoM keeps its height there and rests in the middle before the step."""
    ahead = RigidTransform(np.array([0.2, 0.0, 0.0]))
    near = tuple(
        dataclasses.replace(
            step, X_WF=RigidTransform([0.2, step.X_WF.translation()[1], 0.0])
        )
        for step in step_24cm.footsteps
    )
    up = tuple(
        dataclasses.replace(step, X_WF=ahead.multiply(step.X_WF))
        for step in step_24cm.footsteps
    )
    task = dataclasses.replace(
        step_24cm, com=np.array([0.035, 0.0, 0.83]), footsteps=(*near, *up)
    )
    segments = segments_of(task)
    names = [segment.name for segment in segments]
    middles = [k for k, name in enumerate(names) if name == "CoM to the middle"]
    assert middles == [4, len(names) - 1]
    assert segments[0].com[1][2] == 0.83
    for segment in segments[:5]:
        np.testing.assert_array_equal(segment.lean, 0.0)
    np.testing.assert_array_equal(segments[5].lean, [0.0, CLIMB.lean])
    assert segments[-1].lean[1] == 0.0


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


def test_the_motion_is_that_of_its_segments(step_24cm: MotionTask) -> None:
    """Feet, contacts, lengths and lean at both ends of each, at rest in between."""
    plan, segments = played(step_24cm), segments_of(step_24cm)
    rest = round(PARAMS.quasi_static.rest / plan.period)
    for segment, phase in zip(segments, plan.phases, strict=True):
        first, last = (round(t / plan.period) for t in (phase.start, phase.end))
        moving, resting = slice(first, last - rest), slice(last - rest, last)
        assert last - rest - first == round(segment.duration / plan.period)
        np.testing.assert_allclose(plan.foot_poses[first], segment.start, atol=1e-9)
        ended = plan.foot_poses[resting]
        np.testing.assert_allclose(ended, np.tile(segment.end, (rest, 1, 1)), atol=1e-9)
        np.testing.assert_allclose(plan.com[resting] - segment.com[1], 0.0, atol=1e-9)
        np.testing.assert_allclose(plan.waist[first, 1], segment.lean[0], atol=1e-9)
        np.testing.assert_allclose(plan.waist[resting, 1], segment.lean[1])
        np.testing.assert_array_equal(
            plan.contact_lengths[moving] - segment.lengths, 0.0
        )
        for i, foot in enumerate(("left", "right")):
            standing = float(foot != segment.swing)
            np.testing.assert_array_equal(plan.contacts[moving, i], standing)
            np.testing.assert_array_equal(plan.contacts[resting, i], 1.0)


def test_the_ground_rises_from_foot_to_foot(step_24cm: MotionTask) -> None:
    """Under the CoM, which goes from over the lower one to over the upper one."""
    plan = played(step_24cm)
    over = [round(plan.phases[k].end / plan.period) - 1 for k in (1, 2, 3)]
    lower, between, upper = plan.zmp[over, 2]
    assert lower == 0.0
    assert 0.0 < between < 0.24
    assert upper == pytest.approx(0.24)


def test_the_pelvis_faces_where_the_feet_do(step_24cm: MotionTask) -> None:
    """The whole task turned: so are the feet and the pelvis at its end."""
    turn = RigidTransform(RollPitchYaw(0.0, 0.0, 0.4), [0.0, 0.0, 0.0])
    feet = step_24cm.feet.copy()
    for pose in feet:
        pose[:3] = turn.multiply(pose[:3])
        pose[5] = 0.4
    task = dataclasses.replace(
        step_24cm,
        feet=feet,
        com=turn.multiply(step_24cm.com),
        footsteps=tuple(
            dataclasses.replace(step, X_WF=turn.multiply(step.X_WF))
            for step in step_24cm.footsteps
        ),
        edges=np.array(turn.multiply(step_24cm.edges.T)).T.reshape(-1, 3),
    )
    plan = played(task)
    np.testing.assert_allclose(plan.waist[:, 2], 0.4, atol=1e-9)
    straight = played(step_24cm)
    np.testing.assert_allclose(plan.com[-1], turn.multiply(straight.com[-1]), atol=1e-9)


def test_a_lifted_rear_foot_clears_a_nosing_lower_than_its_heel(
    step_10cm: MotionTask,
) -> None:
    """Its toes are on the ground, its sole frame above the tread."""
    plan = played(step_10cm)
    assert plan.foot_poses[round(plan.phases[3].end / plan.period) - 1, 0, 2] > 0.1
    (edge,) = step_10cm.edges
    swing = plan.foot_poses[plan.contacts[:, 0] < 0.5, 0]
    tips = np.linspace(-JVRC1.sole.heel, JVRC1.sole.toe, 12)
    x = swing[:, :1] + tips * np.cos(swing[:, 4:5])
    z = swing[:, 2:3] - tips * np.sin(swing[:, 4:5])
    above = np.abs(x - edge[0]) < 0.01
    assert above.any()
    assert (z[above] - edge[2]).min() > 0.01


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
    rough = dataclasses.replace(PARAMS, quasi_static=QuasiStaticParams(friction=1.5))
    assert "empty" not in unstable_segment(broken, rough, JVRC1)


@pytest.mark.parametrize(
    ("field", "value"),
    [("com_speed", 0.0), ("foot_speed", -1.0), ("margin", -0.1), ("friction", 0.0)],
)
def test_parameters_out_of_range_are_refused(field: str, value: float) -> None:
    """By name."""
    with pytest.raises(ValueError, match=f"{field}: must"):
        QuasiStaticParams(**{field: value}).validate()
