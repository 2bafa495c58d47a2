"""A foot that has come to rest on ground whose place is known: legs drift no more.

Each step carries a little of the tilt's error into the height. Ground that was seen or
walked on before has a height of its own: where a sole lies on it, the sole's place
across it is known, whatever the legs say.
"""

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.estimation.base_estimate import BaseEstimate
from footfall.systems.estimation.filter_params import SIZE, Rows
from footfall.systems.estimation.invariant_ekf import shifted


def stand_on(
    estimate: BaseEstimate,
    i: int,
    normal: Vector,
    distance: float,
    deviation: float,
    gate: float,
) -> BaseEstimate:
    """Corrects the estimate by a sole that lies on a known plane n . x = c.

    The measured z = n . d - c is, in the error of the right-invariant filter, to first
    order (d x n) . xi_R + n . xi_d. A sole that is farther off than the gate allows
    stands on something else: it corrects nothing.

    Args:
        estimate: in which foot i stands.
        i: 0 the left foot, 1 the right.
        normal: n of the plane, in W, (3,).
        distance: c, m.
        deviation: of the sole from the plane, m.
        gate: most that z^2 may be of its variance.
    """
    d = estimate.p_WF[i]
    H = np.zeros(SIZE)
    H[Rows.R] = np.cross(d, normal)
    H[Rows.d[i]] = normal
    off = float(normal @ d) - distance
    HP = H @ estimate.covariance
    variance = float(HP @ H) + deviation**2
    if off**2 > gate * variance:
        return estimate
    gain = HP / variance
    return shifted(estimate, -off * gain, np.outer(gain, HP))
