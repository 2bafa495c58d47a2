"""The preview controller as a System: ZMP reference in, CoM reference out."""

import numpy as np
from pydrake.systems.framework import BasicVector, Context, DiscreteValues, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    PreviewGains,
    ZmpPreviewParams,
    preview_gains,
    preview_step,
    rest_error_sum,
)
from footfall.systems.ports import (
    declare_state_output,
    eval_vector,
    set_state,
    set_vector,
)
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

    The discrete state is position, velocity, acceleration and the sums of the ZMP
    error, (2,) each. Outputs depend on the state alone.
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
        still: Vector = np.zeros(2)
        self._derivatives = [
            declare_state_output(self, name, value)
            for name, value in (
                ("com", rest),
                ("com_velocity", still),
                ("com_acceleration", still),
            )
        ]
        self._error = int(self.DeclareDiscreteState(rest_error_sum(self._gains, rest)))
        self._zmp_preview = self.DeclareVectorInputPort(
            "zmp_preview", 2 * (self._gains.horizon + 1)
        )
        self._reset = self.DeclareVectorInputPort("reset", 5)
        self.DeclareVectorOutputPort(
            "zmp",
            2,
            timed(self, self._calc_zmp),
            prerequisites_of_calc={self.xd_ticket()},
        )
        self.DeclarePeriodicDiscreteUpdateEvent(
            period_sec=params.period, offset_sec=0.0, update=timed(self, self._update)
        )

    @property
    def gains(self) -> PreviewGains:
        """The law; its `horizon` gives the size of `zmp_preview`."""
        return self._gains

    def _calc_zmp(self, context: Context, output: BasicVector) -> None:
        set_vector(output, self._motion(context)[0] @ self._gains.C)

    def _motion(self, context: Context) -> tuple[Vector, Vector]:
        held = [context.get_discrete_state(i).value() for i in self._derivatives]
        return np.array(held).T, context.get_discrete_state(self._error).value()

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        state, error_sum = self._motion(context)
        zmp_preview = eval_vector(self._zmp_preview, context).reshape(2, -1)
        if self._reset.HasValue(context):
            reset = eval_vector(self._reset, context)
            if reset[0] > 0.5:
                state = np.column_stack([reset[1:3], reset[3:5], np.zeros(2)])
                error_sum = rest_error_sum(self._gains, zmp_preview[:, 0])
        state, error_sum, _ = preview_step(self._gains, state, error_sum, zmp_preview)
        for index, derivative in zip(self._derivatives, state.T, strict=True):
            set_state(discrete, index, derivative)
        set_state(discrete, self._error, error_sum)
