"""The obstacle paper's Fig. 5 of a run: the legs in the plane across the obstacle."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle
from pydrake.multibody.plant import MultibodyPlant

from footfall.diagrams.figures.colors import (
    FLOOR,
    SEEN_THING,
    SIDES,
    TRUE_THING,
    WAIST,
    WANTED,
)
from footfall.diagrams.figures.crossing_data import (
    CrossingData,
    Phases,
    PlannedCrossing,
)
from footfall.diagrams.figures.figure_parts import new_figure, set_title
from footfall.diagrams.run_data import RunData
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.values.feet import Foot
from footfall.models.values.obstacle import KeyConfiguration, Obstacle, across
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import Repairs
from footfall.systems.planning.crossing.leg_clearance import Section, outline_gap
from footfall.systems.planning.whole_body.leg_model import LegOutline
from footfall.systems.planning.whole_body.whole_body_plan import planning_body

STICKS = 14
"""How often the leg is drawn in a phase."""
LOOKED_AT = 151
"""Samples of a phase among which the nearest one is sought."""


class LegSticks(NamedTuple):
    """One leg over time, n samples, in W, m."""

    chain: Vector
    """Hip, knee, ankle, heel and toe, (n, 5, 3)."""
    outline: Vector
    """L_1 to L_7 around the leg below the knee, (n, 8, 3)."""


def stick_diagram(crossing: CrossingData) -> Figure:
    """Fig. 5: a row of three panels an obstacle, from true poses.

    Left and right, the leg that crosses in phase 1 and in phase 3, every stick a
    moment, later ones darker, with the leg's outline where it comes nearest to the
    obstacle. Between them the key configuration: both legs in the middle of phase 2
    against X_ads, X_hds and Z_hds as planned.
    """
    pairs = [
        (plan, index) for plan in crossing.plans for index in range(len(plan.obstacles))
    ]
    figure = new_figure(15.0, 0.9 + 4.4 * len(pairs))
    rows = figure.subplots(len(pairs), 3, sharex=True, sharey=True, squeeze=False)
    data = crossing.data
    robot = data.run.scenario.robot.model()
    plant = robot_alone(robot)
    outline = planning_body(robot, plant).leg.outline
    for axes, (plan, index) in zip(rows, pairs, strict=True):
        phases = plan.phases[index]
        scene = _Plane(crossing, plan, index)
        for ax, name, foot, begin, end in (
            (axes[0], "phase 1", phases.first, phases.begin, phases.touch),
            (axes[2], "phase 3", phases.second, phases.lift, phases.end),
        ):
            scene.draw(ax)
            _draw_phase(ax, name, foot, (begin, end), scene, data, plant, outline)
        scene.draw(axes[1])
        key = plan.keys[index]
        _draw_key(axes[1], phases, key, plan.repairs, scene, data, plant, outline)
    half = 0.42 + max(plan.keys[index].X_ads for plan, index in pairs) / 2.0
    for ax in rows.flat:
        ax.set_aspect("equal")
        ax.set_xlim(-half, half)
        ax.set_ylim(-0.03, 1.0)
        ax.axhline(0.0, color=FLOOR, lw=1.0)
        ax.grid(alpha=0.25)
    for ax in rows[-1]:
        ax.set_xlabel("across the obstacle from its middle [m]")
    for ax in rows[:, 0]:
        ax.set_ylabel("height [m]")
    handles, labels = rows[0, 0].get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside lower center", ncols=len(labels), fontsize=9
    )
    set_title(figure, data, "legs in the plane across the obstacle (Fig. 5)")
    return figure


class _Plane:
    """The plane across one obstacle: x from its true middle, z up."""

    def __init__(
        self, crossing: CrossingData, plan: PlannedCrossing, index: int
    ) -> None:
        self.obstacle: Obstacle = plan.obstacles[index]
        self.margins = crossing.params(plan).feasibility
        box = crossing.true_box(self.obstacle)
        self.x_W = across(self.obstacle.yaw)
        self.origin = self.obstacle.center
        self.true: Section | None = None
        if box is not None:
            self.x_W = crossing.across_box(box, self.obstacle)
            self.origin = box.X_WB.translation()[:2]
            top = float(box.X_WB.translation()[2] + box.size[2] / 2.0)
            self.true = Section(float(box.size[:2].min()), top)

    def to_plane(self, p_W: Vector) -> Vector:
        """(..., 3) in W as (..., 2) in the plane."""
        x = (p_W[..., :2] - self.origin) @ self.x_W
        return np.stack([x, p_W[..., 2]], axis=-1)

    def gaps(self, outline: Vector) -> Vector:
        """Distance of outlines (n, 8, 2) in the plane to the obstacle, (n,), m."""
        section = self.true or Section(self.obstacle.width, self.obstacle.height)
        moved = outline + np.array([section.width / 2.0, 0.0])
        return outline_gap(moved, section)

    def draw(self, ax: Axes) -> None:
        """Draws the obstacle as it is, as it was seen, and with its margins."""
        if self.true is not None:
            half = self.true.width / 2.0
            ax.add_patch(
                Rectangle(
                    (-half, 0.0),
                    2.0 * half,
                    self.true.height,
                    fc=TRUE_THING,
                    ec="none",
                    label="obstacle",
                )
            )
        seen = float((self.obstacle.center - self.origin) @ self.x_W)
        s_w, s_h = self.margins.s_w, self.margins.s_h
        for wide, high, color, style, label in (
            (0.0, 0.0, SEEN_THING, "-", "obstacle as seen"),
            (s_w, s_h, SEEN_THING, "--", "with its margins $s_w$, $s_h$"),
        ):
            half = self.obstacle.width / 2.0 + wide
            ax.add_patch(
                Rectangle(
                    (seen - half, 0.0),
                    2.0 * half,
                    self.obstacle.height + high,
                    fill=False,
                    ec=color,
                    ls=style,
                    lw=1.2,
                    label=label,
                    zorder=4,
                )
            )


def leg_sticks(
    data: RunData,
    plant: MultibodyPlant,
    outline: LegOutline,
    foot: Foot,
    rows: Sequence[int],
) -> LegSticks:
    """Computes where a leg truly was.

    Args:
        data: the run.
        plant: the robot alone.
        outline: of its legs below the knee.
        foot: which leg.
        rows: samples of the run, n.
    """
    robot = data.run.scenario.robot.model()
    context = plant.CreateDefaultContext()
    hip = plant.GetJointByName(robot.leg_joints[foot][0]).frame_on_parent()
    shank = plant.GetJointByName(robot.knee_joints[foot]).child_body()
    ankle = plant.GetBodyByName(robot.foot_bodies[foot])
    toe, heel, floor = outline.toe, -outline.heel, float(outline.foot[:, 1].min())
    chains, outlines = [], []
    for row in rows:
        q_v: Vector = data.state[row]
        plant.SetPositionsAndVelocities(context, q_v)
        X_WK = plant.EvalBodyPoseInWorld(context, shank)
        X_WA = plant.EvalBodyPoseInWorld(context, ankle)
        ends = X_WA @ np.array([[heel, toe], [0.0, 0.0], [floor, floor]])
        chains.append(
            [
                hip.CalcPoseInWorld(context).translation(),
                X_WK.translation(),
                X_WA.translation(),
                *ends.T,
            ]
        )
        feet, cap = (
            (X_W @ np.column_stack([p[:, 0], 0.0 * p[:, 0], p[:, 1]]).T).T
            for X_W, p in ((X_WA, outline.foot), (X_WK, outline.shank))
        )
        outlines.append(np.vstack([feet[:3], cap, feet[3:]]))
    return LegSticks(np.array(chains), np.array(outlines))


def _rows(time: Vector, begin: float, end: float) -> list[int]:
    """Samples of a stretch of time, no more than are needed to draw it."""
    first, last = np.searchsorted(time, [begin, end])
    last = min(last, len(time) - 1)
    return [round(row) for row in np.linspace(first, last, LOOKED_AT)]


def _draw_phase(
    ax: Axes,
    name: str,
    foot: Foot,
    span: tuple[float, float],
    plane: _Plane,
    data: RunData,
    plant: MultibodyPlant,
    outline: LegOutline,
) -> None:
    time = data.motion.time
    legs = leg_sticks(data, plant, outline, foot, _rows(time, *span))
    chain = plane.to_plane(legs.chain)
    around = plane.to_plane(legs.outline)
    gaps = plane.gaps(around)
    color = np.array(to_rgb(SIDES[foot]))
    for share in np.linspace(0.0, 1.0, STICKS):
        row = round(share * (len(chain) - 1))
        shade = tuple(1.0 - (0.25 + 0.75 * share) * (1.0 - color))
        ax.plot(*chain[row][[0, 1, 2]].T, color=shade, lw=1.3, marker=".", ms=4)
        ax.plot(*chain[row][[2, 3, 4, 2]].T, color=shade, lw=1.3)
    ax.plot(*chain[:, 0].T, color=WAIST, lw=1.6, label="hip")
    ax.plot([], [], color=SIDES[foot], lw=1.3, marker=".", label="leg")
    nearest = int(np.argmin(gaps))
    ax.add_patch(
        Polygon(
            around[nearest],
            fc=SIDES[foot],
            ec=WANTED,
            alpha=0.45,
            lw=1.5,
            zorder=3,
            label="outline $L_1 \\ldots L_7$ where it comes nearest",
        )
    )
    ax.set_title(
        f"{name}: {foot} leg, {span[1] - span[0]:.2f} s; its outline stays "
        f"{1e3 * gaps[nearest]:.0f} mm off",
        fontsize=10,
    )


def _draw_key(
    ax: Axes,
    phases: Phases,
    key: KeyConfiguration,
    repairs: Repairs,
    plane: _Plane,
    data: RunData,
    plant: MultibodyPlant,
    outline: LegOutline,
) -> None:
    """Both legs in the middle of phase 2, and what was planned of it."""
    rows = _rows(data.motion.time, phases.touch, phases.lift)
    middle, rear_ankle = len(rows) // 2, 0.0
    for foot in (phases.first, phases.second):
        legs = leg_sticks(data, plant, outline, foot, rows)
        chain = plane.to_plane(legs.chain[middle])
        around = plane.to_plane(legs.outline[middle])
        ax.plot(*plane.to_plane(legs.chain[:, 0]).T, color=WAIST, lw=1.6)
        ax.add_patch(Polygon(around, fc=SIDES[foot], ec="none", alpha=0.25))
        ax.plot(*chain[[0, 1, 2]].T, color=SIDES[foot], lw=1.8, marker=".", ms=6)
        ax.plot(*chain[[2, 3, 4, 2]].T, color=SIDES[foot], lw=1.5)
        if foot == phases.second:
            rear_ankle = float(chain[2, 0])
    waists = [(key.X_hds, key.Z_hds)]
    if key.X_end is not None and key.Z_end is not None:
        waists.append((key.X_end, key.Z_end))
    for x, z in waists:
        ax.plot(rear_ankle + x, z, "o", mfc="none", mec=WAIST, mew=1.8, ms=9, zorder=5)
    x, z = waists[0]
    lowered = f",\n{1e3 * repairs.lowered:.0f} mm less by FTA"
    note = lowered if repairs.lowered > 0.0 else ""
    for begin, end, text, place, side in (
        (
            (rear_ankle, 0.86),
            (rear_ankle + x, 0.86),
            f"$X_{{hds}}$ = {x:.3f} m",
            (rear_ankle + x + 0.02, 0.86),
            "left",
        ),
        (
            (rear_ankle, 0.92),
            (rear_ankle + key.X_ads, 0.92),
            f"$X_{{ads}}$ = {key.X_ads:.3f} m",
            (rear_ankle + key.X_ads + 0.02, 0.92),
            "left",
        ),
        (
            (rear_ankle - 0.2, 0.0),
            (rear_ankle - 0.2, z),
            f"$Z_{{hds}}$ = {z:.3f} m{note}",
            (rear_ankle - 0.18, 0.6),
            "left",
        ),
    ):
        arrow = {"arrowstyle": "<->", "color": WANTED, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", end, begin, arrowprops=arrow, zorder=6)
        ax.text(
            *place,
            text,
            ha=side,
            va="center",
            fontsize=9,
            zorder=6,
            bbox={"fc": "white", "ec": "none", "pad": 1, "alpha": 0.8},
        )
    ax.axhline(z, color=WAIST, lw=0.8, ls=":")
    ax.set_title(
        f"phase 2, {phases.lift - phases.touch:.2f} s: the key configuration",
        fontsize=10,
    )
