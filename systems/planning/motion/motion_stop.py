"""Bringing a walk to an early end: the same motion with fewer steps."""

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.values.feet import other_foot
from footfall.models.values.planned import Footstep, MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_task import MotionTask, Walker

COMMITTED = 1.6
"""What lies farther ahead than this moves the CoM by less than a millimetre now, s."""


def stop_early(
    plan: MotionPlan,
    time: float,
    stance_width: float,
    walker: Walker,
) -> MotionPlan | None:
    """Cuts off the footsteps of a plan as soon as balance allows.

    The steps that land within `COMMITTED` are kept, since the CoM already moves for
    them; one more puts the feet side by side. Planned anew from the same start, the
    motion is the same until then but for what the preview shows of the end.

    Args:
        plan: on level ground; what is being carried out.
        time: when the shorter plan takes over, s.
        stance_width: between the ankles when the feet stand side by side, m.
        walker: parameters and robot, as for the plan.

    Returns:
        The shorter plan with the same start time; None where the plan ends as soon.
    """
    horizon = time - plan.start_time + min(walker.preview.preview_time, COMMITTED)
    lands = [phase.end for phase in plan.phases if phase.swing is not None]
    kept = sum(land < horizon for land in lands) + 1
    if kept + 1 >= len(lands):
        return None
    last = plan.footsteps[kept - 1]
    side = stance_width if last.foot == "right" else -stance_width
    p_FG: Vector = np.array([0.0, side, 0.0])
    beside = Footstep(
        other_foot(last.foot), last.X_WF.multiply(RigidTransform(p_FG)), last.plane
    )
    footsteps = (*plan.footsteps[:kept], beside)
    task = MotionTask(plan.foot_poses[0], plan.com[0], footsteps)
    shorter = plan_motion(task, walker)
    return shorter.starting_at(plan.start_time)
