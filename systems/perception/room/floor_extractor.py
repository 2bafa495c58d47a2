"""The floor extraction as a system."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.perception import PointCloud
from pydrake.systems.framework import BasicVector, Context, LeafSystem, ValueProducer

from footfall.models.values.room import FloorEstimate
from footfall.models.values.vector import Vector
from footfall.systems.perception.depth_cloud import point_cloud
from footfall.systems.perception.room.floor import FloorParams, extract_floor
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.timing import timed


class _Split(NamedTuple):
    """Both parts of a cloud."""

    floor: FloorEstimate
    obstacles: Vector
    """(n, 3), m."""


class FloorExtractor(LeafSystem):
    """Splits a cloud into the floor and the points of the obstacles (paper, Sec. 2.2).

    .. pydrake_system::

        name: FloorExtractor
        input_ports:
        - cloud
        - viewpoint
        output_ports:
        - floor
        - obstacles
        - inlier_share

    - `cloud`: in W, PointCloud, m.
    - `viewpoint`: p_WCamera, (3,), m, where it was seen from.
    - `floor`: in W, FloorEstimate; without a plane where none is in view.
    - `obstacles`: points above the floor in W, PointCloud, m.
    - `inlier_share`: share of the cloud's points that lie on the floor, (1,), no unit;
      0 where there is none.
    """

    def __init__(self, params: FloorParams | None = None) -> None:
        """Declares the ports.

        Args:
            params: what counts as the floor; None for the paper's.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        self._params = params or FloorParams()
        self._params.validate()
        self._cloud = self.DeclareAbstractInputPort(
            "cloud", AbstractValue.Make(PointCloud(0))
        )
        self._viewpoint = self.DeclareVectorInputPort("viewpoint", 3)
        calc_split: Callable[..., None] = timed(self, self._calc_split)
        entry = self.DeclareCacheEntry(
            "split",
            ValueProducer(
                lambda: AbstractValue.Make(_Split(FloorEstimate(), np.zeros((0, 3)))),
                calc_split,
            ),
            {self._cloud.ticket(), self._viewpoint.ticket()},
        )
        # An entry that the System held would keep it alive for ever.
        self._split = entry.cache_index()
        ticket = {entry.ticket()}
        calc_floor: Callable[..., None] = timed(self, self._calc_floor)
        calc_obstacles: Callable[..., None] = timed(self, self._calc_obstacles)
        self.DeclareAbstractOutputPort(
            "floor",
            lambda: AbstractValue.Make(FloorEstimate()),
            calc_floor,
            prerequisites_of_calc=ticket,
        )
        self.DeclareAbstractOutputPort(
            "obstacles",
            lambda: AbstractValue.Make(PointCloud(0)),
            calc_obstacles,
            prerequisites_of_calc=ticket,
        )
        self.DeclareVectorOutputPort(
            "inlier_share",
            1,
            timed(self, self._calc_inlier_share),
            prerequisites_of_calc=ticket,
        )

    def _calc_split(self, context: Context, split: AbstractValue) -> None:
        cloud = eval_abstract(self._cloud, context, PointCloud)
        points: Vector = cloud.xyzs().T.astype(float)
        points = points[np.all(np.isfinite(points), axis=1)]
        viewpoint = eval_vector(self._viewpoint, context)
        split.set_value(_Split(*extract_floor(points, viewpoint, self._params)))

    def _get(self, context: Context) -> _Split:
        split = self.get_cache_entry(self._split).Eval(context)
        assert isinstance(split, _Split)
        return split

    def _calc_floor(self, context: Context, floor: AbstractValue) -> None:
        floor.set_value(self._get(context).floor)

    def _calc_obstacles(self, context: Context, obstacles: AbstractValue) -> None:
        obstacles.set_value(point_cloud(self._get(context).obstacles))

    def _calc_inlier_share(self, context: Context, share: BasicVector) -> None:
        floor = self._get(context).floor.floor
        set_vector(share, np.array([floor.inlier_share if floor else 0.0]))
