"""What a scenario asks of its robot."""

from dataclasses import dataclass, field

from models.jvrc1 import JVRC1
from models.validation import (
    require_at_least,
    require_finite,
    require_length,
    require_one_of,
    require_positive,
)

TASKS = ("stair_climbing", "room_crossing", "obstacle_crossing")
"""What a robot may be asked to do."""
MODES = ("dynamic", "quasi_static")
"""How it may do it."""


@dataclass(kw_only=True)
class PushParams:
    """A push to withstand: a constant force at a body's centre of mass."""

    time: float = 5.0
    """When it begins, s."""
    duration: float = 0.1
    """How long it lasts, s."""
    force: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    """The force, along W's axes, N."""
    body: str = JVRC1.torso_body
    """The link of the robot that is pushed."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        require_at_least("time", self.time, 0.0, "s")
        require_positive("duration", self.duration, "s")
        require_length("force", self.force, 3)


@dataclass(kw_only=True)
class TaskParams:
    """What the robot is to do."""

    kind: str = "stair_climbing"
    """What: "stair_climbing", up the staircase to its top tread; "room_crossing", over
    the floor to `goal`; "obstacle_crossing", the same over what lies in the way."""
    mode: str = "dynamic"
    """How: "dynamic", with a moving ZMP under a stabiliser; "quasi_static", so slowly
    that the ZMP stays near a CoM that is always over the stance; not in a room."""
    steps_between_scans: int = 2
    """How many treads are climbed before the robot stands and scans again."""
    goal: list[float] = field(default_factory=lambda: [2.5, 0.0, 0.0])
    """Where the midpoint of the feet is to come to and the heading there, in W, x, y,
    yaw, m and rad; not in "stair_climbing"."""
    environment: str | None = None
    """An XML file of the floor and the boxes that is used in place of the camera, its
    path from the working folder (schema: systems.perception.environment_xml);
    "room_crossing" only."""
    pushes: list[PushParams] = field(default_factory=list)
    """Pushes on the way."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        require_one_of("kind", self.kind, TASKS)
        require_one_of("mode", self.mode, MODES)
        require_at_least("steps_between_scans", self.steps_between_scans, 1)
        require_length("goal", self.goal, 3)
        for index, value in enumerate(self.goal):
            require_finite(f"goal[{index}]", value)
