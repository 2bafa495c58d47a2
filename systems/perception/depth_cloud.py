"""Conversion of depth images to down-sampled clouds without the robot's own body."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import small_gicp
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.perception import PointCloud
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.room import DepthImage
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.perception.scan_assembler import SelfFilterBox, remove_own_points
from footfall.systems.ports import eval_abstract, set_vector
from footfall.systems.sensing.pinhole import pixel_rays
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class DepthCloudParams(Parameters):
    """How a depth image becomes a cloud."""

    leaf: float = number(0.02, "m", least=1e-3)
    """Edge of the voxels whose points are replaced by their centroid, m (room paper,
    Sec. 2.1.1: 0.005 to 0.08 m)."""
    margin: float = number(0.08, "m", least=0.0)
    """How far the boxes about the robot's own bodies are inflated, m: about four
    standard deviations of a depth in the middle of the range."""
    lower: list[float] | None = number(None, "m", length=3)
    """Least corner in W, (3,), m, of the part of the room that is looked at; none for
    all that is in view. Takes out walls."""
    upper: list[float] | None = number(None, "m", length=3)
    """Its greatest corner, (3,), m."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if self.lower is None or self.upper is None:
            return
        for index, (low, high) in enumerate(zip(self.lower, self.upper, strict=True)):
            if not low < high:
                raise ValueError(
                    f"upper[{index}]: must exceed lower[{index}], got {high:g} m"
                )


def depth_to_points(image: DepthImage) -> Vector:
    """Computes the points of a depth image.

    Returns:
        Points in W, (n, 3), m, of the n finite depths, row by row.
    """
    depth = image.depth.ravel()
    if not len(depth):
        return np.zeros((0, 3))
    rays = pixel_rays(*image.depth.shape, image.focal_length)
    seen = np.isfinite(depth)
    if not seen.all():
        depth, rays = depth[seen], rays[seen]
    R_CW: Vector = image.X_WC.rotation().matrix().T
    points: Vector = (rays * depth[:, np.newaxis]) @ R_CW
    points += image.X_WC.translation()
    return points


def downsample(points: Vector, leaf: float) -> Vector:
    """Computes the centroid of the points in each voxel (room paper, Sec. 2.1.1).

    Args:
        points: finite, (n, 3), m.
        leaf: edge of a voxel, m.

    Returns:
        One point for every occupied voxel, (m, 3), m, in an order that depends on the
        points alone.
    """
    if not len(points):
        return points
    # One thread: with more, the order of the voxels would vary from run to run.
    cloud = small_gicp.voxelgrid_sampling(points, leaf, num_threads=1)
    return np.array(cloud.points()[:, :3], dtype=np.float64)


def crop(points: Vector, lower: Sequence[float], upper: Sequence[float]) -> Vector:
    """Selects the points, (n, 3), in the box between two corners, (3,), m."""
    inside = np.all((points >= np.array(lower)) & (points <= np.array(upper)), axis=1)
    return points[inside]


def remove_robot(
    points: Vector,
    boxes: Sequence[SelfFilterBox],
    body_poses: Sequence[RigidTransform],
    margin: float,
) -> Vector:
    """Removes the points that are the robot's own.

    The same as `remove_own_points` for a large cloud of which the robot is a small
    part: only points near its bodies are looked at one by one. They come last.

    Args:
        points: in W, (n, 3), m.
        boxes: boxes about the robot's bodies.
        body_poses: X_WB of every body, indexed by `SelfFilterBox.body_index`.
        margin: how far each box is inflated to every side, m.
    """
    if not boxes or not len(points):
        return points
    centres = [
        body_poses[box.body_index].multiply(box.X_BG.translation()) for box in boxes
    ]
    reach = max(float(np.linalg.norm(box.size)) / 2.0 for box in boxes)
    # A point in an inflated box is at most this far from its centre along any axis.
    reach += margin * np.sqrt(3.0)
    low, high = np.min(centres, axis=0) - reach, np.max(centres, axis=0) + reach
    near = np.all((points >= low) & (points <= high), axis=1)
    others = remove_own_points(points[near], boxes, body_poses, margin)
    return np.vstack([points[~near], others])


def point_cloud(points: Vector) -> PointCloud:
    """Converts points, (n, 3), m, to a pydrake PointCloud."""
    cloud = PointCloud(len(points))
    cloud.mutable_xyzs()[:] = points.T
    return cloud


class DepthCloud(LeafSystem):
    """Turns each depth image into a down-sampled cloud in W without the robot.

    Room paper, Sec. 2.1. A cached output: it is computed when there is a new image and
    someone asks.

    .. pydrake_system::

        name: DepthCloud
        input_ports:
        - depth_image
        - body_poses
        output_ports:
        - cloud
        - viewpoint

    - `depth_image`: DepthImage, m.
    - `body_poses`: X_WB of every body when the image was taken, list[RigidTransform];
      need not be connected where the robot has no boxes.
    - `cloud`: centroids of the occupied voxels in W, PointCloud, m; empty where the
      image is.
    - `viewpoint`: p_WCamera, (3,), m.
    """

    def __init__(
        self, params: DepthCloudParams, own_boxes: Sequence[SelfFilterBox] = ()
    ) -> None:
        """Declares the ports.

        Args:
            params: voxels, margin and bounds.
            own_boxes: boxes about the robot's bodies.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._params = params
        self._boxes = tuple(own_boxes)
        everywhere = np.full(3, np.inf)
        self._lower = -everywhere if params.lower is None else np.array(params.lower)
        self._upper = everywhere if params.upper is None else np.array(params.upper)
        nothing = DepthImage(-np.inf, RigidTransform(), 1.0, np.zeros((0, 0)))
        self._image = self.DeclareAbstractInputPort(
            "depth_image", AbstractValue.Make(nothing)
        )
        self._body_poses = self.DeclareAbstractInputPort(
            "body_poses", AbstractValue.Make([RigidTransform()])
        )
        calc_cloud: Callable[..., None] = timed(self, self._calc_cloud)
        self.DeclareAbstractOutputPort(
            "cloud",
            lambda: AbstractValue.Make(PointCloud(0)),
            calc_cloud,
            prerequisites_of_calc={self._image.ticket(), self._body_poses.ticket()},
        )
        self.DeclareVectorOutputPort(
            "viewpoint",
            3,
            timed(self, self._calc_viewpoint),
            prerequisites_of_calc={self._image.ticket()},
        )

    def _calc_cloud(self, context: Context, cloud: AbstractValue) -> None:
        image = eval_abstract(self._image, context, DepthImage)
        points = downsample(depth_to_points(image), self._params.leaf)
        if self._params.lower is not None or self._params.upper is not None:
            points = crop(points, self._lower.tolist(), self._upper.tolist())
        if self._boxes and len(points):
            body_poses = eval_abstract(self._body_poses, context, list)
            margin = self._params.margin
            points = remove_robot(points, self._boxes, body_poses, margin)
        cloud.set_value(point_cloud(points))

    def _calc_viewpoint(self, context: Context, viewpoint: BasicVector) -> None:
        image = eval_abstract(self._image, context, DepthImage)
        p_WC: Vector = image.X_WC.translation()
        set_vector(viewpoint, p_WC)
