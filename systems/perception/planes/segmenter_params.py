"""Parameters of the plane segmentation (stair paper, Table 1)."""

from dataclasses import dataclass, field, replace

import numpy as np

from footfall.models.robots.robot import Sole
from footfall.models.values.validation import (
    MAX_SEED,
    RIGHT_ANGLE,
    Parameters,
    choice,
    number,
)
from footfall.systems.perception.planes.tread_candidates import StairLimits


@dataclass(kw_only=True)
class PlaneSegmenterParams(Parameters):
    """Parameters of the plane segmentation; Table 1's values where it has one."""

    voxel_size: float = number(0.02, "m", least=1e-3)
    """Voxel resolution v, m (Table 1)."""
    seed_resolution: float = number(0.1, "m", above=0.0)
    """Seed resolution R_seed of the supervoxels, m (Table 1)."""
    influence: float = number(0.2, above=0.0, below=1.0)
    """Distance impact factor mu of Eq. 1, in (0, 1) (Table 1)."""
    min_neighbors: int = number(5, least=0, most=25)
    """n_t: voxels with no more occupied neighbours are sparse (Table 1)."""
    slope_tolerance: float = number(
        0.2617993877991494, "rad", above=0.0, below=RIGHT_ANGLE
    )
    """Largest slope to step on, rad: 15 deg; T is 1 + cos of it (Table 1)."""
    neighbors: int = number(10, least=5, most=1000)
    """k of the normals: the paper's compromise of area and time (Sec. 5)."""
    method: str = choice("surfaces", ("surfaces", "supervoxels"))
    """How planes are found: "surfaces" clusters level pieces of columns of a voxel's
    side, "supervoxels" is the paper's way (Algorithm 1), to which `order`,
    `planes_from`, `neighbors`, `min_neighbors`, `seed_resolution`, `influence` and
    `merge_angle` belong."""
    order: str = choice("voxels_first", ("voxels_first", "normals_first"))
    """"normals_first" takes normals of the points, then Filter 1, voxels and Filter 2,
    as in Algorithm 1; "voxels_first" departs from it: normals are those of the voxels'
    means, which range noise of 5 mm and more bends much less, and Filter 2 counts
    neighbours before Filter 1 has taken any."""
    planes_from: str = choice("clusters", ("clusters", "all"))
    """"all": RANSAC over all supervoxels at once, as in the paper; "clusters": over
    each cluster, so that no plane joins separate things."""
    staircase_from: str = choice("chain", ("chain", "size_cluster"))
    """"size_cluster": the largest cluster of segments of like size, as in the paper;
    "chain": the longest flight of segments of a tread's size."""
    merge_angle: float = number(0.14, "rad", above=0.0)
    """Most that the normals of adjacent supervoxels of one cluster differ, rad; ours,
    since the paper (Sec. 4.2) gives no thresholds."""
    bend_angle: float = number(0.1, "rad", above=0.0)
    """Most that the normals of neighbouring pieces of one surface differ, rad, where
    surfaces that hang together are not one plane; of "surfaces"."""
    merge_offset: float = number(0.015, "m", above=0.0)
    """Most that an adjacent supervoxel lies off the plane, or that neighbouring pieces
    of one surface differ in height, m: three times the noise; ours as well."""
    plane_tolerance: float = number(0.015, "m", above=0.0)
    """Most that an inlier of RANSAC lies off its plane, m: three times the noise."""
    max_dz: float = number(0.03, "m", above=0.0)
    """epsilon, largest vertical scale of a tread's segment, m (Sec. 4.3): of
    "size_cluster", and of a lone tread."""
    stairs: StairLimits = field(default_factory=StairLimits)
    """What passes for a staircase."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Seed of RANSAC."""
    threads: int = number(2, least=1, most=256)
    """Threads for the normals; the result does not depend on it."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.seed_resolution >= 2.0 * self.voxel_size:
            raise ValueError(
                "seed_resolution: must be at least two voxels, got "
                f"{self.seed_resolution} m with voxels of {self.voxel_size} m"
            )

    def published(self) -> "PlaneSegmenterParams":
        """Makes parameters that are these but for the paper's own way in all of it."""
        return replace(
            self,
            method="supervoxels",
            order="normals_first",
            planes_from="all",
            staircase_from="size_cluster",
        )

    def min_voxels(self, sole: Sole) -> int:
        """Computes the number of voxels that a sole covers."""
        return int(np.ceil(sole.area / self.voxel_size**2))
