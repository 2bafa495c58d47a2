"""What is wrong with a robot, all of it at once."""

from collections.abc import Iterable


class RobotError(ValueError):
    """A robot cannot be used; each line of the message names a field and what is wrong.

    Attributes:
        robot: its name or its file.
        problems: "field: reason" each.
    """

    def __init__(self, robot: str, problems: Iterable[str]) -> None:
        """Makes an error of the robot that is called or lies at `robot`."""
        self.robot, self.problems = robot, tuple(problems)
        super().__init__("\n".join(f"{robot}: {problem}" for problem in self.problems))

    @property
    def one_line(self) -> str:
        """The same in one line."""
        return f"{self.robot}: {'; '.join(self.problems)}"
