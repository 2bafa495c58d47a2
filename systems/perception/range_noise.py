"""Noise model of a depth sensor: the standard deviation of its points."""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector


@dataclass(kw_only=True)
class RangeNoise(Parameters):
    """Deviation along the ray that grows with the square of the distance.

    Khoshelham and Elberink (2012), Eq. 11, as the room paper quotes it.
    """

    near: float = number(0.002, "m", least=0.0)
    """Standard deviation close by, m (room paper: a few millimetres)."""
    growth: float = number(0.0016, "1/m", least=0.0)
    """Its growth with the square of the distance, 1/m (room paper: 4 cm at the far
    end of a range of 5 m)."""

    def deviation(self, distance: Vector) -> Vector:
        """Computes the standard deviation along the ray, m, at distances (...), m."""
        return np.asarray(self.near + self.growth * distance**2)

    def height_deviation(self, points: Vector, viewpoint: Vector) -> Vector:
        """Computes the standard deviation of the heights of points.

        Args:
            points: (n, 3), m.
            viewpoint: where they were seen from, (3,), m.

        Returns:
            (n,), m: the part along z of the deviation along the ray.
        """
        ray = points - viewpoint
        distance = np.maximum(np.sqrt(np.einsum("ij,ij->i", ray, ray)), 1e-9)
        return np.asarray(self.deviation(distance) * np.abs(ray[:, 2]) / distance)


def slide_to_plane(points: Vector, viewpoint: Vector, coefficients: Vector) -> Vector:
    """Moves points along the rays they were seen on to a plane they belong to.

    A depth sensor errs along the ray; where the plane is known better than the single
    point, this takes the error out of the point's place on the plane.

    Args:
        points: (n, 3), m.
        viewpoint: where they were seen from, (3,), m, off the plane.
        coefficients: (A, B, C, D) of the plane, (4,).

    Returns:
        (n, 3), m; a point whose ray runs along the plane stays where it is.
    """
    normal = coefficients[:3]
    ray = points - viewpoint
    toward = ray @ normal
    height = float(viewpoint @ normal + coefficients[3])
    sound = np.abs(toward) > 1e-6
    scale = np.divide(-height, toward, out=np.ones_like(toward), where=sound)
    return np.asarray(viewpoint + ray * scale[:, np.newaxis])
