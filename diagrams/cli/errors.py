"""Errors of the command line: one line on stderr and an exit status."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import typer

from footfall.diagrams.interruption import StopSignals

NOT_DONE, BAD_INPUT = 1, 2
"""Exit status: the task was not done, it could not be understood."""


class OptionError(ValueError):
    """An option cannot be understood; the message is one line that names it."""


@contextmanager
def run_ends_in_one_line(stop: StopSignals) -> Iterator[None]:
    """Ends in one line, with its exit status, what a signal or a full disk ended."""
    from footfall.diagrams.run_folder import RecordingError

    try:
        yield
    except RecordingError as error:
        typer.echo(f"footfall: {error}", err=True)
        raise typer.Exit(NOT_DONE) from None
    except KeyboardInterrupt as interrupt:
        typer.echo(f"footfall: {str(interrupt) or 'interrupted'}", err=True)
        raise typer.Exit(stop.exit_status()) from None


@contextmanager
def bad_input_in_one_line() -> Iterator[None]:
    """Ends what the user can mend in one line on stderr and exit status 2."""
    try:
        yield
    except Exception as error:
        if not isinstance(error, _bad_input_errors()):
            raise
        line = " ".join(_message(error).split())
        typer.echo(f"footfall: {line}", err=True)
        raise typer.Exit(BAD_INPUT) from None


def _message(error: Exception) -> str:
    """Puts the file's name before what the system says of it, as our messages do."""
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{error.filename}: {error.strerror}"
    one_line = getattr(error, "strerror", None) or getattr(error, "one_line", None)
    return one_line or str(error)


def _bad_input_errors() -> tuple[type[Exception], ...]:
    """Lists the errors of what was imported; what was not has raised nothing."""
    homes = (
        ("footfall.diagrams.run_folder", "OutError"),
        ("footfall.diagrams.scenario", "ScenarioError"),
        ("footfall.diagrams.schema", "FieldError"),
        ("footfall.diagrams.signals", "RunError"),
        ("footfall.diagrams.sweep.definition", "SweepError"),
        ("footfall.models.robots.robot_errors", "RobotError"),
        ("footfall.systems.perception.clouds.cloud_files", "CloudFileError"),
        ("footfall.systems.perception.room.environment_xml", "EnvironmentFileError"),
    )
    own = [
        getattr(sys.modules[home], name) for home, name in homes if home in sys.modules
    ]
    return OptionError, OSError, *own
