"""`footfall check-robot`: tells what a robot of one's own lacks."""

from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import DONE, quiet_drake
from footfall.diagrams.cli.errors import BAD_INPUT, NOT_DONE, bad_input_in_one_line


def check_robot_file(
    robot: Annotated[
        str,
        typer.Argument(
            metavar="FILE", help="A robot's YAML file, or the name of a shipped robot."
        ),
    ],
) -> None:
    """Check a robot of one's own: what is missing, what was derived, does it stand?

    Everything in the file that does not fit the URDF is told, a line each. A robot
    that fits is simulated: it stands for two seconds on contact.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.robot_report import check_robot
        from footfall.models.robots.robot_errors import RobotError

        quiet_drake()
        try:
            report = check_robot(robot)
        except RobotError as error:
            for line in str(error).splitlines():
                typer.echo(f"footfall: {line}", err=True)
            raise typer.Exit(BAD_INPUT) from None
    for line in report.lines():
        typer.echo(line)
    raise typer.Exit(DONE if report.stands else NOT_DONE)
