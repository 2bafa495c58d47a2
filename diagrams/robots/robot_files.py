"""Robots by name or by file: the ones that come with footfall, and users' own."""

import difflib
import functools
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from pydrake.common.yaml import yaml_dump, yaml_load_typed

from footfall.diagrams.schema import (
    FieldError,
    Mapping,
    check,
    parse_yaml,
    plain,
    validate,
)
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_derivation import robot_model, spelt_out
from footfall.models.robots.robot_description import DEFAULT_FILE, RobotDescription
from footfall.models.robots.robot_errors import RobotError

ROBOTS: dict[str, RobotModel] = {"jvrc1": JVRC1}
"""The robots that may be named without a file."""
SHIPPED_FILES: dict[str, Path] = {"jvrc1": DEFAULT_FILE}
"""What is said of each."""
SUFFIXES = (".yaml", ".yml")
"""What the name of a robot's file ends with."""


def is_file(name: str) -> bool:
    """Tells whether a robot is named by its file."""
    return Path(name).suffix.lower() in SUFFIXES


def load_robot(name_or_path: str | Path) -> RobotModel:
    """Reads a robot; what its file leaves out is read off its URDF.

    Args:
        name_or_path: name of a shipped robot, or the path of a YAML file that holds a
            `footfall.models.robots.robot_description.RobotDescription`.

    Raises:
        RobotError: it cannot be used; a line for everything that is wrong.
    """
    name = str(name_or_path)
    if name in ROBOTS:
        return ROBOTS[name]
    file = robot_file(name, Path())
    return described_robot(read_robot_file(file), file)


def robot_file(name: str, folder: Path) -> Path:
    """Gives the file of a robot.

    Args:
        name: of a shipped robot, or of a file.
        folder: that a file's path starts in.

    Raises:
        RobotError: it is neither.
    """
    if name in SHIPPED_FILES:
        return SHIPPED_FILES[name]
    if not is_file(name):
        close = difflib.get_close_matches(name, ROBOTS, n=1)
        hint = f"did you mean {close[0]}?" if close else "a file's name ends with .yaml"
        raise RobotError(name, [f"no such robot; there is {', '.join(ROBOTS)}; {hint}"])
    return folder / name


def read_robot_file(file: Path) -> Mapping:
    """Reads a robot's file as plain data.

    Raises:
        RobotError: it cannot be read or is not YAML.
    """
    try:
        data = parse_yaml(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise RobotError(str(file), ["no such file"]) from None
    except UnicodeDecodeError:
        raise RobotError(str(file), ["not a text file in UTF-8"]) from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise RobotError(str(file), [f"cannot be read: {reason}"]) from None
    except FieldError as error:
        raise RobotError(str(file), [str(error)]) from None
    if not isinstance(data, dict):
        raise RobotError(str(file), ["must hold the fields of a robot"])
    return data


def described_robot(data: Mapping, file: Path) -> RobotModel:
    """Makes the robot of plain data.

    Args:
        data: fields of a `RobotDescription`.
        file: that they are from; paths start in its folder.

    Raises:
        RobotError: it cannot be used; a line for everything that is wrong.
    """
    problems = [*_wrong_fields(data)]
    if problems:
        raise RobotError(str(file), problems)
    try:
        description: RobotDescription = yaml_load_typed(  # type: ignore[no-untyped-call]
            schema=RobotDescription,
            data=yaml_dump(data),  # type: ignore[no-untyped-call]
        )
        validate(description)
    except FieldError as error:
        raise RobotError(str(file), [str(error)]) from None
    return robot_model(description, file)


def _wrong_fields(data: Mapping) -> Iterator[str]:
    """Lists what `check` says of each field by itself."""
    for name, value in data.items():
        try:
            check({name: value}, RobotDescription)
        except FieldError as error:
            yield str(error)


def resolved(robot: RobotModel) -> RobotDescription:
    """Spells out all that is known of a robot, with absolute paths."""
    folders = {name: folder.resolve() for name, folder in robot.packages.items()}
    return spelt_out(replace(robot, urdf=robot.urdf.resolve(), packages=folders))


def model_of(description: RobotDescription) -> RobotModel:
    """Makes the robot of a description whose paths are absolute.

    Raises:
        RobotError: it does not fit its URDF.
    """
    return _model_of(yaml_dump(plain(description)))  # type: ignore[no-untyped-call]


@functools.cache
def _model_of(text: str) -> RobotModel:
    """The same of its YAML: what is asked for at every turn is made once."""
    description: RobotDescription = yaml_load_typed(  # type: ignore[no-untyped-call]
        schema=RobotDescription, data=text
    )
    return robot_model(description, Path("robot.description"))
