"""Footsteps to an estimated staircase and onto its treads (stair paper, Sec. 6.1)."""

from collections.abc import Mapping

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import Foot, other_foot
from footfall.models.values.geometry import rotate
from footfall.models.values.perceived import Staircase
from footfall.models.values.planned import Footstep, FootstepPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.approach import approach_staircase
from footfall.systems.planning.footsteps.climb import (
    climb_treads,
    lateral_position,
    refuse_unclimbable,
    staircase_yaw,
)
from footfall.systems.planning.footsteps.foothold import Refusal, front_edge
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.standing import FLOOR, HIDDEN, standing_on
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


def plan_footsteps(
    staircase: Staircase,
    X_WF_left: RigidTransform,
    X_WF_right: RigidTransform,
    params: FootstepPlannerParams,
    sole: Sole,
) -> FootstepPlan:
    """Plans the way to the next scan: an approach on the floor, then up some treads.

    From the floor, or on a landing, the robot first walks to a stand with its toes
    `stand_distance` before the next tread, aligned with the staircase and far enough
    from its sides.
    Then each tread gets both feet, the second beside the first. Only the estimated
    rectangles are used; where the robot stands follows from its feet.

    Args:
        staircase: what was seen, in W; treads from the lowest to the highest.
        X_WF_left: pose of the left sole.
        X_WF_right: pose of the right sole.
        params: reach, margins and tolerances.
        sole: both soles.

    Returns:
        The footsteps, or "finished" where the robot stands on the highest known tread,
        or "infeasible" with the reason. A second tread that does not fit ends the
        plan on the first, as it may have been seen in part only; one that is too
        high, too steep or turned away refuses the climb at once.
    """
    feet: Mapping[Foot, RigidTransform] = {"left": X_WF_left, "right": X_WF_right}
    steps = _plan(staircase, feet, params, sole)
    if isinstance(steps, Refusal):
        return FootstepPlan(status="infeasible", reason=steps.reason)
    return FootstepPlan(footsteps=steps, status="planned" if steps else "finished")


def _plan(
    staircase: Staircase,
    feet: Mapping[Foot, RigidTransform],
    params: FootstepPlannerParams,
    sole: Sole,
) -> tuple[Footstep, ...] | Refusal:
    """The footsteps, none where the robot is at the top."""
    treads = staircase.treads
    if not treads:
        return Refusal("no staircase seen")
    ground = standing_on(staircase, feet, params, sole)
    if isinstance(ground, Refusal):
        return ground
    z = float(np.mean([X_WF.translation()[2] for X_WF in feet.values()]))
    above = list(range(ground + 1, len(treads)))
    if ground == HIDDEN:
        heights = [tread.X_WR.translation()[2] for tread in treads]
        above = [i for i, height in enumerate(heights) if height > z]
        if not above:
            return Refusal(
                f"the feet stand {z - max(heights):.2f} m above the highest tread, on "
                "nothing that was seen"
            )
    if not above:
        return ()
    ahead = above[: params.steps_between_scans]
    yaw = staircase_yaw([treads[i] for i in ahead])
    refusal = refuse_unclimbable(treads, ahead, ground, z, yaw, params)
    if refusal is not None:
        return refusal
    middle = np.mean([X_WF.translation()[:2] for X_WF in feet.values()], axis=0)
    y = lateral_position(treads, above, yaw, rotate(-yaw, middle)[1], sole, params)
    if isinstance(y, Refusal):
        return y
    lead: Foot = "left" if params.lead_foot == "left" else "right"
    approach: tuple[Footstep, ...] = ()
    distance = 0.0
    landing = ground >= 0 and treads[ground].size[0] > params.landing_depth
    if ground == FLOOR or landing:
        side = params.stance_width / 2.0 + sole.half_width
        edge = min(front_edge(treads[above[0]], yaw, y + d) for d in (-side, side))
        stand = np.array([edge - params.stand_distance - sole.toe, y])
        distance = float(np.linalg.norm(rotate(yaw, stand) - middle))
        walk = approach_staircase(staircase, ground, feet, stand, yaw, z, sole, params)
        if isinstance(walk, Refusal):
            return walk
        approach = walk
    if approach:
        feet = {**feet, **{step.foot: step.X_WF for step in approach}}
        lead = other_foot(approach[-1].foot)
    climb = climb_treads(treads, ahead, feet, lead, yaw, y, sole, params)
    if isinstance(climb, Refusal):
        if ground == HIDDEN:
            return Refusal(f"{climb.reason}; the feet stand on nothing that was seen")
        return climb
    if approach and distance > params.rescan_distance:
        return approach
    return approach + climb


def pose_from_xyz_rpy(pose: Vector) -> RigidTransform:
    """The pose X_WF with coordinates (x, y, z, roll, pitch, yaw), (6,), m and rad."""
    rpy: Vector = pose[3:]
    p_WF: Vector = pose[:3]
    return RigidTransform(RollPitchYaw(rpy), p_WF)


class FootstepPlanner(LeafSystem):
    """Plans footsteps on the staircase that was seen, from where the feet are.

    .. pydrake_system::

        name: FootstepPlanner
        input_ports:
        - staircase
        - foot_poses
        output_ports:
        - footstep_plan

    - `staircase`: treads and floor as estimated, in W, abstract Staircase.
    - `foot_poses`: the sole frames X_WF, left then right, each (x, y, z, roll, pitch,
      yaw), (12,), m and rad; the angles are those of RollPitchYaw.
    - `footstep_plan`: the way to the next scan, or why there is none, in W, abstract
      FootstepPlan. It has no state: it is planned anew when an input changes.
    """

    def __init__(self, params: FootstepPlannerParams, sole: Sole) -> None:
        """Declares the ports.

        Args:
            params: reach, margins and tolerances.
            sole: both soles of the robot.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate(sole)
        self._params = params
        self._sole = sole
        self._staircase = self.DeclareAbstractInputPort(
            "staircase", AbstractValue.Make(Staircase())
        )
        self._foot_poses = self.DeclareVectorInputPort("foot_poses", 12)
        self.DeclareAbstractOutputPort(
            "footstep_plan",
            lambda: AbstractValue.Make(FootstepPlan()),
            timed(self, self._calc_footstep_plan),  # type: ignore[arg-type]
            prerequisites_of_calc={
                self._staircase.ticket(),
                self._foot_poses.ticket(),
            },
        )

    def _calc_footstep_plan(self, context: Context, output: AbstractValue) -> None:
        staircase = eval_abstract(self._staircase, context, Staircase)
        poses = eval_vector(self._foot_poses, context).reshape(2, 6)
        left, right = (pose_from_xyz_rpy(pose) for pose in poses)
        plan = plan_footsteps(staircase, left, right, self._params, self._sole)
        output.set_value(plan)
