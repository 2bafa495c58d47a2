"""A scene: the room and what stands in it."""

from dataclasses import dataclass, field

import numpy as np

from footfall.models.scenes.flight import FlightParams, PlatformParams
from footfall.models.scenes.mover import MoverParams
from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.room_obstacles import ClutterParams
from footfall.models.scenes.scene_model import SceneModelParams
from footfall.models.scenes.solids import GROUND, Solid
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.scenes.tread import Tread
from footfall.models.values.geometry import rectangle_corners_world
from footfall.models.values.validation import Parameters


@dataclass(kw_only=True)
class SceneParams(Parameters):
    """Everything around the robot."""

    room: RoomParams = field(default_factory=RoomParams)
    """The room; its floor is the ground z = 0."""
    staircase: StaircaseParams | None = None
    """The staircase, where there is one."""
    flights: list[FlightParams] = field(default_factory=list)
    """Flights whose steps differ."""
    platforms: list[PlatformParams] = field(default_factory=list)
    """Level blocks that flights end at and begin on."""
    models: list[SceneModelParams] = field(default_factory=list)
    """What stands there by a file: a mesh, an SDF or a URDF model."""
    boxes: list[BoxParams] = field(default_factory=list)
    """Obstacles and clutter."""
    movers: list[MoverParams] = field(default_factory=list)
    """Boxes that move."""
    clutter: ClutterParams | None = None
    """More boxes at places drawn at random, where there are to be any."""

    def validate(self) -> None:
        """Checks every part, and what concerns more than one.

        Raises:
            ValueError: a field of a part is wrong, two boxes have the same name, or
                the staircase does not fit into the room.
        """
        super().validate()
        self._check_names("boxes", [box.name for box in (*self.boxes, *self.movers)])
        named = [
            (f"{group}[{index}]", part)
            for group in ("flights", "platforms", "models")
            for index, part in enumerate(getattr(self, group))
        ]
        known = {"room", "staircase", "box"}
        for path, part in named:
            if part.name in known:
                raise ValueError(
                    f"{path}.name: must be unique and none of room, staircase, box, "
                    f"got {part.name!r}"
                )
            known.add(part.name)
        if self.staircase:
            self._check_fit("staircase", self.staircase.treads())
        for path, part in named:
            self._check_fit(path, part.treads())

    def _parts(self) -> list[FlightParams | PlatformParams | SceneModelParams]:
        return [*self.flights, *self.platforms, *self.models]

    @staticmethod
    def _check_names(group: str, names: list[str]) -> None:
        for index, name in enumerate(names):
            if name in names[:index]:
                raise ValueError(
                    f"{group}[{index}].name: must be unique, got {name!r} again"
                )

    def _check_fit(self, path: str, treads: tuple[Tread, ...]) -> None:
        room = self.room
        X_RW = room.X_WR().inverse()
        for tread in treads:
            corners = rectangle_corners_world(tread.X_WR, tread.size)
            for p_R in np.array(X_RW.multiply(corners.T)).T:
                if abs(p_R[0]) > room.length / 2 or abs(p_R[1]) > room.width / 2:
                    raise ValueError(
                        f"{path}: must lie inside the room, has a corner at "
                        f"{p_R[0]:.3g} m, {p_R[1]:.3g} m from its middle"
                    )
        top = max((t.X_WR.translation()[2] for t in treads), default=0.0)
        if not top < room.height:
            raise ValueError(
                f"{path}: must end below the ceiling at {room.height:g} m, "
                f"its top tread is at {top:.3g} m"
            )

    def solids(self) -> tuple[Solid, ...]:
        """The room's solids, then what is climbed, the models and the boxes.

        Raises:
            ValueError: a field of the scene or of a part of it is wrong.
        """
        room = self.room.solids()
        stairs = self.staircase.solids() if self.staircase else ()
        parts = [solid for part in self._parts() for solid in part.solids()]
        boxes = tuple(box.solid() for box in self.boxes)
        self.validate()
        return (*room, *stairs, *parts, *boxes)

    def ground_names(self) -> frozenset[str]:
        """The names of the solids that soles may touch.

        Raises:
            ValueError: a field of the scene or of a part of it is wrong.
        """
        return frozenset(s.name for s in self.solids() if s.role in GROUND)

    def treads(self) -> tuple[Tread, ...]:
        """The true treads, lowest first; empty where there is nothing to climb.

        Raises:
            ValueError: a field of what they belong to is wrong.
        """
        parts = self._parts()
        treads = list(self.staircase.treads() if self.staircase else ())
        treads += [tread for part in parts for tread in part.treads()]
        if parts:
            treads.sort(key=lambda tread: float(tread.X_WR.translation()[2]))
        return tuple(treads)
