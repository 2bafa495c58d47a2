"""Flights of steps that differ in rise and run, and platforms between them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.contact_geometry import GREATEST_FRICTION
from footfall.models.scenes.solids import Box, Rgba, upright_pose
from footfall.models.scenes.tread import Tread
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector

COLOR: Rgba = (0.76, 0.62, 0.42, 1.0)


def flight_treads(
    name: str,
    rises: Sequence[float],
    runs: Sequence[float],
    width: float,
    X_WS: RigidTransform,
) -> tuple[Tread, ...]:
    """Computes the treads of a straight flight, lowest first.

    Args:
        name: what their names begin with; "step_1" and so on follow.
        rises: height of each step above the one before, m.
        runs: depth of each tread, m.
        width: across, m.
        X_WS: pose of the flight: at the foot of the first riser, x up the stairs.
    """
    tops, ends = np.cumsum(rises), np.cumsum(runs)
    return tuple(
        Tread(
            f"{name}step_{step}",
            X_WS.multiply(upright_pose(x=float(end - 0.5 * run), z=float(top))),
            np.array([run, width]),
        )
        for step, (top, end, run) in enumerate(zip(tops, ends, runs, strict=True), 1)
    )


def step_box(tread: Tread, height: float, friction: float) -> Box:
    """Makes the solid under a tread, `height` high, m."""
    X_WB = tread.X_WR.multiply(upright_pose(z=-height / 2.0))
    size = np.array([*tread.size, height])
    return Box(tread.name, X_WB, size, friction, COLOR, "stairs")


@dataclass(kw_only=True)
class FlightParams(Parameters):
    """A straight flight whose steps are given one by one; a long run is a landing."""

    name: str = "flight"
    """What it is called in contacts and messages, unique in its scene."""
    rises: list[float] = number([0.14, 0.18, 0.20], "m", above=0.0, fewest=1)
    """Height of each step above the one before, lowest first, m."""
    runs: list[float] = number([0.27, 0.90, 0.30], "m", above=0.0, fewest=1)
    """Depth of each tread, lowest first, m; as many as rises."""
    width: float = number(0.80, "m", above=0.0)
    """Width across, m."""
    closed_risers: bool = True
    """Whether each step is solid down to the foot, or a plate with air beneath."""
    tread_thickness: float = number(0.04, "m", above=0.0)
    """Thickness of the plates where the risers are open, m."""
    friction: float = number(0.8, above=0.0, below=GREATEST_FRICTION)
    """Coulomb friction coefficient between the treads and a sole."""
    x: float = number(0.6, "m")
    """Where the foot of the first riser has its middle, along x of W, m."""
    y: float = number(0.0, "m")
    """The same along y of W, m."""
    z: float = number(0.0, "m", least=0.0)
    """Height of that foot above the floor, m: that of the platform it begins on."""
    yaw: float = number(0.0, "rad")
    """Direction in which the flight goes up, about z of W from its x, rad."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.name:
            raise ValueError("name: must not be empty")
        if len(self.runs) != len(self.rises):
            raise ValueError(
                f"runs: must have as many elements as rises, {len(self.rises)}, "
                f"got {len(self.runs)}"
            )
        if not self.closed_risers and self.tread_thickness >= min(self.rises):
            raise ValueError(
                "tread_thickness: must be less than every rise where risers are open, "
                f"got {self.tread_thickness:g} m at a rise of {min(self.rises):g} m"
            )

    def solids(self) -> tuple[Box, ...]:
        """Makes a box a step, lowest first, "NAME/step_1" and so on.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        return tuple(
            step_box(
                tread,
                float(tread.X_WR.translation()[2]) - self.z
                if self.closed_risers
                else self.tread_thickness,
                self.friction,
            )
            for tread in self.treads()
        )

    def treads(self) -> tuple[Tread, ...]:
        """Computes the true treads, lowest first.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        self.validate()
        X_WS = upright_pose(self.x, self.y, self.z, self.yaw)
        return flight_treads(f"{self.name}/", self.rises, self.runs, self.width, X_WS)


@dataclass(kw_only=True)
class PlatformParams(Parameters):
    """A level block that flights may end at and begin on."""

    name: str = "platform"
    """What it is called in contacts and messages, unique in its scene."""
    size: list[float] = number([1.0, 1.0], "m", above=0.0, length=2)
    """Side lengths along its x and y, m."""
    top: float = number(0.5, "m", above=0.0)
    """Height of its upper face above the floor, m."""
    thickness: float | None = number(None, "m", above=0.0)
    """From its upper to its lower face, m; null for solid down to the floor."""
    friction: float = number(0.8, above=0.0, below=GREATEST_FRICTION)
    """Coulomb friction coefficient between its surface and a sole."""
    x: float = number(0.0, "m")
    """Centre along x of W, m."""
    y: float = number(0.0, "m")
    """Centre along y of W, m."""
    yaw: float = number(0.0, "rad")
    """Direction of its x, about z of W, rad: up the stairs that lead to it."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.name:
            raise ValueError("name: must not be empty")
        if self.thickness is not None and self.thickness > self.top:
            raise ValueError(
                f"thickness: must be at most its top, {self.top:g} m, got "
                f"{self.thickness:g} m"
            )

    def treads(self) -> tuple[Tread, ...]:
        """Computes its upper face.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        self.validate()
        size: Vector = np.array(self.size, dtype=np.float64)
        X_WR = upright_pose(self.x, self.y, self.top, self.yaw)
        return (Tread(f"{self.name}/top", X_WR, size),)

    def solids(self) -> tuple[Box, ...]:
        """Makes its block, "NAME/top".

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        height = self.top if self.thickness is None else self.thickness
        return tuple(step_box(tread, height, self.friction) for tread in self.treads())
