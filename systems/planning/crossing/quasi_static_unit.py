"""FU in its quasi-static form: Eqs. 6 to 8 in place of Eqs. 10 to 13.

Phase 2 begins with the CoM over the rear foot and ends with it over the front one, so
that there are two configurations for one step: the waist is back and as high as the
front leg reaches, then ahead and as high as the rear leg does. Both feet together
carry in between. The leg that carries alone before and after is loaded with the whole
weight, and how far its knee is ahead of the CoM decides whether the knee can.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.obstacle import Feasibility, KeyConfiguration
from footfall.models.values.validation import RIGHT_ANGLE, Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feasibility_unit import (
    SLACKS,
    Checked,
    FeasibilityParams,
    Mask,
    check_about,
    failing,
    step_lengths,
)
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.whole_body.leg_model import LegModel


@dataclass(kw_only=True)
class QuasiStaticCrossingParams(Parameters):
    """How an obstacle is stepped over with the CoM always over what stands."""

    single_support: float = number(3.0, "s", least=0.05, most=60.0)
    """Phases 1 and 3, s."""
    double_support: float = number(3.0, "s", least=0.05, most=60.0)
    """Phase 2 and the double supports about the crossing, s (obstacle paper: 15)."""
    walk_single_support: float = number(1.2, "s", least=0.05, most=60.0)
    """One foot in the air on free ground, s."""
    walk_double_support: float = number(1.8, "s", least=0.05, most=60.0)
    """The CoM goes from foot to foot on free ground, s."""
    rest: float = number(0.15, "s", least=0.0, most=60.0)
    """Before a foot lifts the CoM has been over the other one for this long, s."""
    com_begin: float = number(0.125, "m")
    """CoM ahead of the rear ankle as phase 2 begins, m: on the toes' side, where the
    way over is short and the bent knee has little to carry."""
    com_end: float = number(0.0, "m")
    """CoM ahead of the front ankle as phase 2 ends, m; behind the middle of the sole,
    for the rear leg must reach."""
    waist_roll: float = number(0.10, "rad", least=0.0, below=RIGHT_ANGLE)
    """How far the pelvis rolls to raise the hip of the foot over the obstacle, rad."""
    lean: float = number(0.3, "rad", least=0.0, below=RIGHT_ANGLE)
    """Forward pitch of the pelvis as phase 2 ends, rad: with the arms it holds the
    waist back from the CoM, which keeps the front knee near the load."""
    arms: float = number(0.8, "rad", least=0.0)
    """How far the shoulders pitch forward by then, rad."""
    margin: float = number(0.02, "m", least=0.0)
    """Kept by the CoM from the edges of what stands, m."""
    waist_travel: float = number(0.015, "m", least=0.0)
    """How far the waist may be from where it was meant to be over the CoM, m."""
    knee_margin: float = number(0.1, "rad", least=0.0)
    """How far the knees keep off their straightest, rad: they move slowly."""
    sampling: float = number(0.02, "s", least=1e-3, most=1.0)
    """Of the whole-body motion that is planned, s."""
    friction: float = number(0.6, above=0.0, most=10.0, shared="parameters.friction")
    """mu that the static-stability polygons are computed with."""
    torque_share: float = number(0.95, above=0.0, most=10.0)
    """Share of a joint's effort limit that standing may take."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.rest < min(self.double_support, self.walk_double_support):
            raise ValueError(
                f"rest: must be shorter than the double supports, got {self.rest:g} s"
            )


@dataclass(frozen=True)
class Balance:
    """What the line model needs to know of the whole body."""

    waist_begin: float
    """Waist ahead of the CoM as phase 2 begins, m."""
    waist_end: float
    """Waist ahead of the CoM as phase 2 ends, m."""
    weight: float
    """N."""
    knee_effort: float
    """What a knee may carry, Nm."""


def quasi_static_unit(
    section: Section,
    walking_waist: float,
    leg: LegModel,
    params: FeasibilityParams,
    quasi: QuasiStaticCrossingParams,
    balance: Balance,
) -> Feasibility:
    """The least step with a configuration for Eq. 6 and one for Eq. 8.

    Of each the highest waist is taken: the straighter the leg that carries, the less
    has its knee to carry.

    Args:
        section: the obstacle: o_w, o_h.
        walking_waist: height of the hips above the ground in walking, m.
        leg: the legs.
        params: margins and increments.
        quasi: where the CoM is.
        balance: of the whole body.

    Returns:
        The key configuration with its end, or the constraint that none meets.
    """
    x0, x1, top = section.inflated(params.s_w, params.s_h)
    inflated = Section(x1 - x0, top)
    toe, heel = leg.outline.toe, leg.outline.heel
    sole = leg.sole
    for equation, place in ((6, quasi.com_begin), (8, quasi.com_end)):
        inside = min(sole.toe - place, place + sole.heel)
        if inside < quasi.margin - 1e-9:
            return Feasibility(
                constraint=f"Eq. {equation}: the CoM is to be {inside:.3f} m inside "
                f"the sole, less than {quasi.margin:.3f} m"
            )
    least = toe + heel + inflated.width
    shortest = least + params.step_increment
    if shortest > params.max_step_length + 1e-9:
        return Feasibility(
            constraint=f"the obstacle is {section.width:.2f} m wide: a step over it is "
            f"{shortest:.2f} m long at least, more than {params.max_step_length:.2f} m"
        )
    heights = np.arange(
        walking_waist, params.lowest_waist - 1e-9, -params.height_increment
    )
    tried: dict[int, list[tuple[Checked, Vector]]] = {6: [], 8: []}
    possible = {6: False, 8: False}
    for lengths in step_lengths(least, params):
        X, share, Z = np.meshgrid(lengths, SLACKS, heights, indexing="ij")
        front = toe + share * (X - least)
        ends: list[tuple[Vector, Mask]] = []
        for equation, com, ahead, carrier in (
            (6, quasi.com_begin + np.zeros(X.size), balance.waist_begin, 0),
            (8, X.ravel() + quasi.com_end, balance.waist_end, 1),
        ):
            checked = check_about(
                inflated,
                X.ravel(),
                com + ahead,
                Z.ravel(),
                front.ravel(),
                leg,
                quasi.waist_travel,
                params.joint_margin,
            )
            load = balance.weight * (checked.knees[:, carrier] - com)
            fine, _ = _acceptable(checked, load, params, quasi, balance, section)
            possible[equation] |= bool(fine.any())
            tried[equation].append((checked, load))
            ends.append(((com + ahead).reshape(X.shape), fine.reshape(X.shape)))
        both = ends[0][1].any(axis=2) & ends[1][1].any(axis=2)
        if both.any():
            i, j = np.unravel_index(int(np.argmax(both)), both.shape)
            begin, end = (float(heights[np.argmax(fine[i, j])]) for _, fine in ends)
            hips = [float(waist[i, j, 0]) for waist, _ in ends]
            where = float(front[i, j, 0] - x0)
            return Feasibility(
                KeyConfiguration(float(lengths[i]), hips[0], begin, where, hips[1], end)
            )
    for equation, foot in ((6, "rear"), (8, "front")):
        if possible[equation]:
            continue
        parts, loads = zip(*tried[equation], strict=True)
        every = Checked(*map(np.concatenate, zip(*parts, strict=True)))
        load = np.concatenate(loads)
        _, reason = _acceptable(every, load, params, quasi, balance, section)
        return Feasibility(
            constraint=f"Eq. {equation}, the CoM over the {foot} foot: {reason}"
        )
    return Feasibility(
        constraint="Eqs. 6 and 8: no one step length allows the CoM over either foot "
        f"above an obstacle {section.height:.2f} m high"
    )


def _acceptable(
    checked: Checked,
    load: Vector,
    params: FeasibilityParams,
    quasi: QuasiStaticCrossingParams,
    balance: Balance,
    section: Section,
) -> tuple[Mask, str]:
    """Which configurations will do, (n,), and why none does."""
    free: Mask = checked.gap > 0.0
    if not free.any():
        return free, failing(checked, params.joint_margin, section)
    most = quasi.torque_share * balance.knee_effort
    fine: Mask = free & (load <= most)
    if not fine.any():
        return fine, (
            f"the knee would carry {load[free].min():.0f} Nm at least, more than "
            f"{most:.0f} Nm"
        )
    return fine, ""
