"""Lets the robot stand where it is, for a while."""

from functools import partial
from typing import Literal

from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.planned import FootstepPlan, MotionPlan, TaskStatus
from footfall.models.values.validation import require_at_least
from footfall.systems.timing import timed


class StandExecutive(LeafSystem):
    """Carries out the plan that stands, and is finished after a while.

    .. pydrake_system::

        name: StandExecutive
        input_ports: []
        output_ports:
        - motion_plan
        - footstep_plan
        - status

    - `motion_plan`: the motion that is being carried out, abstract MotionPlan.
    - `footstep_plan`: its footsteps, none.
    - `status`: how the task is going, abstract TaskStatus.
    """

    def __init__(self, stand: MotionPlan, duration: float) -> None:
        """Declares the ports.

        Args:
            stand: the plan that stands.
            duration: how long the robot stands, s.

        Raises:
            ValueError: the duration is negative.
        """
        super().__init__()
        require_at_least("duration", duration, 0.0, "s")
        self._duration = duration
        for name, value in (("motion_plan", stand), ("footstep_plan", FootstepPlan())):
            self.DeclareAbstractOutputPort(
                name,
                partial(AbstractValue.Make, value),
                timed(self, _keep),
                prerequisites_of_calc={self.nothing_ticket()},
            )
        self.DeclareAbstractOutputPort(
            "status",
            lambda: AbstractValue.Make(TaskStatus()),
            timed(self, self._calc_status),  # type: ignore[arg-type]
            prerequisites_of_calc={self.time_ticket()},
        )

    def _calc_status(self, context: Context, status: AbstractValue) -> None:
        done = context.get_time() >= self._duration - 1e-9
        state: Literal["finished", "running"] = "finished" if done else "running"
        status.set_value(TaskStatus(state, "stand", "stood" if done else ""))


def _keep(context: object, output: object) -> None:
    """Leaves the value that the port was made with."""
