"""A depth camera in the room's upper part."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.framework import BasicVector, Context, LeafSystem, State

from footfall.models.scenes.solids import TriangleMesh
from footfall.models.values.room import DepthImage
from footfall.models.values.validation import MAX_SEED, Parameters, number
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.held_value import HeldValue
from footfall.systems.ports import eval_abstract, set_vector
from footfall.systems.sensing.pinhole import looking_at, pixel_rays, pixels_of_sphere
from footfall.systems.sensing.ray_caster import Beams, BodyMesh, RayCaster
from footfall.systems.timing import timed

NEAR = 0.5
"""Depth at which the noise is `noise_near`, m (room paper, Sec. 2.1)."""


@dataclass(kw_only=True)
class DepthCameraParams(Parameters):
    """An RGB-D camera's depth, fixed in the room (room paper, Sec. 2.1)."""

    columns: int = number(640, "pixels", least=1, most=4096)
    """Width of the picture, pixels (paper: VGA)."""
    rows: int = number(480, "pixels", least=1, most=4096)
    """Height of the picture, pixels (paper: VGA)."""
    field_of_view_deg: float = number(90.0, "deg", least=1.0, below=170.0)
    """Horizontal field of view, deg. The paper's Xtion has 58 deg, which from under a
    ceiling of 3 m sees 3.2 m of floor; a walk of 5 m takes a wider lens."""
    period: float = number(1.0 / 30.0, "s", least=1e-3, most=10.0)
    """Time between frames, s (paper: 25 to 30 Hz)."""
    min_range: float = number(0.5, "m", least=0.0)
    """Least depth that is measured, m."""
    max_range: float = number(5.0, "m", above=0.0)
    """Greatest depth that is measured, m; where the noise is `noise_far`."""
    noise_near: float = number(0.002, "m", least=0.0, most=1.0)
    """Standard deviation of a depth at 0.5 m, m (paper: a few millimetres)."""
    noise_far: float = number(0.04, "m", least=0.0, most=1.0)
    """Standard deviation of a depth at `max_range`, m (paper: about 4 cm); it grows
    with the square of the depth (Khoshelham and Elberink 2012)."""
    position: list[float] = number([0.0, -0.8, 2.9], "m", length=3)
    """Where the camera is in W, m: under the ceiling of a 3 m room."""
    target: list[float] = number([0.0, 0.0, 0.0], "m", length=3)
    """The point in W in the middle of the picture, m; the picture is upright, so its
    width runs across the line from here to the target."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Seed of the noise."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.max_range > max(self.min_range, NEAR):
            raise ValueError(
                f"max_range: must exceed min_range and {NEAR:g} m, "
                f"got {self.max_range:g} m"
            )
        if self.noise_far < self.noise_near:
            raise ValueError(
                f"noise_far: must be at least {self.noise_near:g} m, "
                f"got {self.noise_far:g} m"
            )
        if self.position == self.target:
            raise ValueError(f"target: must differ from position, got {self.target} m")

    @property
    def focal_length(self) -> float:
        """Pixels."""
        half = math.radians(self.field_of_view_deg) / 2.0
        return self.columns / 2.0 / math.tan(half)

    def X_WC(self) -> RigidTransform:
        """Pose of the camera."""
        return looking_at(np.array(self.position), np.array(self.target))


def depth_noise(depth: Vector, params: DepthCameraParams) -> Vector:
    """Standard deviation of depths (...), m: a + b z^2 through both ends of the range.

    Khoshelham and Elberink (2012), Eq. 11, whose deviation is proportional to the
    squared depth, over a floor of what the sensor resolves near by.
    """
    near, far = params.noise_near, params.noise_far
    growth = (far - near) / (params.max_range**2 - NEAR**2)
    return np.maximum(near + growth * (depth**2 - NEAR**2), 0.0)


def measure_depth(depth: Vector, frame: int, params: DepthCameraParams) -> Vector:
    """Measures true depths as the camera does.

    Args:
        depth: true depths, (n,), m; inf where there is nothing.
        frame: how many frames were taken before; with the seed it fixes the noise.
        params: noise and limits.

    Returns:
        Depths, (n,), m; nan below the least, inf beyond the greatest.
    """
    generator = np.random.default_rng((params.seed, frame))
    noise = generator.standard_normal(len(depth), dtype=np.float32)
    seen = depth <= 2.0 * params.max_range
    measured: Vector = np.full(len(depth), np.inf)
    measured[seen] = depth[seen] + depth_noise(depth[seen], params) * noise[seen]
    measured[measured < params.min_range] = np.nan
    measured[measured > params.max_range] = np.inf
    return measured


@dataclass(frozen=True, eq=False)
class _Shutter(Value):
    """What the latest frame is of; the picture follows from it when someone looks."""

    time: float = -math.inf
    """When it was taken, s."""
    frames: int = 0
    """How many were taken."""
    body_poses: tuple[RigidTransform, ...] = ()
    """X_WB of every body then."""
    believed: tuple[RigidTransform, ...] = ()
    """The same as the robot believes them."""


class DepthCamera(LeafSystem):
    """Takes a depth image of the scene and the bodies every period.

    What is kept of a frame is where the bodies were; the rays are cast when the image
    is asked for, so frames at which no one looks cost nothing.

    .. pydrake_system::

        name: DepthCamera
        input_ports:
        - body_poses
        - believed_poses
        output_ports:
        - depth_image
        - frame_body_poses
        - frame

    - `body_poses`: X_WB of every body, list[RigidTransform], as MultibodyPlant has it.
    - `believed_poses`: the same as the robot believes them, by indices of its own,
      list[RigidTransform]; need not be connected.
    - `depth_image`: the latest frame, DepthImage; before the first its time is -inf
      and it has no pixels.
    - `frame_body_poses`: `believed_poses` when that was taken, list[RigidTransform];
      `body_poses` where those are not connected.
    - `frame`: how many frames were taken, (1,), no unit.
    """

    def __init__(
        self,
        params: DepthCameraParams,
        *,
        scene: TriangleMesh,
        body_meshes: Sequence[BodyMesh] = (),
    ) -> None:
        """Declares ports and the frame period; builds the trees to cast on.

        Args:
            params: lens, noise, pose and period.
            scene: what does not move, in W.
            body_meshes: what moves: the robot, obstacles.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._params = params
        self._X_WC = params.X_WC()
        self._rays = pixel_rays(params.rows, params.columns, params.focal_length)
        self._caster = RayCaster(scene, body_meshes)
        self._body_poses = self.DeclareAbstractInputPort(
            "body_poses", AbstractValue.Make([RigidTransform()])
        )
        self._believed = self.DeclareAbstractInputPort(
            "believed_poses", AbstractValue.Make([RigidTransform()])
        )
        self._state = HeldValue(self, _Shutter())
        ticket = {self._state.ticket}
        calc_image: Callable[..., None] = timed(self, self._calc_depth_image)
        calc_poses: Callable[..., None] = timed(self, self._calc_frame_body_poses)
        self.DeclareAbstractOutputPort(
            "depth_image",
            partial(AbstractValue.Make, self._no_image()),
            calc_image,
            prerequisites_of_calc=ticket,
        )
        self.DeclareAbstractOutputPort(
            "frame_body_poses",
            lambda: AbstractValue.Make([RigidTransform()]),
            calc_poses,
            prerequisites_of_calc=ticket,
        )
        self.DeclareVectorOutputPort(
            "frame", 1, timed(self, self._calc_frame), prerequisites_of_calc=ticket
        )
        self.DeclarePeriodicUnrestrictedUpdateEvent(
            params.period, 0.0, timed(self, self._update)
        )

    def _update(self, context: Context, state: State) -> None:
        body_poses = eval_abstract(self._body_poses, context, list)
        believed = body_poses
        if self._believed.HasValue(context):
            believed = eval_abstract(self._believed, context, list)
        # Copied, since Drake reuses the lists that the ports hold.
        shutter = _Shutter(
            context.get_time(),
            self._state.get(context).frames + 1,
            tuple(RigidTransform(pose) for pose in body_poses),
            tuple(RigidTransform(pose) for pose in believed),
        )
        self._state.set(state, shutter)

    def _no_image(self) -> DepthImage:
        nothing: Vector = np.zeros((0, 0))
        focal_length = self._params.focal_length
        return DepthImage(-math.inf, self._X_WC, focal_length, nothing)

    def _calc_depth_image(self, context: Context, image: AbstractValue) -> None:
        shutter, params = self._state.get(context), self._params
        if not shutter.frames:
            image.set_value(self._no_image())
            return

        def in_sphere(p_CS: Vector, radius: float) -> Iterable[Beams]:
            shape = (params.rows, params.columns, params.focal_length)
            pixels = pixels_of_sphere(p_CS, radius, *shape)
            return (pixels,) if len(pixels) else ()

        # The rays have z = 1, so distances in units of their lengths are depths.
        depth = self._caster.cast_beams(
            self._X_WC, self._rays, shutter.body_poses, in_sphere, threads=0
        )
        measured = measure_depth(depth, shutter.frames - 1, params)
        picture: Vector = measured.reshape(params.rows, params.columns)
        image.set_value(
            DepthImage(shutter.time, self._X_WC, params.focal_length, picture)
        )

    def _calc_frame_body_poses(self, context: Context, poses: AbstractValue) -> None:
        poses.set_value(list(self._state.get(context).believed))

    def _calc_frame(self, context: Context, frame: BasicVector) -> None:
        set_vector(frame, np.array([self._state.get(context).frames], dtype=np.float64))
