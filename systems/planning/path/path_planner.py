"""The path planning as a system."""

from collections.abc import Callable

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.room import Environment, PathPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.planning.path.path_search import plan_path
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


class PathPlanner(LeafSystem):
    """Plans a path from midway between the feet to the goal (room paper, Sec. 3.1).

    A cached output without state: it is planned anew when an input has changed and
    someone asks.

    .. pydrake_system::

        name: PathPlanner
        input_ports:
        - environment
        - foot_poses
        - goal
        output_ports:
        - path_plan

    - `environment`: floor and boxes in W, Environment.
    - `foot_poses`: the sole frames X_WF, left then right, each (x, y, z, roll, pitch,
      yaw), (12,), m and rad.
    - `goal`: where the point midway between the ankles is to come to, and the heading
      there, in W, (x, y, yaw), (3,), m and rad.
    - `path_plan`: in W, PathPlan; "refused" with the reason where there is no path.
    """

    def __init__(self, params: PathPlannerParams | None = None) -> None:
        """Declares the ports.

        Args:
            params: footprint and search; None for the defaults.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        self._params = params or PathPlannerParams()
        self._params.validate()
        self._environment = self.DeclareAbstractInputPort(
            "environment", AbstractValue.Make(Environment())
        )
        self._foot_poses = self.DeclareVectorInputPort("foot_poses", 12)
        self._goal = self.DeclareVectorInputPort("goal", 3)
        calc_path_plan: Callable[..., None] = timed(self, self._calc_path_plan)
        self.DeclareAbstractOutputPort(
            "path_plan",
            lambda: AbstractValue.Make(PathPlan()),
            calc_path_plan,
            prerequisites_of_calc={
                self._environment.ticket(),
                self._foot_poses.ticket(),
                self._goal.ticket(),
            },
        )

    def _calc_path_plan(self, context: Context, output: AbstractValue) -> None:
        environment = eval_abstract(self._environment, context, Environment)
        feet = eval_vector(self._foot_poses, context).reshape(2, 6)
        start: Vector = np.mean(feet[:, :2], axis=0)
        goal = eval_vector(self._goal, context)
        output.set_value(plan_path(environment, start, goal, self._params))
