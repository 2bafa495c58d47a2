"""Pushes on a body: forces that act for a while."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.common.value import Value
from pydrake.multibody.math import SpatialForce
from pydrake.multibody.plant import ExternallyAppliedSpatialForce
from pydrake.multibody.tree import BodyIndex
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.timing import timed


@dataclass(frozen=True)
class Push:
    """One push."""

    body: BodyIndex
    time: float
    """When it begins, s."""
    duration: float
    """How long it lasts, s."""
    force: Vector
    """In W, (3,), N."""
    p_BQ: Vector
    """Where it acts, in the body's frame, (3,), m."""


class Pusher(LeafSystem):
    """Applies pushes to a plant.

    .. pydrake_system::

        name: Pusher
        output_ports:
        - spatial_forces

    - `spatial_forces`: what acts now, abstract list of ExternallyAppliedSpatialForce
      for a MultibodyPlant's `applied_spatial_force` port.
    """

    def __init__(self, pushes: Sequence[Push]) -> None:
        """Declares the port.

        Args:
            pushes: in any order.
        """
        super().__init__()
        self._pushes = tuple(pushes)
        calc: Callable[..., None] = timed(self, self._calc)
        self.DeclareAbstractOutputPort(
            "spatial_forces",
            lambda: Value[list[ExternallyAppliedSpatialForce]](),
            calc,
            prerequisites_of_calc={self.time_ticket()},
        )

    def _calc(
        self, context: Context, output: Value[list[ExternallyAppliedSpatialForce]]
    ) -> None:
        now = context.get_time()
        forces = []
        nothing: Vector = np.zeros(3)
        for push in self._pushes:
            if push.time <= now < push.time + push.duration:
                force = ExternallyAppliedSpatialForce()
                force.body_index = push.body
                force.p_BoBq_B = push.p_BQ
                force.F_Bq_W = SpatialForce(tau=nothing, f=push.force)
                forces.append(force)
        output.set_value(forces)
