"""The footsteps along a path as a system."""

from collections.abc import Callable

from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.robots.robot import Sole
from footfall.models.values.planned import FootstepPlan
from footfall.models.values.room import Environment, PathPlan
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import pose_from_xyz_rpy
from footfall.systems.planning.path.path_footsteps import plan_path_footsteps
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


class PathFootstepPlanner(LeafSystem):
    """Plans footsteps along a path, from where the feet are to the goal's pose.

    A cached output without state: it is planned anew when an input has changed and
    someone asks.

    .. pydrake_system::

        name: PathFootstepPlanner
        input_ports:
        - path_plan
        - environment
        - foot_poses
        output_ports:
        - footstep_plan

    - `path_plan`: from midway between the feet, in W, PathPlan.
    - `environment`: what it was planned in, Environment.
    - `foot_poses`: the sole frames X_WF, left then right, each (x, y, z, roll, pitch,
      yaw), (12,), m and rad.
    - `footstep_plan`: in W, FootstepPlan; the path's reason where there is no path.
    """

    def __init__(self, params: FootstepPlannerParams, sole: Sole) -> None:
        """Declares the ports.

        Args:
            params: what the robot can step.
            sole: both soles of the robot.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate(sole)
        self._params = params
        self._sole = sole
        self._path_plan = self.DeclareAbstractInputPort(
            "path_plan", AbstractValue.Make(PathPlan())
        )
        self._environment = self.DeclareAbstractInputPort(
            "environment", AbstractValue.Make(Environment())
        )
        self._foot_poses = self.DeclareVectorInputPort("foot_poses", 12)
        calc_plan: Callable[..., None] = timed(self, self._calc_footstep_plan)
        self.DeclareAbstractOutputPort(
            "footstep_plan",
            lambda: AbstractValue.Make(FootstepPlan()),
            calc_plan,
            prerequisites_of_calc={
                self._path_plan.ticket(),
                self._environment.ticket(),
                self._foot_poses.ticket(),
            },
        )

    def _calc_footstep_plan(self, context: Context, output: AbstractValue) -> None:
        path = eval_abstract(self._path_plan, context, PathPlan)
        environment = eval_abstract(self._environment, context, Environment)
        poses = eval_vector(self._foot_poses, context).reshape(2, 6)
        left, right = (pose_from_xyz_rpy(pose) for pose in poses)
        output.set_value(
            plan_path_footsteps(
                path, environment, left, right, self._params, self._sole
            )
        )
