"""Draws where the CoM may be on a 24 cm step without a hand, on a rail, on a wall.

Run `python tests/systems/balance/study_handrail.py [PICTURE]`; by default it writes
handrail.png to the working folder.
"""

import sys

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle
from pydrake.math import RigidTransform

from footfall.models.robots.jvrc1 import JVRC1
from footfall.systems.balance.contact_wrench_cone import sole_contact
from footfall.systems.balance.convex_polygon import area
from footfall.systems.balance.handrail import hand_contact
from footfall.systems.balance.stability_polygon import static_polygon


def handrail_figure() -> Figure:
    """The three polygons, the soles and the hand from above."""
    sole = JVRC1.sole
    feet = [
        sole_contact(RigidTransform(p), sole.heel, sole.toe, sole.half_width, 0.6)
        for p in ([0.0, 0.095, 0.0], [0.33, -0.095, 0.24])
    ]
    p_WHand = np.array([0.35, -0.45, 1.0])
    rising = np.array([-0.58, 0.0, 0.81])
    wall = np.array([0.0, 1.0, 0.0])
    stances = [
        ("feet alone", feet, "#343a40"),
        (
            "hand on a rising rail",
            [*feet, hand_contact(p_WHand, rising, 0.5, 0.04, 0.04)],
            "#1c7ed6",
        ),
        (
            "hand against a wall",
            [*feet, hand_contact(p_WHand, wall, 0.5, 0.04, 0.04)],
            "#e8590c",
        ),
    ]
    figure = Figure(figsize=(6.4, 7.2), layout="constrained")
    ax = figure.subplots()
    ax.add_patch(Rectangle((0.2, -0.8), 0.6, 1.1, fc="#a0703c", alpha=0.15, lw=0))
    # The widest first, so that the smaller ones lie on top.
    for label, contacts, color in reversed(stances):
        vertices = static_polygon(contacts).vertices
        text = f"{label}: {1e4 * area(vertices):.0f} cm$^2$"
        ax.add_patch(Polygon(vertices, fc=color, alpha=0.25, lw=0))
        ax.add_patch(Polygon(vertices, fill=False, ec=color, lw=2.0, label=text))
    for contact, where in zip(
        feet, ("left sole, 0 cm", "right sole, 24 cm"), strict=True
    ):
        corners = contact.corners()[:, :2]
        ax.add_patch(Polygon(corners, fc="white", ec="black", lw=1.2, zorder=3))
        ax.annotate(
            where, corners.mean(axis=0), ha="center", va="center", fontsize=9, zorder=4
        )
    ax.plot(*p_WHand[:2], "k*", ms=12, label=f"hand, {100.0 * p_WHand[2]:.0f} cm")
    ax.set_aspect("equal")
    ax.set_xlim(-0.2, 0.72)
    ax.set_ylim(-0.76, 0.24)
    ax.set_xlabel("x [m], the way up")
    ax.set_ylabel("y [m]")
    ax.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=2, fontsize=9)
    ax.set_title("Where the CoM may be at rest on a step of 24 cm")
    return figure


if __name__ == "__main__":
    path = sys.argv[1] if len(sys.argv) > 1 else "handrail.png"
    FigureCanvasAgg(handrail_figure()).print_png(path)
