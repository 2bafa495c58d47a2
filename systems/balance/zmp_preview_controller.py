"""The preview controller as a System: ZMP reference in, CoM reference out."""

from functools import partial

import numpy as np
from pydrake.systems.framework import BasicVector, Context, DiscreteValues, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    PreviewGains,
    ZmpPreviewParams,
    preview_gains,
    preview_step,
    rest_error_sum,
    rest_state,
)
from footfall.systems.ports import eval_vector, set_vector
from footfall.systems.timing import timed


class ZmpPreviewController(LeafSystem):
    """Generates the CoM motion that keeps the ZMP on a reference (Kajita 2003).

    .. pydrake_system::

        name: ZmpPreviewController
        input_ports:
        - zmp_preview
        - reset
        output_ports:
        - com
        - com_velocity
        - com_acceleration
        - zmp

    - `zmp_preview`: reference p_WZmp from now to `horizon` ticks ahead, first all x,
      then all y, (2 (horizon + 1),), m.
    - `reset`: (flag, x, y, vx, vy), (5,); while the flag exceeds 0.5 the motion starts
      anew from CoM p_WCom, m, and velocity v_WCom, m/s, of this tick, with no
      acceleration. Where it is not connected there is no reset.
    - `com`: p_WCom wanted now, horizontal, (2,), m.
    - `com_velocity`: v_WCom, (2,), m/s.
    - `com_acceleration`: a_WCom, (2,), m/s^2.
    - `zmp`: p_WZmp that this motion has under the cart-table model, (2,), m.

    The discrete state is (x, y) rows of position, velocity and acceleration, then the
    sums of the ZMP error, (8,). Outputs depend on the state alone.
    """

    def __init__(
        self,
        params: ZmpPreviewParams | None = None,
        initial_com: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        """Solves for the gains and declares the ports.

        Args:
            params: see there; the paper's values if None.
            initial_com: where the CoM rests in the default context, (2,), m.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params = params or ZmpPreviewParams()
        self._gains = preview_gains(params)
        rest: Vector = np.array(initial_com, dtype=np.float64)
        initial: Vector = np.concatenate(
            [rest_state(rest).ravel(), rest_error_sum(self._gains, rest)]
        )
        self._state = self.DeclareDiscreteState(initial)
        self._zmp_preview = self.DeclareVectorInputPort(
            "zmp_preview", 2 * (self._gains.horizon + 1)
        )
        self._reset = self.DeclareVectorInputPort("reset", 5)
        for name, row in (
            ("com", np.array([1.0, 0.0, 0.0])),
            ("com_velocity", np.array([0.0, 1.0, 0.0])),
            ("com_acceleration", np.array([0.0, 0.0, 1.0])),
            ("zmp", self._gains.C),
        ):
            self.DeclareVectorOutputPort(
                name,
                2,
                timed(self, partial(self._calc_row, row)),
                prerequisites_of_calc={self.discrete_state_ticket(self._state)},
            )
        self.DeclarePeriodicDiscreteUpdateEvent(
            period_sec=params.period, offset_sec=0.0, update=timed(self, self._update)
        )

    @property
    def gains(self) -> PreviewGains:
        """The law; its `horizon` gives the size of `zmp_preview`."""
        return self._gains

    def _calc_row(self, row: Vector, context: Context, output: BasicVector) -> None:
        set_vector(output, self._motion(context)[0] @ row)

    def _motion(self, context: Context) -> tuple[Vector, Vector]:
        value = context.get_discrete_state(int(self._state)).value()
        return value[:6].reshape(2, 3), value[6:]

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        state, error_sum = self._motion(context)
        zmp_preview = eval_vector(self._zmp_preview, context).reshape(2, -1)
        if self._reset.HasValue(context):
            reset = eval_vector(self._reset, context)
            if reset[0] > 0.5:
                state = np.column_stack([reset[1:3], reset[3:5], np.zeros(2)])
                error_sum = rest_error_sum(self._gains, zmp_preview[:, 0])
        state, error_sum, _ = preview_step(self._gains, state, error_sum, zmp_preview)
        value: Vector = np.concatenate([state.ravel(), error_sum])
        discrete.get_mutable_vector(int(self._state)).SetFromVector(value)
