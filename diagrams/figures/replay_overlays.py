"""What a replay shows beside the robot: what it saw, planned, and felt."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from matplotlib.colors import to_rgb
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import Box, Cylinder, Meshcat, MeshcatAnimation, Rgba, Sphere
from pydrake.math import RigidTransform, RotationMatrix

from footfall.diagrams.figures.colors import COM, SEEN_THING, SIDES, ZMP
from footfall.diagrams.figures.room_view import seen_boxes, seen_obstacles
from footfall.diagrams.judge.measures import LIFTED
from footfall.diagrams.run_data import RunData
from footfall.diagrams.signal_names import OBSTACLE_SIGNAL
from footfall.diagrams.signals import Run
from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector

ROOT = "/shown"
"""Where all of it lies in Meshcat's tree: a tick there hides it."""
STAIRCASE_SIGNAL = "staircase_map.staircase"
ENVIRONMENT_SIGNAL = "executive.environment"
FOOTSTEP_SIGNAL = "executive.footstep_plan"
FORCE_LENGTH = 0.5
"""Length of the arrow of a force of one body weight, m."""
ABOVE = 0.004
"""How far outlines and footholds lie above what they lie on, m."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What the robot took what it had seen for, from a time on."""

    time: float
    """When it was known, s."""
    edges: Vector
    """Both ends of each edge of the outlines, (k, 2, 3), in W, m."""


@dataclass(frozen=True, eq=False)
class PlannedFoothold:
    """Where a sole is to stand."""

    time: float
    """When it was planned, s."""
    foot: Foot
    X_WF: RigidTransform


@dataclass(frozen=True, eq=False)
class ContactForce:
    """The force of the ground on a foot over time, n samples."""

    point: Vector
    """Where it acts: the sole's centre of pressure, (n, 3), in W, m."""
    force: Vector
    """Over the robot's weight, (n, 3), in W."""


@dataclass(frozen=True, eq=False)
class Overlays:
    """What is shown beside the robot, of n samples."""

    com: Vector
    """(n, 3), in W, m."""
    zmp: Vector | None
    """At the height of the soles that bear the weight, (n, 3), in W, m; nan where there
    is none. None where forces were not logged."""
    forces: Mapping[Foot, ContactForce]
    """Empty where forces were not logged."""
    footholds: tuple[PlannedFoothold, ...]
    seen: tuple[Seen, ...]


def read_overlays(data: RunData) -> Overlays:
    """Reads of a run what there is to show.

    Raises:
        RunError: a file of the run is damaged.
    """
    forces = contact_forces(data)
    return Overlays(
        com=data.motion.com,
        zmp=zmp_of(forces) if forces else None,
        forces=forces,
        footholds=tuple(_footholds(data.run)),
        seen=tuple(_seen(data.run)),
    )


def contact_forces(data: RunData) -> dict[Foot, ContactForce]:
    """Computes force and centre of pressure of both feet; empty where not logged."""
    if data.wrenches is None:
        return {}
    weight, forces = data.limits.weight, {}
    for foot in FEET:
        wrench_F, X_WF = data.wrenches[foot], data.motion.X_WF[foot]
        pressure = np.maximum(wrench_F[:, 2], LIFTED * weight)
        # About the centre of pressure the sole feels no moment but about its normal.
        p_F = np.zeros((len(wrench_F), 3))
        p_F[:, 0] = -wrench_F[:, 4] / pressure
        p_F[:, 1] = wrench_F[:, 3] / pressure
        R_WF, p_WF = X_WF[:, :3, :3], X_WF[:, :3, 3]
        point = p_WF + np.einsum("nij,nj->ni", R_WF, p_F)
        force = np.einsum("nij,nj->ni", R_WF, wrench_F[:, :3]) / weight
        force[force[:, 2] < LIFTED] = 0.0
        forces[foot] = ContactForce(point, force)
    return forces


def zmp_of(forces: Mapping[Foot, ContactForce]) -> Vector:
    """Weighs the feet's centres of pressure by their load, (n, 3), m; nan without."""
    loads = np.stack([forces[foot].force[:, 2] for foot in FEET])
    points = np.stack([forces[foot].point for foot in FEET])
    total = loads.sum(axis=0)
    with np.errstate(invalid="ignore"):
        zmp: Vector = (loads[:, :, None] * points).sum(axis=0) / total[:, None]
    return zmp


def _footholds(run: Run) -> Iterable[PlannedFoothold]:
    if FOOTSTEP_SIGNAL not in run.value_names:
        return
    for time, plan in run.values(FOOTSTEP_SIGNAL):
        for step in cast(Sequence[Mapping[str, Any]], plan["footsteps"]):
            pose = step["X_WF"]
            turn: Vector = np.array(pose["quaternion"], dtype=np.float64)
            p_WF: Vector = np.array(pose["translation"], dtype=np.float64)
            X_WF = RigidTransform(Quaternion(turn), p_WF)
            yield PlannedFoothold(time, cast(Foot, step["foot"]), X_WF)


def _seen(run: Run) -> Iterable[Seen]:
    """Yields treads, obstacles or boxes each time that they were seen anew."""
    if STAIRCASE_SIGNAL in run.value_names:
        for time, value in run.values(STAIRCASE_SIGNAL):
            treads = cast(Sequence[Mapping[str, Any]], value["treads"])
            yield Seen(time, _edges([np.array(tread["polygon"]) for tread in treads]))
    for signal, read in (
        (OBSTACLE_SIGNAL, seen_obstacles),
        (ENVIRONMENT_SIGNAL, seen_boxes),
    ):
        if signal in run.value_names:
            for time, value in run.values(signal):
                tops = []
                for box in read(value):
                    outline = np.empty((4, 3))
                    outline[:, :2] = box.footprint()
                    outline[:, 2] = box.center[2] + box.size[2] / 2.0
                    tops.append(outline)
                yield Seen(time, _edges(tops))


def _edges(outlines: Sequence[Vector]) -> Vector:
    """Gives both ends of every edge of closed outlines, (k, 2, 3)."""
    edges = [np.stack([line, np.roll(line, -1, axis=0)], axis=1) for line in outlines]
    joined: Vector = np.concatenate([np.zeros((0, 2, 3)), *edges])
    return joined


def add_overlays(
    meshcat: Meshcat,
    recording: MeshcatAnimation,
    overlays: Overlays,
    sole: Sole,
    moments: Sequence[tuple[float, int]],
) -> None:
    """Adds what is shown to a recording.

    Args:
        meshcat: that is recorded.
        recording: of the robot.
        overlays: what is shown.
        sole: of the robot.
        moments: time, s, and sample of each frame.
    """
    end = recording.frame(moments[-1][0])
    for index, seen in enumerate(overlays.seen):
        later = overlays.seen[index + 1 :]
        until = recording.frame(later[0].time) if later else end + 1
        if len(seen.edges):
            path = f"{ROOT}/seen/{index}"
            lifted = seen.edges + np.array([0.0, 0.0, ABOVE])
            starts, stops = lifted[:, 0].T, lifted[:, 1].T
            meshcat.SetLineSegments(path, starts, stops, 3.0, _rgba(SEEN_THING))
            _show(recording, path, recording.frame(seen.time), until, end)
    for index, foothold in enumerate(overlays.footholds):
        path = f"{ROOT}/footholds/{index}"
        size = (sole.length, 2.0 * sole.half_width, ABOVE)
        meshcat.SetObject(path, Box(*size), _rgba(SIDES[foothold.foot], 0.6))
        middle: Vector = np.array([(sole.toe - sole.heel) / 2.0, 0.0, ABOVE / 2.0])
        meshcat.SetTransform(path, foothold.X_WF @ RigidTransform(middle))
        _show(recording, path, recording.frame(foothold.time), end + 1, end)
    balls = {"CoM": (overlays.com, COM, 0.035)}
    if overlays.zmp is not None:
        balls["ZMP"] = (overlays.zmp, ZMP, 0.028)
    for name, (points, color, radius) in balls.items():
        path = f"{ROOT}/{name}"
        meshcat.SetObject(path, Sphere(radius), _rgba(color))
        _draw_on_top(meshcat, path)
        for time, sample in moments:
            if np.isfinite(points[sample]).all():
                place: Vector = points[sample]
                X_WO = RigidTransform(place)
                recording.SetTransform(recording.frame(time), path, X_WO)
    rods = {
        f"forces/{foot}": (force.point, FORCE_LENGTH * force.force, SIDES[foot], 0.012)
        for foot, force in overlays.forces.items()
    }
    if overlays.zmp is not None:
        plumb = np.zeros_like(overlays.com)
        plumb[:, 2] = np.nan_to_num(overlays.zmp[:, 2] - overlays.com[:, 2])
        rods["CoM to the ground"] = (overlays.com, plumb, COM, 0.005)
    for name, (begins, spans, color, radius) in rods.items():
        path = f"{ROOT}/{name}"
        meshcat.SetObject(path, Cylinder(radius, 1.0), _rgba(color))
        _draw_on_top(meshcat, path)
        for time, sample in moments:
            frame = recording.frame(time)
            X_WA, length = rod(begins[sample], spans[sample])
            recording.SetTransform(frame, path, X_WA)
            scale = [1.0, 1.0, length] if length > 0.0 else [1e-3, 1e-3, 1e-3]
            recording.SetProperty(frame, path, "scale", scale)


def rod(begin: Vector, span: Vector) -> tuple[RigidTransform, float]:
    """Places a rod along z of its frame from one point to another.

    Args:
        begin: where it begins, (3,), m.
        span: from there to its end, (3,), m.

    Returns:
        The pose of its middle, and its length, m.
    """
    length = float(np.linalg.norm(span))
    middle: Vector = begin + span / 2.0
    if length == 0.0:
        return RigidTransform(middle), 0.0
    along: Vector = span / length
    return RigidTransform(RotationMatrix.MakeFromOneVector(along, 2), middle), length


def _draw_on_top(meshcat: Meshcat, path: str) -> None:
    """Shows an object through the robot that it is in or behind."""
    meshcat.SetProperty(f"{path}/<object>", "material.depthTest", False)
    meshcat.SetProperty(f"{path}/<object>", "renderOrder", 1.0)


def _show(
    recording: MeshcatAnimation, path: str, begin: int, until: int, end: int
) -> None:
    """Shows an object from one frame on until another, and at no other time."""
    if begin > 0:
        recording.SetProperty(0, path, "visible", False)
    recording.SetProperty(min(begin, end), path, "visible", True)
    if until <= end:
        recording.SetProperty(until, path, "visible", False)


def _rgba(color: str, alpha: float = 1.0) -> Rgba:
    return Rgba(*to_rgb(color), alpha)
