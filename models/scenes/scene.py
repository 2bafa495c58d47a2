"""A scene: the room and what stands in it."""

from dataclasses import dataclass, field

import numpy as np

from footfall.models.scenes.mover import MoverParams
from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.room_obstacles import ClutterParams
from footfall.models.scenes.solids import Box
from footfall.models.scenes.staircase import StaircaseParams, Tread
from footfall.models.values.validation import Parameters
from footfall.models.values.vector import Vector


@dataclass(kw_only=True)
class SceneParams(Parameters):
    """Everything around the robot."""

    room: RoomParams = field(default_factory=RoomParams)
    """The room; its floor is the ground z = 0."""
    staircase: StaircaseParams | None = None
    """The staircase, where there is one."""
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
        names = [box.name for box in (*self.boxes, *self.movers)]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise ValueError(
                    f"boxes[{index}].name: must be unique, got {name!r} again"
                )

        if self.staircase:
            self._check_fit(self.staircase)

    def _check_fit(self, stairs: StaircaseParams) -> None:
        room = self.room
        X_RS = room.X_WR().inverse().multiply(stairs.X_WS())
        length = stairs.steps * stairs.run
        for x in (0.0, length):
            for y in (-stairs.width / 2.0, stairs.width / 2.0):
                p_R: Vector = X_RS.multiply(np.array([x, y, 0.0]))
                if abs(p_R[0]) > room.length / 2 or abs(p_R[1]) > room.width / 2:
                    raise ValueError(
                        "staircase: must lie inside the room, has a corner at "
                        f"{p_R[0]:.3g} m, {p_R[1]:.3g} m from its middle"
                    )
        top = stairs.steps * stairs.rise
        if not top < room.height:
            raise ValueError(
                f"staircase: must end below the ceiling at {room.height:g} m, "
                f"its top tread is at {top:.3g} m"
            )

    def solids(self) -> tuple[Box, ...]:
        """The room's solids, then the staircase's, then the boxes.

        Raises:
            ValueError: a field of the scene or of a part of it is wrong.
        """
        room = self.room.solids()
        stairs = self.staircase.solids() if self.staircase else ()
        boxes = tuple(box.solid() for box in self.boxes)
        self.validate()
        return (*room, *stairs, *boxes)

    def treads(self) -> tuple[Tread, ...]:
        """The true treads, lowest first; empty without a staircase.

        Raises:
            ValueError: a field of the staircase is wrong.
        """
        return self.staircase.treads() if self.staircase else ()
