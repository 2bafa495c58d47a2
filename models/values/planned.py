"""Values that planners put on their ports: footsteps, motions, a task's state.

World frame W: z up. A foot's sole frame F: origin on the sole under the ankle, x to
the toes, z up out of the ground.
"""

import dataclasses
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.values.feet import Foot
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector


@dataclass(frozen=True, eq=False)
class Footstep(Value):
    """Pose at which a foot is to stand."""

    foot: Foot
    X_WF: RigidTransform
    """Pose of the sole frame F."""
    plane: int
    """Index of the tread in the Staircase it was planned on, -1 for the floor."""


@dataclass(frozen=True, eq=False)
class FootstepPlan(Value):
    """A sequence of footsteps, or why there is none."""

    footsteps: tuple[Footstep, ...] = ()
    status: Literal["planned", "infeasible", "finished"] = "finished"
    reason: str = ""
    """Reason for being infeasible, in one line; empty otherwise."""


@dataclass(frozen=True, eq=False)
class ContactPhase(Value):
    """A stretch of a motion with the same contacts."""

    start: float
    """s after the motion's start."""
    end: float
    """s after the motion's start."""
    stance: tuple[Foot, ...]
    """The feet on the ground."""
    swing: Foot | None
    """The foot in the air."""


@dataclass(frozen=True, eq=False)
class MotionPlan(Value):
    """Reference motion of feet and CoM, sampled every `period` from `start_time`.

    Row i is due at start_time + i * period; after the last row it is held. Feet are
    in the order left, right.
    """

    start_time: float
    """s."""
    period: float
    """s."""
    footsteps: tuple[Footstep, ...]
    phases: tuple[ContactPhase, ...]
    contacts: Vector
    """1 where a foot is to be on the ground, (n, 2)."""
    foot_poses: Vector
    """Sole frames X_WF as (x, y, z, roll, pitch, yaw) of each foot, (n, 2, 6)."""
    contact_lengths: Vector
    """Length of each sole that carries, from the toe edge back, (n, 2), m: the whole
    sole when flat, a strip at the toes when the heel is lifted."""
    com: Vector
    """p_WCom, (n, 3), m."""
    com_velocity: Vector
    """(n, 3), m/s."""
    com_acceleration: Vector
    """(n, 3), m/s^2."""
    zmp: Vector
    """p_WZmp of that CoM motion with varying height, on the stance, (n, 3), m."""
    cart_zmp: Vector
    """ZMP of the cart-table of constant height that moves like it, (n, 2), m."""
    waist: Vector
    """Pelvis (roll, pitch, yaw) in W, (n, 3), rad."""
    arms: Vector = field(default_factory=lambda: np.zeros(0))
    """Pitch of both shoulders from the posture, (n,), rad, positive to the rear;
    empty where they rest."""
    reason: str = ""
    """Reason why the footsteps cannot be walked, in one line; the plan stands then."""

    @property
    def duration(self) -> float:
        """Time from the first row to the last, s."""
        return (len(self.zmp) - 1) * self.period

    def starting_at(self, time: float) -> "MotionPlan":
        """Shifts the motion to another start time, s."""
        return dataclasses.replace(self, start_time=time)


@dataclass(frozen=True, eq=False)
class TaskStatus(Value):
    """Progress of the task, as the executive sees it."""

    state: Literal["running", "finished", "infeasible"] = "running"
    activity: str = ""
    """Current activity, e.g. "scan", "plan", "move", "stand"."""
    reason: str = ""
    """Reason for stopping, in one line."""
