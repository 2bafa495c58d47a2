"""The motion planner as a System: footsteps in, motion plan out."""

import dataclasses

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.perceived import PlaneSegment, Staircase
from footfall.models.values.planned import FootstepPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_choice import choose_motion
from footfall.systems.planning.motion.motion_prediction import MotionPredictor
from footfall.systems.planning.motion.motion_task import Mode, MotionTask, Walker
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


def front_edges(treads: tuple[PlaneSegment, ...]) -> Vector:
    """The middle of the front edge of each tread as it was estimated, (m, 3), m."""
    edges = np.zeros((len(treads), 3))
    for edge, tread in zip(edges, treads, strict=True):
        p_RE: Vector = np.array([-0.5 * tread.size[0], 0.0, 0.0])
        edge[:] = tread.X_WR.multiply(p_RE)
    return edges


class MotionPlanner(LeafSystem):
    """Plans the motion along footsteps, from where the references are now.

    .. pydrake_system::

        name: MotionPlanner
        input_ports:
        - footstep_plan
        - staircase
        - foot_references
        - com_reference
        output_ports:
        - motion_plan

    - `footstep_plan`: abstract FootstepPlan.
    - `staircase`: the treads whose edges the feet must clear, abstract Staircase.
    - `foot_references`: sole frames X_WF that are tracked now, left then right, then
      their rates, (24,), m, rad, m/s, rad/s.
    - `com_reference`: p_WCom, v_WCom and a_WCom that are tracked now, (9,).
    - `motion_plan`: abstract MotionPlan that starts at time 0; it stands where there
      are no footsteps, and where they cannot be carried out, which its `reason` tells.
    """

    def __init__(
        self,
        walker: Walker,
        mode: Mode = "dynamic",
        predictor: MotionPredictor | None = None,
    ) -> None:
        """Declares the ports.

        Args:
            walker: parameters and robot.
            mode: how the robot is to move.
            predictor: of this robot, by which lean and toe-off are chosen; without one
                the first that are tried are taken.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        walker.params.validate()
        self._walker, self._predictor = walker, predictor
        self._mode: Mode = mode
        self._footsteps = self.DeclareAbstractInputPort(
            "footstep_plan", AbstractValue.Make(FootstepPlan())
        )
        self._staircase = self.DeclareAbstractInputPort(
            "staircase", AbstractValue.Make(Staircase())
        )
        self._feet = self.DeclareVectorInputPort("foot_references", 24)
        self._com = self.DeclareVectorInputPort("com_reference", 9)
        nowhere = MotionTask(np.zeros((2, 6)), np.array([0.0, 0.0, 1.0]))
        model = plan_motion(nowhere, dataclasses.replace(walker, body=None))
        self.DeclareAbstractOutputPort(
            "motion_plan",
            lambda: AbstractValue.Make(model),
            timed(self, self._calc_plan),  # type: ignore[arg-type]
            prerequisites_of_calc={
                port.ticket()
                for port in (self._footsteps, self._staircase, self._feet, self._com)
            },
        )

    def _calc_plan(self, context: Context, output: AbstractValue) -> None:
        footsteps = eval_abstract(self._footsteps, context, FootstepPlan).footsteps
        staircase = eval_abstract(self._staircase, context, Staircase)
        task = MotionTask(
            feet=eval_vector(self._feet, context)[:12].reshape(2, 6),
            com=eval_vector(self._com, context)[:3],
            footsteps=footsteps,
            edges=front_edges(staircase.treads),
        )
        plan = choose_motion(task, self._mode, self._walker, self._predictor)
        output.set_value(plan)
