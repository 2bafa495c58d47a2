"""Where the CoM truly is: the forces under the feet correct the model's masses.

A model's CoM is off by millimetres as built and by centimetres with a payload; a DCM
that is off by as much makes every step land elsewhere. Of a robot that stands still the
CoM is over the ZMP, which the force sensors tell within a millimetre.
"""

import math
from dataclasses import dataclass

import numpy as np
from pydrake.math import RollPitchYaw
from pydrake.systems.framework import (
    BasicVector,
    Context,
    DiscreteStateIndex,
    DiscreteValues,
    LeafSystem,
)

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.ports import (
    declare_state,
    eval_vector,
    read_state,
    set_state,
    set_vector,
)
from footfall.systems.sensing.measured_zmp import zmp_now
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class ComObserverParams(Parameters):
    """How fast the CoM of the model is corrected."""

    period: float = number(
        0.005, "s", least=1e-4, most=0.1, shared="parameters.control_period"
    )
    """Of the controllers, s."""
    time: float = number(1.0, "s", above=0.0)
    """Time constant while the robot stands, s; shorter at the start."""
    trust: float = number(0.3, "s", least=0.0)
    """How much the model counts at the start, as so long a time of standing, s: the
    robot sways while it takes up its load."""
    rest_speed: float = number(0.01, "m/s", least=0.0)
    """Speed of the CoM below which it stands, m/s."""
    rest_time: float = number(0.5, "s", least=0.0)
    """For how long it is to stand before anything is learnt, s."""
    largest: float = number(0.05, "m", least=0.0)
    """Most that is corrected along either axis, m."""


LEAST_FORCE = 100.0
"""Less than this the feet do not bear the body, N."""


class ComObserver(LeafSystem):
    """Corrects the CoM of the model, horizontally, by the forces under the feet.

    .. pydrake_system::

        name: ComObserver
        input_ports:
        - com
        - com_velocity
        - foot_poses
        - foot_wrenches
        output_ports:
        - com
        - offset

    - `com` (input): p_WCom as the model has it, (3,), m.
    - `com_velocity`: v_WCom, (3,), m/s.
    - `foot_poses`: sole frames X_WF (x, y, z, roll, pitch, yaw), left then right,
      (12,), m and rad.
    - `foot_wrenches`: measured, of the ground on the left and the right foot, each
      force then moment about F, in F, (12,), N and Nm.
    - `com` (output): p_WCom with the correction of the last tick, (3,), m.
    - `offset`: that correction, ahead and to the left midway between the headings of
      the feet, (2,), m.

    The discrete state is the offset, for how long it has been learnt and for how long
    the robot has stood, s.
    """

    def __init__(
        self, params: ComObserverParams, model_error: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        """Declares the ports.

        Args:
            params: see there.
            model_error: what is added to the model's CoM, ahead and to the left, m: a
                model that is wrong, to see what comes of it.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate()
        self._params = params
        self._error = model_error
        self._memory = declare_state(self, np.zeros(4))
        self._com = self.DeclareVectorInputPort("com", 3)
        self._velocity = self.DeclareVectorInputPort("com_velocity", 3)
        self._poses = self.DeclareVectorInputPort("foot_poses", 12)
        self._wrenches = self.DeclareVectorInputPort("foot_wrenches", 12)
        memory = self.discrete_state_ticket(DiscreteStateIndex(self._memory))
        self.DeclareVectorOutputPort(
            "com",
            3,
            timed(self, self._calc_com),
            prerequisites_of_calc={
                self._com.ticket(),
                self._poses.ticket(),
                memory,
            },
        )
        self.DeclareVectorOutputPort(
            "offset", 2, timed(self, self._calc_offset), prerequisites_of_calc={memory}
        )
        self.DeclarePeriodicDiscreteUpdateEvent(
            params.period, 0.0, timed(self, self._update)
        )

    def _turn(self, context: Context) -> tuple[float, float]:
        """Cosine and sine of the heading midway between the feet's."""
        poses = eval_vector(self._poses, context)
        left, right = float(poses[5]), float(poses[11])
        yaw = left + 0.5 * math.remainder(right - left, math.tau)
        return math.cos(yaw), math.sin(yaw)

    def _calc_com(self, context: Context, output: BasicVector) -> None:
        memory = read_state(context, self._memory)
        ahead = self._error[0] + float(memory[0])
        to_left = self._error[1] + float(memory[1])
        c, s = self._turn(context)
        com = eval_vector(self._com, context).copy()
        com[0] += c * ahead - s * to_left
        com[1] += s * ahead + c * to_left
        set_vector(output, com)

    def _calc_offset(self, context: Context, output: BasicVector) -> None:
        set_vector(output, read_state(context, self._memory)[:2])

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        params = self._params
        ahead, to_left, learnt, stood = read_state(context, self._memory).tolist()
        speed = math.hypot(*eval_vector(self._velocity, context)[:2].tolist())
        stood = stood + params.period if speed < params.rest_speed else 0.0
        if stood > params.rest_time:
            zmp = self._zmp(context)
            if np.isfinite(zmp[0]):
                learnt += params.period
                share = params.period / min(params.trust + learnt, params.time)
                c, s = self._turn(context)
                x, y = (zmp - eval_vector(self._com, context))[:2].tolist()
                off = c * x + s * y - self._error[0], c * y - s * x - self._error[1]
                ahead, to_left = (
                    min(max(old + share * (new - old), -params.largest), params.largest)
                    for old, new in zip((ahead, to_left), off, strict=True)
                )
        set_state(discrete, self._memory, np.array([ahead, to_left, learnt, stood]))

    def _zmp(self, context: Context) -> Vector:
        """Measured, (3,), m; nan where the feet do not bear."""
        poses = eval_vector(self._poses, context).reshape(2, 6)
        frames = [
            (RollPitchYaw(*pose[3:]).ToRotationMatrix().matrix(), pose[:3])
            for pose in poses
        ]
        wrenches = eval_vector(self._wrenches, context).reshape(2, 6)
        return zmp_now(frames, wrenches, LEAST_FORCE)
