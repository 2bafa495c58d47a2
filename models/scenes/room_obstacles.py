"""Boxes placed at random in a room: clutter to walk through."""

from dataclasses import dataclass

import numpy as np

from footfall.models.scenes.obstacle import BoxParams
from footfall.models.values.validation import MAX_SEED, Parameters, number
from footfall.models.values.vector import Vector

TRIES = 2000
"""Places that are tried before a room counts as full."""


@dataclass(kw_only=True)
class ClutterParams(Parameters):
    """How many boxes stand where, and how large they are."""

    min_count: int = number(6, least=0, most=1000)
    """Fewest boxes."""
    max_count: int = number(10, least=0, most=1000)
    """Most boxes."""
    area: list[float] = number([-1.7, 1.7, -1.9, 1.9], "m", length=4)
    """Where their centres lie: least x, largest x, least y, largest y in W, m."""
    min_side: float = number(0.20, "m", above=0.0)
    """Shortest side, m."""
    max_side: float = number(0.50, "m", above=0.0)
    """Longest side, m."""
    max_height: float = number(0.80, "m", above=0.0)
    """Tallest box, m; the lowest one is `min_side` high."""
    gap: float = number(0.12, "m", least=0.0)
    """Least distance between the circles around two boxes, m: twice the gap at which
    perception tells them apart."""
    keep_clear: float = number(0.55, "m", least=0.0)
    """Least distance of a box from the places that are kept clear, m: the robot's
    footprint with its margin, and some."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Of places and sizes."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        for small, large in (
            ("min_count", "max_count"),
            ("min_side", "max_side"),
            ("min_side", "max_height"),
        ):
            if getattr(self, large) < getattr(self, small):
                raise ValueError(
                    f"{large}: must be at least {small}, {getattr(self, small):g}, "
                    f"got {getattr(self, large):g}"
                )
        if self.area[0] > self.area[1] or self.area[2] > self.area[3]:
            raise ValueError(
                f"area: must be least x, largest x, least y, largest y, got {self.area}"
            )


def place_boxes(params: ClutterParams, clear: Vector) -> list[BoxParams]:
    """Boxes at random places that do not touch.

    Args:
        params: how many, where and how large.
        clear: places that are kept clear, (n, 2), m: start and goal.

    Returns:
        The boxes, named "clutter_0" and so on; the same for the same seed.

    Raises:
        ValueError: a parameter is wrong, or there is no room for so many.
    """
    params.validate()
    rng = np.random.default_rng(params.seed)
    wanted = int(rng.integers(params.min_count, params.max_count + 1))
    boxes: list[BoxParams] = []
    low = np.array([params.area[0], params.area[2]])
    high = np.array([params.area[1], params.area[3]])
    for _ in range(TRIES):
        if len(boxes) == wanted:
            break
        sides = rng.uniform(params.min_side, params.max_side, 2)
        height = rng.uniform(params.min_side, params.max_height)
        p, yaw = rng.uniform(low, high), rng.uniform(-np.pi, np.pi)
        radius = float(np.linalg.norm(sides)) / 2.0
        apart = all(
            float(np.hypot(box.x - p[0], box.y - p[1]))
            > radius + np.hypot(box.size[0], box.size[1]) / 2.0 + params.gap
            for box in boxes
        )
        away = np.linalg.norm(clear - p, axis=1)
        free = bool(np.all(away > radius + params.keep_clear))
        if apart and free:
            boxes.append(
                BoxParams(
                    name=f"clutter_{len(boxes)}",
                    x=float(p[0]),
                    y=float(p[1]),
                    yaw=float(yaw),
                    size=[float(sides[0]), float(sides[1]), float(height)],
                )
            )
    if len(boxes) == wanted:
        return boxes
    raise ValueError(f"max_count: no room for {wanted} boxes in {params.area} m")
