"""Draws where the CoM may be on a 24 cm step without a hand, on a rail, on a wall.

Run `python tests/systems/balance/study_handrail.py [PICTURE]`; by default it writes
handrail.png to the working folder.
"""

import sys

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from pydrake.math import RigidTransform

from models.jvrc1 import JVRC1
from systems.balance.contact_wrench_cone import sole_contact
from systems.balance.convex_polygon import area
from systems.balance.handrail import hand_contact
from systems.balance.stability_polygon import static_polygon


def handrail_figure() -> Figure:
    """The three polygons, the soles and the hand from above."""
    sole = JVRC1.sole
    feet = [
        sole_contact(RigidTransform(p), sole.heel, sole.toe, sole.half_width, 0.6)
        for p in ([0.0, 0.095, 0.0], [0.33, -0.095, 0.24])
    ]
    p_WHand = np.array([0.35, -0.45, 1.0])
    rising = np.array([-0.58, 0.0, 0.81])
    stances = {
        "feet alone": (feet, "#868e96"),
        "hand on a rising rail": (
            [*feet, hand_contact(p_WHand, rising, 0.5, 0.04, 0.04)],
            "#1c7ed6",
        ),
        "hand against a wall": (
            [*feet, hand_contact(p_WHand, np.array([0.0, 1.0, 0.0]), 0.5, 0.04, 0.04)],
            "#e8590c",
        ),
    }
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    ax = figure.subplots()
    for label, (contacts, color) in stances.items():
        vertices = static_polygon(contacts).vertices
        text = f"{label}, {1e4 * area(vertices):.0f} cm$^2$"
        ax.add_patch(Polygon(vertices, fc=color, ec=color, alpha=0.25, lw=0))
        ax.add_patch(Polygon(vertices, fill=False, ec=color, lw=1.8, label=text))
    for contact in feet:
        ax.add_patch(Polygon(contact.corners()[:, :2], fill=False, ec="black", lw=1.0))
    ax.plot(*p_WHand[:2], "k*", ms=10, label="hand")
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.legend(fontsize=8)
    ax.set_title("static-stability polygon on a step of 24 cm")
    return figure


if __name__ == "__main__":
    path = sys.argv[1] if len(sys.argv) > 1 else "handrail.png"
    FigureCanvasAgg(handrail_figure()).print_png(path)
