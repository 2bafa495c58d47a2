"""Clusters and boxes as a system: the last step of perception."""

from collections.abc import Callable

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.perception import PointCloud
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.room import Environment, FloorEstimate
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.boxes import (
    ObstacleClustererParams,
    find_boxes,
)
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


class ObstacleClusterer(LeafSystem):
    """Turns the points above the floor into boxes: the environment (paper, Sec. 2.3).

    .. pydrake_system::

        name: ObstacleClusterer
        input_ports:
        - floor
        - obstacles
        - viewpoint
        output_ports:
        - environment

    - `floor`: in W, FloorEstimate.
    - `obstacles`: points above the floor in W, PointCloud, m.
    - `viewpoint`: p_WCamera, (3,), m, where they were seen from.
    - `environment`: floor and boxes in W, Environment; without boxes and with the
      reason where there is no floor.
    """

    def __init__(self, params: ObstacleClustererParams | None = None) -> None:
        """Declares the ports.

        Args:
            params: how clusters are told apart and bounded; None for the defaults.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        self._params = params or ObstacleClustererParams()
        self._params.validate()
        self._floor = self.DeclareAbstractInputPort(
            "floor", AbstractValue.Make(FloorEstimate())
        )
        self._obstacles = self.DeclareAbstractInputPort(
            "obstacles", AbstractValue.Make(PointCloud(0))
        )
        self._viewpoint = self.DeclareVectorInputPort("viewpoint", 3)
        calc_environment: Callable[..., None] = timed(self, self._calc_environment)
        self.DeclareAbstractOutputPort(
            "environment",
            lambda: AbstractValue.Make(Environment()),
            calc_environment,
            prerequisites_of_calc={
                self._floor.ticket(),
                self._obstacles.ticket(),
                self._viewpoint.ticket(),
            },
        )

    def _calc_environment(self, context: Context, environment: AbstractValue) -> None:
        estimate = eval_abstract(self._floor, context, FloorEstimate)
        if estimate.floor is None:
            environment.set_value(Environment(reason=estimate.reason))
            return
        cloud = eval_abstract(self._obstacles, context, PointCloud)
        points: Vector = cloud.xyzs().T.astype(np.float64)
        viewpoint = eval_vector(self._viewpoint, context)
        boxes = find_boxes(points, estimate.floor, viewpoint, self._params)
        environment.set_value(Environment(estimate.floor, boxes))
