"""A scene: the room and what stands in it."""

from dataclasses import dataclass, field

from models.obstacle import BoxParams
from models.room import RoomParams
from models.solids import Box
from models.staircase import StaircaseParams, Tread


@dataclass(kw_only=True)
class SceneParams:
    """Everything around the robot; none of it moves."""

    room: RoomParams = field(default_factory=RoomParams)
    """The room; its floor is the ground z = 0."""
    staircase: StaircaseParams | None = None
    """The staircase, where there is one."""
    boxes: list[BoxParams] = field(default_factory=list)
    """Obstacles and clutter."""

    def validate(self) -> None:
        """Checks what concerns more than one part; each part checks itself.

        Raises:
            ValueError: two boxes have the same name.
        """
        names = [box.name for box in self.boxes]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise ValueError(
                    f"boxes[{index}].name: must be unique, got {name!r} again"
                )

    def solids(self) -> tuple[Box, ...]:
        """The room's solids, then the staircase's, then the boxes.

        Raises:
            ValueError: a field of the scene or of a part of it is wrong.
        """
        self.validate()
        stairs = self.staircase.solids() if self.staircase else ()
        boxes = tuple(box.solid() for box in self.boxes)
        return (*self.room.solids(), *stairs, *boxes)

    def treads(self) -> tuple[Tread, ...]:
        """The true treads, lowest first; empty without a staircase.

        Raises:
            ValueError: a field of the staircase is wrong.
        """
        return self.staircase.treads() if self.staircase else ()
