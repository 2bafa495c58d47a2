"""Assembly of a tilting scanner's lines to a cloud without the robot's own body."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.perception import PointCloud
from pydrake.systems.framework import BasicVector, Context, LeafSystem, State

from footfall.models.values.perceived import LaserScan
from footfall.models.values.validation import Parameters, number
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.held_value import HeldValue
from footfall.systems.perception.planes.cut_sweep import (
    CutCloud,
    CutSweep,
    add_line,
    cut_cloud,
    empty_cut,
    finish_sweep,
)
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.sensing.scan_geometry import line_to_points, tilt_pose
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class ScanAssemblerParams(Parameters):
    """How lines become a cloud."""

    margin: float = number(0.03, "m", least=0.0, most=1.0)
    """How far the boxes about the robot's own bodies are inflated, m: six standard
    deviations of the scanner's noise."""
    period: float = number(
        0.025, "s", least=1e-3, most=10.0, shared="sensors.lidar.line_period"
    )
    """How often it looks for a new line, s; the scanner's line period."""
    offset: float = number(0.001, "s", above=0.0)
    """How long after each line it looks, s; the sensor's pose is taken then."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.offset < self.period:
            raise ValueError(
                f"offset: must be less than the period, got {self.offset:g} s"
            )


@dataclass(frozen=True, eq=False)
class SelfFilterBox(Value):
    """A box about a part of the robot, within which points are its own."""

    body_index: int
    """The body it is fixed to: where that body's pose is in `body_poses`."""
    X_BG: RigidTransform
    """Pose of the box's centre in the body's frame."""
    size: Vector
    """Side lengths, (3,), m."""


def box_around(body_index: int, vertices: Vector) -> SelfFilterBox:
    """Computes the least box along the body's axes about vertices, (n, 3), m."""
    least, greatest = vertices.min(axis=0), vertices.max(axis=0)
    centre: Vector = (least + greatest) / 2.0
    return SelfFilterBox(body_index, RigidTransform(centre), greatest - least)


def remove_own_points(
    p_W: Vector,
    boxes: Sequence[SelfFilterBox],
    body_poses: Sequence[RigidTransform],
    margin: float,
) -> Vector:
    """Removes the points that are the robot's own (stair paper, Sec. 3).

    Args:
        p_W: points in W, (n, 3), m.
        boxes: boxes about the robot's bodies.
        body_poses: X_WB of every body, indexed by `SelfFilterBox.body_index`.
        margin: how far each box is inflated to every side, m.

    Returns:
        The points outside every inflated box, (k, 3), m, in their order.
    """
    if not boxes or not len(p_W):
        return p_W
    poses = [body_poses[box.body_index].multiply(box.X_BG) for box in boxes]
    R_WG: Vector = np.stack([pose.rotation().matrix() for pose in poses])
    p_WG: Vector = np.stack([pose.translation() for pose in poses])
    half: Vector = np.stack([box.size for box in boxes]) / 2.0 + margin
    # p_G = R_WG' (p_W - p_WG), for all boxes and points at once.
    p_G = p_W @ R_WG - np.einsum("bi,bij->bj", p_WG, R_WG)[:, np.newaxis, :]
    own: np.ndarray[Any, np.dtype[np.bool_]] = np.all(
        np.abs(p_G) <= half[:, np.newaxis, :], axis=2
    ).any(axis=0)
    kept: Vector = p_W[~own]
    return kept


@dataclass(frozen=True, eq=False)
class _Assembly(Value):
    """State: the lines of the present sweep and the last cloud."""

    time: float = -math.inf
    """Time of the latest line that was taken in, s."""
    lines: tuple[Vector, ...] = ()
    """Points of the lines since the last finished sweep, each (k, 3), m, in W."""
    cloud: tuple[Vector, ...] = ()
    """The same of the last finished sweep."""
    sweeps: int = 0
    """Number of sweeps assembled."""
    cut_lines: CutSweep | None = None
    """The same lines as `lines`, cut; None before the first or where nothing is cut."""
    cut: CutSweep | None = None
    """The same as `cloud`, cut."""


class ScanAssembler(LeafSystem):
    """Gathers the lines of each sweep into one cloud in W, less the robot's own points.

    It looks for a new line once a line period, a moment after the scanner takes one,
    since events at the same instant see each other's state of before. The sensor's
    pose is the mount's at that moment; the robot is meant to stand still meanwhile.

    .. pydrake_system::

        name: ScanAssembler
        input_ports:
        - scan
        - sweep
        - body_poses
        output_ports:
        - cloud
        - cut_cloud
        - sweep

    - `scan`: the scanner's latest line, LaserScan.
    - `sweep` (input): how many sweeps the scanner has finished, (1,), no unit.
    - `body_poses`: X_WB of every body, true or estimated, list[RigidTransform].
    - `cloud`: points of the last finished sweep in W, PointCloud, m; empty before.
    - `cut_cloud`: the same cloud's points lower than the scanner, CutCloud in W, m, cut
      into pieces of surface line by line; empty where no side of columns was given.
    - `sweep` (output): how many sweeps are assembled, (1,), no unit.
    """

    def __init__(
        self,
        params: ScanAssemblerParams,
        *,
        beam_angles: Vector,
        mount_body: int,
        X_BM: RigidTransform,
        own_boxes: Sequence[SelfFilterBox] = (),
        cell: float | None = None,
    ) -> None:
        """Declares ports and the update.

        Args:
            params: margin and timing.
            beam_angles: directions of the scanner's beams, (n,), rad.
            mount_body: index of the body that carries the scanner's servo.
            X_BM: pose of the servo's base in that body: x forward, y left, z up.
            own_boxes: boxes about the robot's bodies.
            cell: side of the columns that lines are cut into, m; None to cut nothing.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._cell = cell
        self._margin = params.margin
        self._angles = beam_angles
        self._mount_body = mount_body
        self._X_BM = X_BM
        self._boxes = tuple(own_boxes)
        nothing = LaserScan(-math.inf, 0.0, np.zeros(0))
        self._scan = self.DeclareAbstractInputPort("scan", AbstractValue.Make(nothing))
        self._sweep = self.DeclareVectorInputPort("sweep", 1)
        self._body_poses = self.DeclareAbstractInputPort(
            "body_poses", AbstractValue.Make([RigidTransform()])
        )
        self._state = HeldValue(self, _Assembly())
        ticket = {self._state.ticket}
        calc_cloud: Callable[..., None] = timed(self, self._calc_cloud)
        self.DeclareAbstractOutputPort(
            "cloud",
            lambda: AbstractValue.Make(PointCloud(0)),
            calc_cloud,
            prerequisites_of_calc=ticket,
        )
        calc_cut: Callable[..., None] = timed(self, self._calc_cut_cloud)
        self.DeclareAbstractOutputPort(
            "cut_cloud",
            lambda: AbstractValue.Make(empty_cut(1.0)),
            calc_cut,
            prerequisites_of_calc=ticket,
        )
        self.DeclareVectorOutputPort(
            "sweep", 1, timed(self, self._calc_sweep), prerequisites_of_calc=ticket
        )
        self.DeclarePeriodicUnrestrictedUpdateEvent(
            params.period, params.offset, timed(self, self._update)
        )

    def _update(self, context: Context, state: State) -> None:
        was = self._state.get(context)
        scan = eval_abstract(self._scan, context, LaserScan)
        if not scan.time > was.time:
            return
        body_poses = eval_abstract(self._body_poses, context, list)
        X_WM = body_poses[self._mount_body].multiply(self._X_BM)
        X_WL = X_WM.multiply(tilt_pose(scan.tilt))
        points = line_to_points(scan.ranges, self._angles, X_WL)
        points = remove_own_points(points, self._boxes, body_poses, self._margin)
        cut = self._cut(was.cut_lines, points, float(X_WL.translation()[2]))
        now = replace(was, time=scan.time, lines=(*was.lines, points), cut_lines=cut)
        sweeps = int(eval_vector(self._sweep, context)[0])
        if sweeps > was.sweeps:
            now = _Assembly(scan.time, (), now.lines, sweeps, None, cut)
        self._state.set(state, now)

    def _cut(
        self, sweep: CutSweep | None, points: Vector, eye_height: float
    ) -> CutSweep | None:
        """Adds a line, (n, 3), m, seen from a height, m, to those that are cut."""
        if self._cell is None:
            return None
        sweep = sweep or CutSweep(empty_cut(self._cell))
        return add_line(sweep, cut_cloud(points, eye_height, self._cell))

    def _calc_cut_cloud(self, context: Context, cloud: AbstractValue) -> None:
        cut = self._state.get(context).cut
        nothing: CutCloud = empty_cut(self._cell or 1.0)
        cloud.set_value(nothing if cut is None else finish_sweep(cut))

    def _calc_cloud(self, context: Context, cloud: AbstractValue) -> None:
        lines = self._state.get(context).cloud
        points = np.vstack(lines) if lines else np.zeros((0, 3))
        assembled = PointCloud(len(points))
        assembled.mutable_xyzs()[:] = points.T
        cloud.set_value(assembled)

    def _calc_sweep(self, context: Context, sweep: BasicVector) -> None:
        set_vector(sweep, np.array([self._state.get(context).sweeps], dtype=np.float64))
