"""Where the files lie that a URDF or a robot's description names.

A URDF names its meshes as `package://NAME/PATH`. NAME is looked for, in this order,

1. in what the description's `packages` says,
2. among the folders that the URDF lies in, and beside them,
3. in ROS_PACKAGE_PATH and AMENT_PREFIX_PATH,
4. among the installed Python packages (`jvrc_description`),
5. in the `share` folders of the Python environment, where wheels put data
   (`icub-models`), those of cmeel included (`example-robot-data`).
"""

import os
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path

PACKAGE = "package://"


def find_file(uri: str, beside: Path, packages: Mapping[str, Path]) -> Path:
    """Finds the file that a URI or a path names.

    Args:
        uri: `package://NAME/PATH`, `file://PATH`, or a path.
        beside: the file that names it; relative paths start in its folder.
        packages: folders by name, looked at before anything else.

    Raises:
        ValueError: there is no such package, or no such file in it.
    """
    if not uri.startswith(PACKAGE):
        path = beside.parent / uri.removeprefix("file://")
        if not path.is_file():
            raise ValueError(f"there is no file {path}")
        return path
    name, _, inside = uri.removeprefix(PACKAGE).lstrip("/").partition("/")
    found = None
    for folder in _folders(name, beside, packages):
        found = folder / inside
        if found.is_file():
            return found
    if found is not None:
        raise ValueError(f"there is no file {found}")
    raise ValueError(
        f"there is no package {name!r}: name its folder in `packages`, or install it"
    )


def _folders(name: str, beside: Path, packages: Mapping[str, Path]) -> Iterator[Path]:
    """Finds the folders that a package of this name has, the best first."""
    if name in packages:
        yield packages[name]
    candidates = [
        candidate
        for folder in beside.parents
        for candidate in (folder if folder.name == name else folder / name,)
    ]
    candidates += [Path(folder) / name for folder in _listed("ROS_PACKAGE_PATH")]
    candidates += [
        Path(folder) / "share" / name for folder in _listed("AMENT_PREFIX_PATH")
    ]
    candidates += _python_package(name)
    shares = [Path(sysconfig.get_path("data")) / "share"]
    shares += [Path(folder) / "cmeel.prefix" / "share" for folder in sys.path]
    shares += [Path(folder) / "share" for folder in sys.path]
    candidates += [share / name for share in shares]
    yield from (candidate for candidate in candidates if candidate.is_dir())


def _listed(variable: str) -> list[str]:
    return [item for item in os.environ.get(variable, "").split(os.pathsep) if item]


def _python_package(name: str) -> list[Path]:
    """Folders of an installed Python package, which is not imported."""
    if not name.isidentifier():
        return []
    spec = find_spec(name)
    folders = None if spec is None else spec.submodule_search_locations
    return [Path(folder) for folder in folders or ()]
