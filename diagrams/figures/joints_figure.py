"""Torques and speeds of all joints, of those near their limits in colour."""

from collections.abc import Mapping, Sequence
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import (
    LIMIT,
    OTHER_JOINTS,
    SIDE_JOINTS,
    UNIMPORTANT,
)
from footfall.diagrams.figures.figure_parts import (
    legend_outside,
    new_figure,
    set_title,
    shade_activities,
)
from footfall.diagrams.figures.time_axis import fold_time
from footfall.diagrams.run_data import RunData
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector

SHOWN_JOINTS = 6
"""How many joints have a colour of their own; the others are grey."""


def joints_figure(data: RunData) -> Figure:
    """Torques and speeds of all joints as shares of their limits."""
    figure = new_figure(11.0, 7.0)
    torques, speeds = figure.subplots(2, 1, sharex=True)
    logged = data.signal("plant.net_actuation")
    limits = data.limits
    series: dict[str, Vector] = {}
    torque_time = np.zeros(0)
    if logged is not None:
        samples = logged.to_numpy(dtype=np.float64)
        torque_time = samples[:, 0]
        series = dict(zip(limits.torque, samples[:, 1:].T, strict=True))
    torque = {joint: values / limits.torque[joint] for joint, values in series.items()}
    speed = {joint: v / limits.speed[joint] for joint, v in data.velocities.items()}
    shown = [*_extreme_joints(torque), *_extreme_joints(speed)]
    legs = data.run.scenario.robot.model().leg_joints
    styles = joint_styles(list(dict.fromkeys(shown)), legs)
    _shares(torques, data, torque_time, torque, styles, "torque / limit")
    _shares(speeds, data, data.motion.time, speed, styles, "speed / limit")
    fold_time((torques, speeds), data)
    for ax in (torques, speeds):
        legend_outside(ax)
    set_title(figure, data, "joints")
    return figure


def joint_styles(
    joints: Sequence[str], legs: Mapping[Foot, tuple[str, ...]]
) -> dict[str, tuple[str, str]]:
    """Chooses a colour of its side and a line style for every joint, all different.

    Args:
        joints: in the order in which they are given colours.
        legs: the joints of each leg; all others are of no side.
    """
    palettes = (*(SIDE_JOINTS[foot] for foot in FEET), OTHER_JOINTS)
    places = [
        [(color, line) for line in ("-", "--", ":", "-.") for color in palette]
        for palette in palettes
    ]
    styles = [cycle(place) for place in places]
    sides = {joint: i for i, foot in enumerate(FEET) for joint in legs[foot]}
    return {joint: next(styles[sides.get(joint, len(FEET))]) for joint in joints}


def _extreme_joints(shares: Mapping[str, Vector]) -> list[str]:
    """Finds the joints that came nearest to their limits, the nearest first."""
    order = sorted(shares, key=lambda joint: -float(np.abs(shares[joint]).max()))
    return order[:SHOWN_JOINTS]


def _shares(
    ax: Axes,
    data: RunData,
    time: Vector,
    shares: Mapping[str, Vector],
    styles: Mapping[str, tuple[str, str]],
    label: str,
) -> None:
    """Draws the joints nearest to their limits in colour, the others in grey."""
    shade_activities(ax, data)
    extreme = _extreme_joints(shares)
    for joint in shares.keys() - set(extreme):
        ax.plot(time, shares[joint], color=UNIMPORTANT, lw=0.6, zorder=1)
    for joint in extreme:
        peak = float(np.abs(shares[joint]).max())
        ax.plot(
            time,
            shares[joint],
            color=styles[joint][0],
            ls=styles[joint][1],
            lw=0.9,
            label=f"{joint} {peak:.2f}",
        )
    for limit in (-1.0, 1.0):
        ax.axhline(limit, color=LIMIT, lw=1.0, ls="--")
    ax.set_ylim(-1.15, 1.15)
    ax.set_ylabel(label)
    ax.grid(alpha=0.3)
