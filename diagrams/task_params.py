"""What a scenario asks of its robot."""

from dataclasses import dataclass, field

from footfall.models.values.validation import LARGEST, Parameters, choice, number

TASKS = ("stair_climbing", "room_crossing", "obstacle_crossing", "stand")
"""What a robot may be asked to do."""
MODES = ("dynamic", "quasi_static")
"""How it may do it."""


@dataclass(kw_only=True)
class PushParams(Parameters):
    """A push to withstand: a constant force at a body's centre of mass."""

    time: float = number(5.0, "s", least=0.0)
    """When it begins, s."""
    duration: float = number(0.1, "s", above=0.0)
    """How long it lasts, s."""
    force: list[float] = number([0.0, 0.0, 0.0], "N", length=3)
    """The force, along W's axes, N."""
    body: str = ""
    """The link of the robot that is pushed; by default its torso."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not any(self.force):
            raise ValueError(f"force: must not be zero, got {self.force} N")


@dataclass(kw_only=True)
class TaskParams(Parameters):
    """What the robot is to do."""

    kind: str = choice("stair_climbing", TASKS)
    """What: "stair_climbing", up the staircase to its top tread; "room_crossing", over
    the floor to `goal`; "obstacle_crossing", the same over what lies in the way;
    "stand", where it is for `stand_time`."""
    mode: str = choice("dynamic", MODES)
    """How: "dynamic", with a moving ZMP under a stabiliser; "quasi_static", so slowly
    that the ZMP stays near a CoM that is always over the stance; only on stairs and
    over obstacles."""
    steps_between_scans: int = number(2, least=1, most=1000)
    """How many treads are climbed before the robot stands and scans again."""
    stand_time: float = number(3.0, "s", above=0.0)
    """How long the robot stands, s; "stand" only."""
    goal: list[float] = number([2.5, 0.0, 0.0], "m", length=3)
    """Where the midpoint of the feet is to come to and the heading there, in W, x, y,
    yaw, m and rad; not in "stair_climbing" and "stand"."""
    environment: str | None = None
    """An XML file of the floor and the boxes that is used in place of the camera, its
    path from the working folder; "room_crossing" only. Its schema:
    footfall.systems.perception.room.environment_xml."""
    pushes: list[PushParams] = field(default_factory=list)
    """Pushes on the way."""

    def validate(self) -> None:
        """Checks every field, and the heading of the goal.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if abs(self.goal[2]) > LARGEST["rad"]:
            raise ValueError(
                f"goal[2]: must be at most a turn, got {self.goal[2]:g} rad"
            )
