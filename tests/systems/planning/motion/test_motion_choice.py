"""Which posture is taken, and what a refusal names."""

import dataclasses

import numpy as np
import pytest

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.self_distance import SelfDistance
from footfall.models.values.planned import MotionPlan
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.choice_params import ChoiceParams
from footfall.systems.planning.motion.motion_choice import (
    Mode,
    MotionTask,
    choose_motion,
    violation,
)
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_prediction import MotionPrediction
from footfall.systems.planning.motion.motion_task import Walker

PREVIEW = ZmpPreviewParams(com_height=0.85)


def chosen(
    task: MotionTask, mode: Mode, jvrc1, choice: ChoiceParams | None = None
) -> MotionPlan:
    """The plan that is chosen."""
    params = MotionPlannerParams(choice=choice or ChoiceParams())
    return choose_motion(task, mode, Walker(params, PREVIEW, JVRC1), jvrc1.predictor)


@pytest.mark.parametrize("mode", ["dynamic", "quasi_static"])
def test_the_paper_s_step_can_be_climbed(step_24cm, jvrc1, mode: Mode) -> None:
    """In both modes, quickly and slowly."""
    plan = chosen(step_24cm, mode, jvrc1)
    assert plan.reason == ""
    np.testing.assert_allclose(plan.foot_poses[-1, :, 2], 0.24)
    assert (plan.duration > 10.0) == (mode == "quasi_static")


def test_more_lean_is_taken_where_less_asks_too_much(step_24cm, jvrc1) -> None:
    """Candidates in order, the first that keeps within the limits."""
    strict = ChoiceParams(leans=[0.0, 0.4], toe_offs=[0.7])
    plan = chosen(step_24cm, "dynamic", jvrc1, strict)
    assert plan.reason == ""
    assert plan.waist[:, 1].max() == pytest.approx(0.4)


@pytest.mark.parametrize("mode", ["dynamic", "quasi_static"])
def test_too_high_a_step_is_refused_and_the_plan_stands(step_32cm, jvrc1, mode) -> None:
    """The reason names the quantity."""
    brief = ChoiceParams(leans=[0.3], toe_offs=[0.7], quasi_static_leans=[0.6])
    plan = chosen(step_32cm, mode, jvrc1, brief)
    assert plan.reason.partition(":")[0] in ("torque", "reach", "clearance")
    assert plan.footsteps == ()
    np.testing.assert_array_equal(plan.contacts, 1.0)


def test_what_cannot_be_less_bad_is_not_looked_at_to_its_end(
    step_32cm, jvrc1, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the refusal is the one that looking at everything gives."""
    choice = ChoiceParams(
        quasi_static_leans=[0.6, 0.75],
        quasi_static_toe_offs=[0.85],
        quasi_static_forwards=[0.12],
    )
    plan = chosen(step_32cm, "quasi_static", jvrc1, choice)
    lengths: list[int] = []
    predict = jvrc1.predictor.predict

    def to_the_end(*args, **kwargs) -> MotionPrediction:
        lengths.append(len(predict(*args, **kwargs).time))
        prediction = predict(*args[:5])
        lengths.append(len(prediction.time))
        return prediction

    monkeypatch.setattr(jvrc1.predictor, "predict", to_the_end)
    assert chosen(step_32cm, "quasi_static", jvrc1, choice).reason == plan.reason
    assert len(lengths) == 4
    assert lengths[0] == lengths[1]
    assert lengths[2] < 0.8 * lengths[3]


def test_a_shin_against_the_nosing_is_refused(step_24cm, jvrc1) -> None:
    """With the toes at the riser."""
    near = dataclasses.replace(
        step_24cm, edges=step_24cm.edges - np.array([[0.06, 0.0, 0.0]])
    )
    brief = ChoiceParams(leans=[0.3], toe_offs=[0.7])
    reason = chosen(near, "dynamic", jvrc1, brief).reason
    assert reason.startswith("clearance: ")
    assert "_KNEE_S would come within -" in reason


def test_a_polygon_without_room_is_refused(step_24cm) -> None:
    """Without prediction too."""
    params = MotionPlannerParams()
    params.quasi_static.margin = 0.06
    plan = choose_motion(
        step_24cm, "quasi_static", Walker(params, PREVIEW, JVRC1), None
    )
    assert "static-stability polygon, less than 0.060 m" in plan.reason


def test_no_footsteps_is_a_plan_that_stands(step_24cm, jvrc1) -> None:
    """And no reason."""
    nothing = dataclasses.replace(step_24cm, footsteps=())
    plan = chosen(nothing, "quasi_static", jvrc1)
    assert plan.reason == ""
    assert plan.footsteps == ()


def prediction(**changes: object) -> MotionPrediction:
    """One of a motion that asks nothing."""
    values: dict = {
        "time": np.arange(100) * 0.02,
        "torques": np.zeros((100, 2)),
        "joints": ("HIP", "KNEE"),
        "effort_limits": np.array([100.0, 50.0]),
        "foot_error": np.zeros(100),
        "com_error": np.zeros(100),
        "posture_error": np.zeros(100),
        "gaps": np.full((100, 1), 0.1),
        "limbs": ("SHIN",),
        "self_distances": (SelfDistance(0.02, ("", "")),) * 100,
    }
    return MotionPrediction(**(values | changes))


def test_each_quantity_has_its_reason() -> None:
    """With value, time and allowance."""
    choice = ChoiceParams()
    assert violation(prediction(), 0.3, choice) == (0.0, "")
    torques = np.zeros((100, 2))
    torques[50:80, 1] = -60.0
    assert violation(prediction(torques=torques), 0.3, choice)[1] == (
        "torque: KNEE would need 60 Nm for 0.3 s at 1.3 s, more than 50 Nm"
    )
    torques[55:] = 0.0
    assert violation(prediction(torques=torques), 0.3, choice) == (0.0, "")
    late = np.linspace(0.0, 0.05, 100)
    assert violation(prediction(foot_error=late), 0.3, choice)[1] == (
        "reach: a sole would miss its place by 0.050 m at 2.0 s, more than 0.015 m"
    )
    assert violation(prediction(gaps=np.full((100, 1), -0.02)), 0.3, choice)[1] == (
        "clearance: SHIN would come within -0.020 m of a nosing at 0.0 s, less than "
        "0.005 m"
    )
    met = [SelfDistance(0.02, ("", ""))] * 100
    met[60] = SelfDistance(-0.004, ("PELVIS", "THIGH"))
    assert violation(prediction(self_distances=tuple(met)), 0.3, choice)[1] == (
        "clearance: PELVIS and THIGH would come within -0.004 m of each other at "
        "1.2 s, less than 0.002 m"
    )
    posture_error = violation(prediction(posture_error=late * 20.0), 0.3, choice)[1]
    assert posture_error.startswith(
        "reach: the upper body would have to stray 1.00 rad"
    )


@pytest.mark.parametrize(
    ("field", "value"),
    [("leans", []), ("toe_offs", [-0.1]), ("torque_share", 0.0), ("torque_window", -1)],
)
def test_parameters_out_of_range_are_refused(field: str, value: object) -> None:
    """By name."""
    with pytest.raises(ValueError, match=rf"^{field}(\[\d\])?: must"):
        ChoiceParams(**{field: value}).validate()
