"""A point that is fixed to a body, in the world: from where a sensor looks."""

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_abstract, set_vector
from footfall.systems.timing import timed


class MountedPoint(LeafSystem):
    """Tells where a point of a body is.

    .. pydrake_system::

        name: MountedPoint
        input_ports:
        - body_poses
        output_ports:
        - position

    - `body_poses`: X_WB of every body, list[RigidTransform].
    - `position`: p_WP, (3,), m.
    """

    def __init__(self, body: int, p_BP: Vector) -> None:
        """Declares the ports.

        Args:
            body: index of the body in `body_poses`.
            p_BP: the point in it, (3,), m.
        """
        super().__init__()
        self._body = body
        self._p_BP: Vector = np.array(p_BP, dtype=np.float64)
        self._poses = self.DeclareAbstractInputPort(
            "body_poses", AbstractValue.Make([RigidTransform()])
        )
        self.DeclareVectorOutputPort(
            "position",
            3,
            timed(self, self._calc),
            prerequisites_of_calc={self._poses.ticket()},
        )

    def _calc(self, context: Context, position: BasicVector) -> None:
        X_WB = eval_abstract(self._poses, context, list)[self._body]
        set_vector(position, X_WB.multiply(self._p_BP))
