"""The folder of a run: its name, and that no two runs ever meet in one."""

import hashlib
import re
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from footfall.diagrams.scenario import Scenario, save_scenario
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signals import SCENARIO_FILE, SIGNALS_FOLDER

CHANGES_LENGTH = 60
"""How much of a folder's name the changes to a scenario may take, characters."""


class RecordingError(RuntimeError):
    """A run's folder cannot be written to any more; one line that names it."""


class OutError(ValueError):
    """A run cannot go where it was to; the message is one line that names the place."""


def require_usable(out: Path) -> None:
    """Tells before a run of minutes, rather than after it, that it cannot be kept.

    Raises:
        OutError: `out` is not an empty folder, or cannot be made or written to.
    """
    try:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise OutError(f"--out {out}: exists and is not an empty folder")
        place = out if out.exists() else out.parent
        place.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=place):
            pass
    except OSError as error:
        raise OutError(f"--out {out}: cannot be written: {error.strerror}") from error


def begin_run(folder: Path, scenario: Scenario) -> None:
    """Makes the folder of a run that begins, or takes an empty one.

    Of two runs that want the same one, at the same moment too, one gets it.

    Raises:
        FileExistsError: it exists and is not empty.
        OSError: it cannot be made or written to; nothing is left of it.
    """
    taken = FileExistsError(f"{folder}: exists and is not empty")
    made = _make(folder)
    if not made and (not folder.is_dir() or any(folder.iterdir())):
        raise taken
    try:
        (folder / SIGNALS_FOLDER).mkdir()
    except FileExistsError:
        raise taken from None
    try:
        with whole_file(folder / SCENARIO_FILE) as path:
            save_scenario(scenario, path)
    except OSError:
        with suppress(OSError):
            (folder / SIGNALS_FOLDER).rmdir()
            if made:
                folder.rmdir()
        raise


def _make(folder: Path) -> bool:
    """Makes a folder; False where it was there before."""
    try:
        folder.mkdir(parents=True)
    except FileExistsError:
        return False
    return True


def make_numbered(parent: Path, name: str) -> Path:
    """Makes the first of NAME, NAME-2, NAME-3, ... that is not there yet.

    Args:
        parent: where; made if missing.
        name: of the folder.

    Raises:
        OSError: none can be made.
    """
    folder, number = parent / name, 1
    while not _make(folder):
        number += 1
        folder = parent / f"{name}-{number}"
    return folder


def run_name(scenario: str, seed: int, changes: Sequence[str] = ()) -> str:
    """Names the folder of a run: SCENARIO-seedN, then what was changed.

    Args:
        scenario: its name.
        seed: of everything random.
        changes: "key=value" each. Where they do not go into a file's name as they are,
            or are too long, they are shortened and end with a hash of all of them.
    """
    text = ",".join(change for change in changes if not _is_seed(change))
    plain = re.sub(r"[^A-Za-z0-9_.,=+-]+", "_", text)
    if plain != text or len(plain) > CHANGES_LENGTH:
        digest = hashlib.sha256(text.encode()).hexdigest()[:6]
        plain = f"{plain[: CHANGES_LENGTH - 7].rstrip('_.,=-')}-{digest}"
    return f"{scenario}-seed{seed}" + (f"-{plain}" if plain else "")


def _is_seed(change: str) -> bool:
    return change.partition("=")[0].strip() == "simulation.seed"
