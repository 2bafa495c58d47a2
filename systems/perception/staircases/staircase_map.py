"""Map of a staircase, merged scan after scan."""

from dataclasses import dataclass, field, replace

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import (
    BasicVector,
    Context,
    EventStatus,
    LeafSystem,
    State,
)

from footfall.models.values.perceived import PlaneSegmentation, Staircase
from footfall.models.values.validation import require_at_least
from footfall.systems.held_value import HeldValue
from footfall.systems.perception.staircases.staircase_merging import (
    StaircaseMapParams,
    merge_staircase,
)
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.thinking import Thought, ready_time
from footfall.systems.timing import timed


@dataclass(frozen=True, eq=False)
class _Merged(Thought):
    """The state: the staircase, how many sweeps are in it, and the last of them."""

    staircase: Staircase = field(default_factory=Staircase)
    segmentation: PlaneSegmentation = field(default_factory=PlaneSegmentation)
    sweeps: int = 0


class StaircaseMap(LeafSystem):
    """Remembers the staircase over the scans of a robot that climbs it.

    Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4.3: the higher steps "will be fully
    reconstructed after the robot stepping on the lower ones".

    Segmenting and merging take time: what a sweep says is known `latency` after it was
    finished; a sweep that is finished meanwhile waits.

    .. pydrake_system::

        name: StaircaseMap
        input_ports:
        - segmentation
        - sweep
        output_ports:
        - staircase
        - segmentation
        - sweep

    - `segmentation` (input): PlaneSegmentation of the last finished sweep, in W.
    - `sweep` (input): how many sweeps are finished, (1,).
    - `staircase`: Staircase, what all merged sweeps say, in W.
    - `segmentation` (output): the one that was merged last; costs nothing to look at.
    - `sweep` (output): how many sweeps were finished when the one that was merged last
      was, (1,).
    """

    def __init__(
        self, params: StaircaseMapParams | None = None, latency: float = 0.0
    ) -> None:
        """Declares ports, state and the update.

        Args:
            params: parameters; None for the defaults.
            latency: from a finished sweep to what it says, s.

        Raises:
            ValueError: a parameter makes no sense.
        """
        super().__init__()
        require_at_least("latency", latency, 0.0, "s")
        self._latency = latency
        self._params = params or StaircaseMapParams()
        self._params.validate()
        self._segmentation = self.DeclareAbstractInputPort(
            "segmentation", AbstractValue.Make(PlaneSegmentation())
        )
        self._sweep = self.DeclareVectorInputPort("sweep", 1)
        self._state = HeldValue(self, _Merged())
        ticket = {self._state.ticket}
        self.DeclareAbstractOutputPort(
            "staircase",
            lambda: AbstractValue.Make(Staircase()),
            timed(self, self._calc_staircase),  # type: ignore[arg-type]
            prerequisites_of_calc=ticket,
        )
        self.DeclareAbstractOutputPort(
            "segmentation",
            lambda: AbstractValue.Make(PlaneSegmentation()),
            timed(self, self._calc_segmentation),  # type: ignore[arg-type]
            prerequisites_of_calc=ticket,
        )
        self.DeclareVectorOutputPort(
            "sweep",
            1,
            timed(self, self._calc_sweep),
            prerequisites_of_calc=ticket,
        )
        self.DeclarePeriodicUnrestrictedUpdateEvent(
            self._params.period,
            0.0,
            timed(self, self._merge),
        )

    def _merge(self, context: Context, state: State) -> EventStatus:
        was, time = self._state.get(context), context.get_time()
        now = was.at(time)
        sweeps = int(eval_vector(self._sweep, context)[0])
        if now.coming is None and sweeps > now.sweeps:
            found = eval_abstract(self._segmentation, context, PlaneSegmentation)
            seen = replace(found, sensed_at=time)
            known = merge_staircase(now.staircase, seen, self._params)
            ready = ready_time(time, self._latency, self._params.period)
            now = now.until(ready, _Merged(known, seen, sweeps)).at(time)
        if now is was:
            return EventStatus.DidNothing()
        self._state.set(state, now)
        return EventStatus.Succeeded()

    def _calc_segmentation(self, context: Context, output: AbstractValue) -> None:
        output.set_value(self._state.get(context).segmentation)

    def _calc_staircase(self, context: Context, staircase: AbstractValue) -> None:
        staircase.set_value(self._state.get(context).staircase)

    def _calc_sweep(self, context: Context, sweep: BasicVector) -> None:
        set_vector(sweep, np.array([self._state.get(context).sweeps], dtype=np.float64))
