"""Plays a motion plan: from abstract plan to vectors for the fast loop."""

from collections.abc import Callable
from functools import partial

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RollPitchYaw
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_abstract, set_vector
from footfall.systems.timing import timed


def plan_row(plan: MotionPlan, time: float) -> int:
    """The row of a plan that is due, clamped to its ends.

    A tick that comes early by rounding counts as its row.
    """
    row = int((time - plan.start_time) / plan.period + 1e-6)
    return min(max(row, 0), len(plan.zmp) - 1)


def foot_references(plan: MotionPlan, row: int) -> Vector:
    """Foot poses and their rates at a row, (24,): left, right; then both rates."""
    poses = plan.foot_poses[row]
    following = plan.foot_poses[min(row + 1, len(plan.zmp) - 1)]
    return np.concatenate([poses, (following - poses) / plan.period]).ravel()


def footholds(plan: MotionPlan, row: int) -> Vector:
    """Planes on which the feet are to stand flat and still, (8,); see MotionPlayer."""
    planes = np.zeros((2, 4))
    following = plan.foot_poses[min(row + 1, len(plan.zmp) - 1)]
    whole = plan.contact_lengths.max()
    for i in range(2):
        pose = plan.foot_poses[row, i]
        flat = plan.contact_lengths[row, i] == whole
        if plan.contacts[row, i] and flat and (pose == following[i]).all():
            normal = RollPitchYaw(pose[3:]).ToRotationMatrix().matrix()[:, 2]
            planes[i] = *normal, normal @ pose[:3]
    return planes.ravel()


def zmp_preview(plan: MotionPlan, row: int, horizon: int) -> Vector:
    """The cart's ZMP from a row on, (2 (horizon + 1),): first all x, then all y."""
    window = np.empty((2, horizon + 1))
    seen = plan.cart_zmp[row : row + horizon + 1].T
    window[:, : seen.shape[1]] = seen
    window[:, seen.shape[1] :] = plan.cart_zmp[-1][:, None]
    return window.ravel()


def waist_reference(plan: MotionPlan, row: int) -> Vector:
    """Pelvis (roll, pitch, yaw) and its rates at a row, (6,)."""
    rpy = plan.waist[row]
    following = plan.waist[min(row + 1, len(plan.zmp) - 1)]
    return np.concatenate([rpy, (following - rpy) / plan.period])


def arm_reference(plan: MotionPlan, row: int) -> Vector:
    """Pitch of the shoulders from their posture and its rate at a row, (2,)."""
    if not len(plan.arms):
        return np.zeros(2)
    pitch = plan.arms[row]
    following = plan.arms[min(row + 1, len(plan.zmp) - 1)]
    return np.array([pitch, (following - pitch) / plan.period])


class MotionPlayer(LeafSystem):
    """Publishes what a motion plan wants now.

    .. pydrake_system::

        name: MotionPlayer
        input_ports:
        - motion_plan
        output_ports:
        - foot_references
        - contacts
        - footholds
        - com_height
        - zmp
        - zmp_preview
        - waist
        - arms
        - plan_start

    - `motion_plan`: abstract MotionPlan; before its start its first row is played,
      after its end its last.
    - `foot_references`: sole frames X_WF (x, y, z, roll, pitch, yaw) of the left and
      the right foot, then the rates of both, (24,), m, rad, m/s, rad/s.
    - `contacts`: whether the left and the right foot are to be on the ground, 0 or 1,
      then the length of each sole that carries, (4,), -, -, m, m.
    - `footholds`: planes on which the left and the right sole are to lie still, normal
      n in W and distance n . x of its points, (8,), -, -, -, m; zeros of a foot that
      moves, is in the air or on its toes.
    - `com_height`: z of p_WCom, its rate and its acceleration, (3,), m, m/s, m/s^2.
    - `zmp`: p_WZmp of the planned motion, (3,), m.
    - `zmp_preview`: ZMP of the cart from now to `horizon` ticks ahead, first all x,
      then all y, (2 (horizon + 1),), m.
    - `waist`: pelvis (roll, pitch, yaw) in W and their rates, (6,), rad, rad/s.
    - `arms`: how far both shoulders pitch to the rear of their posture and the rate,
      (2,), rad, rad/s.
    - `plan_start`: start time of the plan, (1,), s; a new value is a new plan.
    """

    def __init__(self, horizon: int) -> None:
        """Declares the ports.

        Args:
            horizon: ticks of ZMP preview.

        Raises:
            ValueError: horizon is not positive.
        """
        super().__init__()
        if horizon < 1:
            raise ValueError(f"horizon must be at least 1 tick, got {horizon}")
        self._plan = self.DeclareAbstractInputPort(
            "motion_plan", AbstractValue.Make(MotionPlan)
        )

        def com_height(plan: MotionPlan, row: int) -> Vector:
            return np.array(
                [
                    plan.com[row, 2],
                    plan.com_velocity[row, 2],
                    plan.com_acceleration[row, 2],
                ]
            )

        def contacts(plan: MotionPlan, row: int) -> Vector:
            return np.concatenate([plan.contacts[row], plan.contact_lengths[row]])

        samplers: tuple[tuple[str, int, Callable[[MotionPlan, int], Vector]], ...] = (
            ("foot_references", 24, foot_references),
            ("contacts", 4, contacts),
            ("footholds", 8, footholds),
            ("com_height", 3, com_height),
            ("zmp", 3, lambda plan, row: plan.zmp[row]),
            (
                "zmp_preview",
                2 * (horizon + 1),
                lambda plan, row: zmp_preview(plan, row, horizon),
            ),
            ("waist", 6, waist_reference),
            ("arms", 2, arm_reference),
            ("plan_start", 1, lambda plan, row: np.array([plan.start_time])),
        )
        for name, size, sample in samplers:
            self.DeclareVectorOutputPort(
                name,
                size,
                timed(self, partial(self._calc, sample)),
                prerequisites_of_calc={self._plan.ticket(), self.time_ticket()},
            )

    def _calc(
        self,
        sample: Callable[[MotionPlan, int], Vector],
        context: Context,
        output: BasicVector,
    ) -> None:
        plan = eval_abstract(self._plan, context, MotionPlan)
        set_vector(output, sample(plan, plan_row(plan, context.get_time())))
