"""Fig. 2: for which step lengths and waist heights an obstacle can be straddled.

The obstacle paper draws, for the plane model of a biped, where a configuration of the
double support exists: at the end of phase 1, within phase 2, at the start of phase 3
under quasi-static balance, and dynamically.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feasibility_unit import check_double_support
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.whole_body.leg_model import LegModel

SHARES = np.linspace(0.0, 1.0, 9)
"""Of the room between the feet, at which the obstacle is tried."""


@dataclass(frozen=True, eq=False)
class FeasibilityMaps:
    """True where a configuration exists; rows are waist heights, columns step lengths.

    F_W is the length of the foot that carries; the CoM is taken over the waist.
    """

    X_ads: Vector
    """Step lengths, (n,), m."""
    Z_hds: Vector
    """Waist heights, (m,), m."""
    begin: Vector
    """Eq. 6, -F_W / 2 <= c_x(T^P1) <= F_W / 2: the CoM over the rear foot as a
    quasi-static phase 2 begins, (m, n)."""
    within: Vector
    """Eq. 7, -F_W / 2 <= c_x(t) <= X_ads + F_W / 2: the CoM over or between the feet,
    (m, n)."""
    end: Vector
    """Eq. 8, X_ads - F_W / 2 <= c_x(T^P2) <= X_ads + F_W / 2: the CoM over the front
    foot as a quasi-static phase 2 ends, (m, n)."""
    dynamic: Vector
    """Eq. 22, X_hds = delta_DS X_ads: the waist of a dynamic crossing, (m, n). The ZMP
    of phase 2 (Eqs. 10 to 12, as Eqs. 6 to 8 with p_x for c_x) is not evaluated here:
    no motion is known yet. It is that of the motion, see `refusal_of`."""

    @property
    def quasi_static(self) -> Vector:
        """Where a quasi-static phase 2 can both begin and end, (m, n)."""
        return self.begin * self.end


def feasibility_maps(
    section: Section,
    leg: LegModel,
    X_ads: Vector,
    Z_hds: Vector,
    delta_ds: float = 0.5,
    samples: int = 9,
) -> FeasibilityMaps:
    """Computes the feasibility maps of a robot's legs (obstacle paper, Fig. 2).

    Args:
        section: the obstacle, with its margins where they are to be kept.
        leg: the legs.
        X_ads: step lengths, (n,), m.
        Z_hds: waist heights, (m,), m.
        delta_ds: delta_DS of Eq. 22.
        samples: places of the waist that are tried a map.
    """
    sole = leg.sole
    over = np.linspace(-sole.heel, sole.toe, samples)

    def exists(waist: Vector) -> Vector:
        """Whether one of the places of the waist (n, k), m, and obstacle will do."""
        X, Z, _, share = np.meshgrid(
            X_ads, Z_hds, np.arange(waist.shape[1]), SHARES, indexing="ij"
        )
        hips = np.broadcast_to(waist[:, None, :, None], X.shape)
        room = X - leg.outline.toe - leg.outline.heel - section.width
        front = leg.outline.toe + share * room
        checked = check_double_support(
            section, X.ravel(), hips.ravel(), Z.ravel(), front.ravel(), leg
        )
        fine = (checked.reached > 0.5) & (checked.limits <= 0.0).all(axis=1)
        fine &= (checked.gap > 0.0) & (room.ravel() >= 0.0)
        return np.asarray(fine.reshape(X.shape).any(axis=(2, 3)).T, dtype=np.float64)

    rear = np.broadcast_to(over, (len(X_ads), samples))
    between = np.array(
        [np.linspace(-sole.heel, x + sole.toe, 2 * samples) for x in X_ads]
    )
    return FeasibilityMaps(
        X_ads,
        Z_hds,
        exists(rear),
        exists(between),
        exists(X_ads[:, None] + over),
        exists(delta_ds * X_ads[:, None]),
    )
