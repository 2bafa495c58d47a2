"""Files that are made once and kept in a cache folder, whole or made again."""

import atexit
import functools
import hashlib
import logging
import os
import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

_logger = logging.getLogger("footfall")


def cached_files(
    folder: Path, names: Sequence[str], make: Callable[[], Sequence[bytes]]
) -> list[Path]:
    """Files of the cache, made where one is missing or is not what was written.

    Beside each lies its digest, NAME.sha256, as `sha256sum --check` reads it. Where the
    folder cannot be written, a warning says so and a temporary one takes its place
    until the process ends.

    Args:
        folder: of the cache; is made where it is missing.
        names: of the files.
        make: gives their contents, in the order of the names.

    Returns:
        Their paths, in the order of the names.

    Raises:
        OSError: a file can be written neither there nor in a temporary folder.
    """
    paths = [folder / name for name in names]
    if all(_is_whole(path) for path in paths):
        return paths
    paths = [_writable(folder) / name for name in names]
    if not all(_is_whole(path) for path in paths):
        for path, content in zip(paths, make(), strict=True):
            _write(path, content)
            _write(_digest_file(path), _digest_line(path, content))
    return paths


@functools.cache
def _writable(folder: Path) -> Path:
    """The folder, or a temporary one in its place; the same at every call."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError as error:
        _logger.warning(
            "cannot write the cache %s (%s): meshes go to a temporary folder",
            folder,
            error.strerror,
        )
    spare = tempfile.mkdtemp(prefix="footfall-")
    atexit.register(shutil.rmtree, spare, ignore_errors=True)
    return Path(spare)


def _is_whole(path: Path) -> bool:
    """Tells whether a file is the one that its digest was written of."""
    try:
        return _digest_file(path).read_bytes() == _digest_line(path, path.read_bytes())
    except OSError:
        return False


def _digest_file(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _digest_line(path: Path, content: bytes) -> bytes:
    return f"{hashlib.sha256(content).hexdigest()}  {path.name}\n".encode()


def _write(path: Path, content: bytes) -> None:
    """Writes in one piece: another process may make the same file at the same time."""
    partial = path.with_name(f"{path.name}.{os.getpid()}.partial")
    partial.write_bytes(content)
    partial.replace(path)
