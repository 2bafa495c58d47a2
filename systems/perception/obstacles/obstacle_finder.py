"""Eyes: what stands in the way, from the robot's own scan."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.perception import PointCloud
from pydrake.systems.framework import (
    BasicVector,
    Context,
    EventStatus,
    LeafSystem,
    State,
)

from footfall.models.values.obstacle import ObstacleMap
from footfall.models.values.validation import require_at_least
from footfall.models.values.vector import Vector
from footfall.systems.held_value import HeldValue
from footfall.systems.perception.obstacles.obstacles import (
    ObstacleFinderParams,
    find_obstacles,
)
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.thinking import Thought, ready_time
from footfall.systems.timing import timed


@dataclass(frozen=True, eq=False)
class _Seen(Thought):
    """State: the map of the last finished sweep."""

    map: ObstacleMap = field(default_factory=ObstacleMap)
    sweeps: int = 0
    """Number of sweeps finished then."""


class ObstacleFinder(LeafSystem):
    """Finds what stands on the floor, once a sweep.

    That takes time: what a sweep shows is known `latency` after it was finished; a
    sweep that is finished meanwhile waits.

    .. pydrake_system::

        name: ObstacleFinder
        input_ports:
        - cloud
        - viewpoint
        - sweep
        output_ports:
        - obstacle_map
        - sweep

    - `cloud`: pydrake PointCloud of the last finished sweep in W, m.
    - `viewpoint`: p_WSensor, (3,), m, where it was seen from.
    - `sweep` (input): how many sweeps are finished, (1,).
    - `obstacle_map`: abstract ObstacleMap in W.
    - `sweep` (output): how many sweeps were finished when its sweep was, (1,).
    """

    def __init__(
        self, params: ObstacleFinderParams | None = None, latency: float = 0.0
    ) -> None:
        """Declares ports, state and the update.

        Args:
            params: see there; None for the defaults.
            latency: from a finished sweep to what it shows, s.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        require_at_least("latency", latency, 0.0, "s")
        self._latency = latency
        self._params = params or ObstacleFinderParams()
        self._params.validate()
        self._cloud = self.DeclareAbstractInputPort(
            "cloud", AbstractValue.Make(PointCloud(0))
        )
        self._viewpoint = self.DeclareVectorInputPort("viewpoint", 3)
        self._sweep = self.DeclareVectorInputPort("sweep", 1)
        self._state = HeldValue(self, _Seen())
        ticket = {self._state.ticket}
        calc_map: Callable[..., None] = timed(self, self._calc_map)
        self.DeclareAbstractOutputPort(
            "obstacle_map",
            lambda: AbstractValue.Make(ObstacleMap()),
            calc_map,
            prerequisites_of_calc=ticket,
        )
        self.DeclareVectorOutputPort(
            "sweep", 1, timed(self, self._calc_sweep), prerequisites_of_calc=ticket
        )
        self.DeclarePeriodicUnrestrictedUpdateEvent(
            self._params.period, 0.0, timed(self, self._look)
        )

    def _look(self, context: Context, state: State) -> EventStatus:
        was, time = self._state.get(context), context.get_time()
        now = was.at(time)
        sweeps = int(eval_vector(self._sweep, context)[0])
        if now.coming is None and sweeps > now.sweeps:
            cloud = eval_abstract(self._cloud, context, PointCloud)
            points: Vector = cloud.xyzs().T.astype(np.float64)
            viewpoint = eval_vector(self._viewpoint, context)
            found = find_obstacles(points, viewpoint, self._params)
            seen = _Seen(replace(found, sensed_at=time), sweeps)
            ready = ready_time(time, self._latency, self._params.period)
            now = now.until(ready, seen).at(time)
        if now is was:
            return EventStatus.DidNothing()
        self._state.set(state, now)
        return EventStatus.Succeeded()

    def _calc_map(self, context: Context, output: AbstractValue) -> None:
        output.set_value(self._state.get(context).map)

    def _calc_sweep(self, context: Context, output: BasicVector) -> None:
        sweeps: Vector = np.array([self._state.get(context).sweeps], dtype=np.float64)
        set_vector(output, sweeps)
