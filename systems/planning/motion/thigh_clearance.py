"""What keeps a folded thigh off the pelvis while a foot swings high.

The pelvis sways over the foot that stands. A leg that is folded high would have to
reach down and outwards from it and turn its thigh against the pelvis. The foot
therefore swings in a bow towards the other one, and the pelvis rolls to raise the hip
on its side, which also leans the trunk over the foot that stands.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from footfall.models.values.feet import Foot
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import SIDE
from footfall.systems.planning.motion.step_timing import along_keys


class HighSwing(NamedTuple):
    """A swing of a foot in time."""

    foot: Foot
    lift: float
    """When it leaves the ground, s."""
    land: float
    """When it is down again, s."""
    high: bool
    """Whether it is high enough for the thigh to come near the pelvis."""


def inward_bow(u: Vector) -> Vector:
    """Share of its greatest way aside at which a foot is that swings in a bow.

    16 u^2 (1 - u)^2: 0 at both ends without velocity, 1 in the middle.

    Args:
        u: part of the duration, 0 to 1.
    """
    bow: Vector = 16.0 * (u * (1.0 - u)) ** 2
    return bow


def drawn_inwards(positions: Vector, foot: Foot, yaw: float, inward: float) -> Vector:
    """Bows a swing towards the other foot.

    Args:
        positions: p_WF from lift-off to touch-down, (n, 3), m.
        foot: which foot swings.
        yaw: heading across which the bow goes, rad.
        inward: its greatest way aside, m.

    Returns:
        The positions in the bow, (n, 3), m.
    """
    bow = inward_bow(np.linspace(0.0, 1.0, len(positions)))
    aside = -SIDE[foot] * np.array([-np.sin(yaw), np.cos(yaw), 0.0])
    drawn: Vector = positions + inward * np.outer(bow, aside)
    return drawn


def raised_hip(
    time: Vector, swings: Sequence[HighSwing], end: float, roll: float
) -> Vector:
    """Roll of the pelvis that raises the hip of every foot that swings high.

    It is held from lift-off to touch-down and changes while both feet stand.

    Args:
        time: (n,), s.
        swings: in order.
        end: when it is level again, s.
        roll: how far it rolls, rad.

    Returns:
        About the heading, (n,), rad; positive raises the left hip.
    """
    keys = [(0.0, np.zeros(1))]
    for swing in swings:
        raised = np.array([SIDE[swing.foot] * roll if swing.high else 0.0])
        keys += [(swing.lift, raised), (swing.land, raised)]
    keys.append((end, np.zeros(1)))
    return along_keys(time, keys, eased=True)[:, 0]
