"""An executive that stands."""

import pytest

from footfall.models.values.planned import FootstepPlan
from footfall.systems.planning.executive.stand_executive import StandExecutive
from tests.systems.test_system_docstrings import standing_plan


def test_it_stands_and_is_finished_after_its_time() -> None:
    """Its plan is the one that it was given, without footsteps."""
    plan = standing_plan()
    system = StandExecutive(plan, 2.0)
    context = system.CreateDefaultContext()
    for time, state in ((0.0, "running"), (1.99, "running"), (2.0, "finished")):
        context.SetTime(time)
        assert system.GetOutputPort("status").Eval(context).state == state
        assert system.GetOutputPort("motion_plan").Eval(context) == plan
        steps = system.GetOutputPort("footstep_plan").Eval(context)
        assert steps == FootstepPlan()


def test_a_negative_time_is_refused() -> None:
    """By name."""
    with pytest.raises(ValueError, match=r"duration: must be at least 0 s"):
        StandExecutive(standing_plan(), -1.0)
