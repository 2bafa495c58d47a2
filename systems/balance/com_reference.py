"""Joins the preview controller's horizontal CoM and the planned height."""

import numpy as np
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.systems.ports import eval_vector, set_vector
from footfall.systems.timing import timed


class ComReference(LeafSystem):
    """One CoM reference from its horizontal and its vertical part.

    .. pydrake_system::

        name: ComReference
        input_ports:
        - com
        - com_velocity
        - com_acceleration
        - com_height
        output_ports:
        - com_reference

    - `com`, `com_velocity`, `com_acceleration`: horizontal p_WCom, v_WCom and a_WCom,
      (2,) each, m, m/s, m/s^2.
    - `com_height`: z of p_WCom, its rate and its acceleration, (3,).
    - `com_reference`: p_WCom, v_WCom and a_WCom, (9,), m, m/s, m/s^2.
    """

    def __init__(self) -> None:
        """Declares the ports."""
        super().__init__()
        self._horizontal = [
            self.DeclareVectorInputPort(name, 2)
            for name in ("com", "com_velocity", "com_acceleration")
        ]
        self._height = self.DeclareVectorInputPort("com_height", 3)
        self.DeclareVectorOutputPort(
            "com_reference",
            9,
            timed(self, self._calc),
            prerequisites_of_calc={
                port.ticket() for port in (*self._horizontal, self._height)
            },
        )

    def _calc(self, context: Context, output: BasicVector) -> None:
        reference = np.empty((3, 3))
        for row, port in zip(reference, self._horizontal, strict=True):
            row[:2] = eval_vector(port, context)
        reference[:, 2] = eval_vector(self._height, context)
        set_vector(output, reference.ravel())
