"""A laser scanner that a servo tilts to sweep a cloud, line by line."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.framework import BasicVector, Context, LeafSystem, State

from footfall.models.scenes.solids import TriangleMesh
from footfall.models.values.perceived import LaserScan
from footfall.models.values.validation import MAX_SEED, Parameters, number
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.held_value import HeldValue
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.sensing.ray_caster import BodyMesh, RayCaster
from footfall.systems.sensing.scan_geometry import (
    beam_angles,
    beam_directions,
    tilt_pose,
)
from footfall.systems.timing import timed

MAX_POINTS = 10_000_000
"""More than this many points of a sweep are refused; this scanner takes 260,521."""


@dataclass(kw_only=True)
class TiltingLidarParams(Parameters):
    """A Hokuyo UTM-30LX-EW on a tilt servo.

    Angles are in degrees, as on its data sheet, so that lines and beams count out.
    """

    field_of_view_deg: float = number(270.0, "deg", above=0.0)
    """Angle between the first and the last beam, deg (stair paper, Sec. 3)."""
    resolution_deg: float = number(0.25, "deg", least=0.01)
    """Angle between neighbouring beams, deg (stair paper, Sec. 3)."""
    line_period: float = number(0.025, "s", least=1e-3, most=10.0)
    """Time between lines, s (stair paper, Sec. 3)."""
    min_range: float = number(0.1, "m", least=0.0)
    """Least range that is measured, m (stair paper, Sec. 3)."""
    max_range: float = number(30.0, "m", above=0.0)
    """Greatest range that is measured, m (data sheet)."""
    noise: float = number(0.005, "m", least=0.0, most=1.0)
    """Standard deviation of a range, m; real clouds of this scanner show 4 to 6 mm."""
    relative_noise: float = number(0.0, least=0.0, most=0.2)
    """Standard deviation of a range as a part of it, beside `noise`: 0.01 is what the
    stair paper's Sec. 3 speaks of."""
    tilt_start_deg: float = number(30.0, "deg", least=-180.0, most=180.0)
    """Tilt of the first line, deg, positive down; sees the ground 3 m ahead."""
    tilt_end_deg: float = number(90.0, "deg", least=-180.0, most=180.0)
    """Tilt of the last line, deg; straight down, to see the tread next to the feet.
    The sweep is 60 deg (stair paper, Sec. 3)."""
    tilt_step_deg: float = number(0.25, "deg", least=0.01)
    """Tilt between lines, deg; as fine as the beams."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Seed of the noise."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.field_of_view_deg <= 360.0 - self.resolution_deg:
            raise ValueError(
                "field_of_view_deg: must be less than a turn by a beam, "
                f"got {self.field_of_view_deg:g} deg"
            )
        _require_whole("resolution_deg", self.field_of_view_deg, self.resolution_deg)
        if not self.min_range < self.max_range:
            raise ValueError(
                f"max_range: must exceed min_range, got {self.max_range:g} m"
            )
        if not self.tilt_end_deg > self.tilt_start_deg:
            raise ValueError(
                f"tilt_end_deg: must exceed tilt_start_deg, got {self.tilt_end_deg:g} "
                "deg"
            )
        sweep = self.tilt_end_deg - self.tilt_start_deg
        _require_whole("tilt_step_deg", sweep, self.tilt_step_deg)
        points = sweep / self.tilt_step_deg * self.field_of_view_deg
        if points / self.resolution_deg > MAX_POINTS:
            raise ValueError(
                f"tilt_step_deg: must leave a sweep at most {MAX_POINTS:g} points, "
                f"got {self.tilt_step_deg:g} deg"
            )

    def angles(self) -> Vector:
        """Directions of the beams, (n,), rad; see `beam_angles`."""
        return beam_angles(
            math.radians(self.field_of_view_deg), math.radians(self.resolution_deg)
        )

    def tilts(self) -> Vector:
        """Tilts of a sweep's lines, (m,), rad."""
        sweep = self.tilt_end_deg - self.tilt_start_deg
        lines = round(sweep / self.tilt_step_deg) + 1
        return np.radians(np.linspace(self.tilt_start_deg, self.tilt_end_deg, lines))


def _require_whole(item: str, total: float, step: float) -> None:
    """Raises ValueError unless `step` goes into `total` a whole number of times."""
    if abs(total / step - round(total / step)) > 1e-6:
        raise ValueError(f"{item}: must divide {total:g} deg, got {step:g} deg")


def measure(distances: Vector, line: int, params: TiltingLidarParams) -> Vector:
    """Measures true distances as the scanner does.

    Args:
        distances: true distances, (n,), m; inf where there is nothing.
        line: how many lines were taken before; with the seed it fixes the noise.
        params: noise and limits.

    Returns:
        Ranges, (n,), m; nan below the least range, inf beyond the greatest.
    """
    generator = np.random.default_rng((params.seed, line))
    deviation: Vector | float = params.noise
    if params.relative_noise > 0.0:
        far = np.where(np.isfinite(distances), distances, 0.0)
        deviation = np.hypot(deviation, params.relative_noise * far)
    ranges: Vector = distances + deviation * generator.standard_normal(len(distances))
    ranges[ranges < params.min_range] = np.nan
    ranges[ranges > params.max_range] = np.inf
    return ranges


@dataclass(frozen=True, eq=False)
class _Sweep(Value):
    """How far the scanner has got."""

    scan: LaserScan
    """The latest line."""
    lines: int = 0
    """How many lines of the present sweep are taken; 0 between sweeps."""
    sweeps: int = 0
    """How many sweeps are finished."""
    enabled: bool = False
    """Whether `enable` was on at the last line period."""


class TiltingLidar(LeafSystem):
    """Sweeps a laser scanner over the scene, a line every period.

    A rising edge of `enable` begins a sweep: the first line is taken at once, from the
    first tilt, and the servo moves a step a line. A sweep that has begun is finished
    whatever `enable` does; the next one takes another rising edge. Between sweeps the
    servo rests where it is. Each line sees the scene and the bodies where they are
    when it is taken, so a body that moves distorts the sweep as it would a real one.

    .. pydrake_system::

        name: TiltingLidar
        input_ports:
        - body_poses
        - enable
        output_ports:
        - scan
        - tilt
        - sweep
        - viewpoint

    - `body_poses`: X_WB of every body, list[RigidTransform], as MultibodyPlant has it.
    - `enable`: above 0.5 asks for a sweep, (1,), no unit.
    - `scan`: the latest line, LaserScan; before the first its time is -inf and its
      ranges are empty.
    - `tilt`: angle of the servo, (1,), rad.
    - `sweep`: how many sweeps are finished, (1,), no unit; grows with the last line.
    - `viewpoint`: where the scanner is now, p_WL, (3,), m.
    """

    def __init__(
        self,
        params: TiltingLidarParams,
        *,
        mount_body: int,
        X_BM: RigidTransform,
        scene: TriangleMesh,
        body_meshes: Sequence[BodyMesh] = (),
    ) -> None:
        """Declares ports and the line period; builds the trees to cast on.

        Args:
            params: scanner and servo.
            mount_body: index of the body that carries the servo in `body_poses`.
            X_BM: pose of the servo's base in that body: x forward, y left, z up.
            scene: what does not move, in W.
            body_meshes: what moves; all the robot but the scanner's own housing.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._params = params
        self._mount_body = mount_body
        self._X_BM = X_BM
        self._tilts = params.tilts()
        self._angles = params.angles()
        self._directions = beam_directions(self._angles)
        self._caster = RayCaster(scene, body_meshes)
        self._body_poses = self.DeclareAbstractInputPort(
            "body_poses", AbstractValue.Make([RigidTransform()])
        )
        self._enable = self.DeclareVectorInputPort("enable", 1)
        nothing = LaserScan(-math.inf, float(self._tilts[0]), np.zeros(0))
        self._state = HeldValue(self, _Sweep(nothing))
        ticket = {self._state.ticket}
        calc_scan: Callable[..., None] = timed(self, self._calc_scan)
        self.DeclareAbstractOutputPort(
            "scan",
            lambda: AbstractValue.Make(nothing),
            calc_scan,
            prerequisites_of_calc=ticket,
        )
        self.DeclareVectorOutputPort(
            "tilt", 1, timed(self, self._calc_tilt), prerequisites_of_calc=ticket
        )
        self.DeclareVectorOutputPort(
            "sweep", 1, timed(self, self._calc_sweep), prerequisites_of_calc=ticket
        )
        self.DeclareVectorOutputPort(
            "viewpoint",
            3,
            timed(self, self._calc_viewpoint),
            prerequisites_of_calc={self._body_poses.ticket()},
        )
        self.DeclarePeriodicUnrestrictedUpdateEvent(
            params.line_period, 0.0, timed(self, self._update)
        )

    def _update(self, context: Context, state: State) -> None:
        was = self._state.get(context)
        enabled = bool(eval_vector(self._enable, context)[0] > 0.5)
        begins = was.lines == 0 and enabled and not was.enabled
        if was.lines == 0 and not begins:
            if enabled != was.enabled:
                now = _Sweep(was.scan, 0, was.sweeps, enabled)
                self._state.set(state, now)
            return
        scan = self._take_line(context, was)
        lines, sweeps = was.lines + 1, was.sweeps
        if lines == len(self._tilts):
            lines, sweeps = 0, sweeps + 1
        self._state.set(state, _Sweep(scan, lines, sweeps, enabled))

    def _take_line(self, context: Context, sweep: _Sweep) -> LaserScan:
        tilt = float(self._tilts[sweep.lines])
        body_poses = eval_abstract(self._body_poses, context, list)
        X_WM = body_poses[self._mount_body].multiply(self._X_BM)
        distances = self._caster.cast(
            X_WM.multiply(tilt_pose(tilt)), self._angles, self._directions, body_poses
        )
        line = sweep.sweeps * len(self._tilts) + sweep.lines
        ranges = measure(distances, line, self._params)
        return LaserScan(context.get_time(), tilt, ranges)

    def _calc_scan(self, context: Context, scan: AbstractValue) -> None:
        scan.set_value(self._state.get(context).scan)

    def _calc_tilt(self, context: Context, tilt: BasicVector) -> None:
        set_vector(tilt, np.array([self._state.get(context).scan.tilt]))

    def _calc_sweep(self, context: Context, sweep: BasicVector) -> None:
        set_vector(sweep, np.array([self._state.get(context).sweeps], dtype=np.float64))

    def _calc_viewpoint(self, context: Context, viewpoint: BasicVector) -> None:
        body_poses = eval_abstract(self._body_poses, context, list)
        X_WM = body_poses[self._mount_body].multiply(self._X_BM)
        set_vector(viewpoint, X_WM.translation())
