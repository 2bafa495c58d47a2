"""Level planes by supervoxels: the stair paper's way.

Stair paper (Zhang, Caron, Nakamura 2016), Algorithm 1 and Table 1. Every stage is a
pure function whose result can be looked at. All of it in a frame G whose z points up.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from footfall.models.robots.robot import Sole
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.normals import (
    estimate_normals,
    filter_slopes,
    orient_normals,
)
from footfall.systems.perception.planes.planes import (
    FittedPlane,
    Patch,
    assign_support,
    make_patches,
    ransac_planes,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.supervoxels import (
    Supervoxels,
    cluster_supervoxels,
    filter_small,
    merge_supervoxels,
)
from footfall.systems.perception.planes.voxels import (
    VoxelGrid,
    adjacent_voxels,
    filter_sparse,
    keep_pairs,
    voxelize,
)

DOWN = np.array([0.0, 0.0, -1.0])
"""Gravity's direction in the gravity-aligned frame G that the stages work in."""


@dataclass(frozen=True, eq=False)
class LevelVoxels:
    """Voxels that Filters 1 and 2 leave: C of Algorithm 1."""

    points: Vector
    """Representative points, (m, 3), m."""
    normals: Vector
    """Their unit normals, (m, 3)."""
    pairs: NDArray[np.int64]
    """Adjacent ones, (p, 2)."""
    grid: VoxelGrid
    """The voxels before the filters."""
    member: NDArray[np.int64]
    """Index in the grid of each of the m."""
    grid_pairs: NDArray[np.int64]
    """Adjacent voxels of the grid, (q, 2)."""


def filter_level(
    cloud: Vector, params: PlaneSegmenterParams, viewpoint: Vector | None
) -> LevelVoxels:
    """Runs Algorithm 1, lines 1 to 12: normals, Filter 1, voxels, Filter 2.

    Args:
        cloud: finite points in G, (n, 3), m.
        params: parameters.
        viewpoint: where they were seen from, (3,), m.
    """

    def normals_of(points: Vector) -> Vector:
        normals = estimate_normals(points, params.neighbors, params.threads)
        return orient_normals(points, normals, DOWN, viewpoint)

    if params.order == "normals_first":
        normals = normals_of(cloud)
        level = filter_slopes(normals, DOWN, params.slope_tolerance)
        grid = voxelize(cloud, params.voxel_size)
        occupied = voxelize(cloud[level], params.voxel_size)
        source = np.flatnonzero(level)[occupied.representative]
        voxel = grid.voxel_of_point[source]
        own = adjacent_voxels(occupied)
        kept = filter_sparse(own, len(source), params.min_neighbors)
        return LevelVoxels(
            points=cloud[source[kept]],
            normals=normals[source[kept]],
            pairs=keep_pairs(own, kept),
            grid=grid,
            member=voxel[kept],
            grid_pairs=adjacent_voxels(grid),
        )
    grid = voxelize(cloud, params.voxel_size)
    pairs = adjacent_voxels(grid)
    normals = normals_of(grid.mean)
    kept = filter_sparse(pairs, len(grid.keys), params.min_neighbors)
    kept &= filter_slopes(normals, DOWN, params.slope_tolerance)
    return LevelVoxels(
        points=cloud[grid.representative[kept]],
        normals=normals[kept],
        pairs=keep_pairs(pairs, kept),
        grid=grid,
        member=np.flatnonzero(kept),
        grid_pairs=pairs,
    )


def cluster_level(
    voxels: LevelVoxels, params: PlaneSegmenterParams, sole: Sole
) -> tuple[Supervoxels, NDArray[np.int64]]:
    """Grows supervoxels, clusters them and applies Filter 3.

    Returns:
        The supervoxels and the cluster of each voxel, (m,); -1 for none.
    """
    supervoxels = cluster_supervoxels(
        voxels.points,
        voxels.normals,
        voxels.pairs,
        seed_resolution=params.seed_resolution,
        influence=params.influence,
    )
    clusters = merge_supervoxels(
        supervoxels,
        voxels.pairs,
        angle=params.merge_angle,
        offset=params.merge_offset,
    )
    return supervoxels, filter_small(clusters, params.voxel_size, sole.area)


def fit_planes(
    voxels: LevelVoxels,
    clusters: NDArray[np.int64],
    params: PlaneSegmenterParams,
    sole: Sole,
) -> tuple[FittedPlane, ...]:
    """Fits RANSAC planes within the slope tolerance, larger than a sole."""
    of = clusters if params.planes_from == "clusters" else np.minimum(clusters, 0)
    planes = ransac_planes(
        voxels.points,
        of,
        tolerance=params.plane_tolerance,
        min_inliers=params.min_voxels(sole),
        rng=np.random.default_rng(params.seed),
    )
    if not planes:
        return planes
    normals = np.array([plane.normal for plane in planes])
    level = filter_slopes(normals, DOWN, params.slope_tolerance)
    return tuple(plane for plane, good in zip(planes, level, strict=True) if good)


def bound_planes(
    planes: tuple[FittedPlane, ...],
    voxels: LevelVoxels,
    cloud: Vector,
    params: PlaneSegmenterParams,
) -> tuple[Patch, ...]:
    """Bounds the planes by the points of the cloud."""
    owner = assign_support(
        planes,
        voxels.member,
        voxels.grid.mean,
        voxels.grid_pairs,
        tolerance=params.plane_tolerance,
        rings=2,
    )
    return make_patches(
        planes,
        owner,
        voxels.grid.index,
        voxels.grid.voxel_of_point,
        cloud,
        voxel_size=params.voxel_size,
        tolerance=params.plane_tolerance,
    )
