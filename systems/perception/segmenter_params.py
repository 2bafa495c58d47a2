"""Parameters of the plane segmentation (stair paper, Table 1)."""

from dataclasses import dataclass, field

import numpy as np

from systems.perception.stair_chain import StairLimits


@dataclass(kw_only=True)
class PlaneSegmenterParams:
    """Parameters of the plane segmentation; Table 1's values where it has one."""

    voxel_size: float = 0.02
    """Voxel resolution v, m (Table 1)."""
    seed_resolution: float = 0.1
    """Seed resolution R_seed of the supervoxels, m (Table 1)."""
    influence: float = 0.2
    """Distance impact factor mu of Eq. 1, in (0, 1) (Table 1)."""
    min_neighbors: int = 5
    """n_t: voxels with no more occupied neighbours are sparse (Table 1)."""
    slope_tolerance: float = 0.2617993877991494
    """Largest slope to step on, rad: 15 deg; T is 1 + cos of it (Table 1)."""
    neighbors: int = 10
    """k of the normals: the paper's compromise of area and time (Sec. 5)."""
    order: str = "voxels_first"
    """"normals_first" takes normals of the points, then voxels, as in Algorithm 1;
    "voxels_first" takes normals of the voxels' means, which range noise of 5 mm and
    more bends much less."""
    planes_from: str = "clusters"
    """"all": RANSAC over all supervoxels at once, as in the paper; "clusters": over
    each cluster, so that no plane joins separate things."""
    staircase_from: str = "chain"
    """"size_cluster": the largest cluster of segments of like size, as in the paper;
    "chain": the longest flight of segments of a tread's size."""
    merge_angle: float = 0.14
    """Most that the normals of adjacent supervoxels of one cluster differ, rad."""
    merge_offset: float = 0.015
    """Most that an adjacent supervoxel lies off the plane, m: three times the noise."""
    plane_tolerance: float = 0.015
    """Most that an inlier of RANSAC lies off its plane, m: three times the noise."""
    max_dz: float = 0.03
    """epsilon, largest vertical scale of a tread's segment, m (Sec. 4.3)."""
    foot_length: float = 0.225
    """Length of the sole, m: Filter 3 drops what is smaller than the sole."""
    foot_width: float = 0.084
    """Width of the sole, m."""
    stairs: StairLimits = field(default_factory=StairLimits)
    """What passes for a staircase."""
    seed: int = 0
    """Seed of RANSAC."""
    threads: int = 2
    """Threads for the normals; the result does not depend on it."""

    def validate(self) -> None:
        """Checks the values.

        Raises:
            ValueError: a field has a value that makes no sense.
        """
        positive = (
            "voxel_size",
            "seed_resolution",
            "merge_angle",
            "merge_offset",
            "plane_tolerance",
            "max_dz",
            "foot_length",
            "foot_width",
            "threads",
        )
        for name in positive:
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise ValueError(f"{name}: must be positive, got {value}")
        if not self.seed_resolution >= 2.0 * self.voxel_size:
            raise ValueError(
                "seed_resolution: must be at least two voxels, got "
                f"{self.seed_resolution} m with voxels of {self.voxel_size} m"
            )
        if not 0.0 < self.influence < 1.0:
            raise ValueError(f"influence: must be in (0, 1), got {self.influence}")
        if not 0 <= self.min_neighbors <= 25:
            raise ValueError(
                f"min_neighbors: must be in 0..25, got {self.min_neighbors}"
            )
        if not 0.0 < self.slope_tolerance < np.pi / 2:
            raise ValueError(
                f"slope_tolerance: must be in (0, pi/2), got {self.slope_tolerance}"
            )
        if not self.neighbors >= 5:
            raise ValueError(f"neighbors: must be at least 5, got {self.neighbors}")
        choices = {
            "order": ("voxels_first", "normals_first"),
            "planes_from": ("clusters", "all"),
            "staircase_from": ("chain", "size_cluster"),
        }
        for name, allowed in choices.items():
            if getattr(self, name) not in allowed:
                raise ValueError(
                    f"{name}: must be one of {', '.join(allowed)}, "
                    f"got {getattr(self, name)}"
                )

    def min_voxels(self) -> int:
        """Voxels that a sole covers."""
        area = self.foot_length * self.foot_width
        return int(np.ceil(area / self.voxel_size**2))
