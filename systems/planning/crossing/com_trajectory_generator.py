"""CWTG1: the horizontal CoM of the single mass whose ZMP follows its reference.

Obstacle paper, Sec. III-C2. Three forms: Kajita's preview control and the analytic
window of Eqs. 16 to 18, both of a cart of constant height (Eq. 15), and the form that
is exact for a CoM whose height varies and knows the whole plan, which is the better
way and the default.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    ComMotion,
    ZmpPreviewParams,
    generate,
    preview_gains,
    rest_state,
)
from footfall.systems.balance.zmp_tracking import generate_varying_height
from footfall.systems.balance.zmp_window import generate_by_window, window_gains

FORMS = ("exact", "preview", "window")
FILTER_FORMS = ("exact", "preview")

ComTracker: TypeAlias = Callable[[Vector, Vector], ComMotion]
"""From a ZMP reference, (n, 2), m, and height factors, (n,), s^2, to the motion."""


def com_tracker(
    form: str,
    params: ZmpPreviewParams,
    start: Vector,
    weight: Vector | None = None,
) -> ComTracker:
    """CWTG1 in one of its forms.

    Args:
        form: one of `FORMS`; "preview" and "window" take the height from params and
            do not look at the height factors.
        params: period, height and weights.
        start: where the CoM rests, (2,), m.
        weight: how much the ZMP error counts at each tick, (n,), for "exact"; 1 if
            None.

    Raises:
        ValueError: there is no such form, or a parameter is out of range.
    """
    if form == "exact":
        return lambda zmp, factor: generate_varying_height(
            zmp, factor, params, rest_state(start), weight
        )
    if form == "preview":
        gains = preview_gains(params)
        return lambda zmp, factor: generate(gains, zmp, rest_state(start))
    if form == "window":
        law = window_gains(params)

        def by_window(zmp: Vector, factor: Vector) -> ComMotion:
            # It begins at rest on the first reference.
            before: Vector = np.vstack([start[None], zmp[1:]])
            return generate_by_window(law, before, params)

        return by_window
    raise ValueError(f"form: must be one of {', '.join(FORMS)}, got {form!r}")
