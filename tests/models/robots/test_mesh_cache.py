"""Files of the cache: made once, whole, in a folder that can be written."""

import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest

from footfall.models.robots.mesh_cache import cached_files

NAMES = ("a.gltf", "a.obj")
CONTENTS = (b"seen", b"met")


class Maker:
    """Makes the files and counts how often."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self) -> Sequence[bytes]:
        """The contents."""
        self.calls += 1
        return CONTENTS


def contents(paths: Sequence[Path]) -> tuple[bytes, ...]:
    """Of all files."""
    return tuple(path.read_bytes() for path in paths)


def test_are_made_once(tmp_path: Path) -> None:
    """In the folder, which is made too, under their names; nothing else is left."""
    make, folder = Maker(), tmp_path / "deep" / "cache"
    paths = cached_files(folder, NAMES, make)
    assert paths == [folder / name for name in NAMES]
    assert contents(paths) == CONTENTS
    assert cached_files(folder, NAMES, make) == paths
    assert make.calls == 1
    digests = {f"{name}.sha256" for name in NAMES}
    assert {path.name for path in folder.iterdir()} == {*NAMES, *digests}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("left", [b"", b"m", b"damaged"])
def test_one_that_was_cut_short_is_made_again(
    tmp_path: Path, name: str, left: bytes
) -> None:
    """Or that was altered, or whose digest is not there."""
    make = Maker()
    cached_files(tmp_path, NAMES, make)
    (tmp_path / name).write_bytes(left)
    assert contents(cached_files(tmp_path, NAMES, make)) == CONTENTS
    (tmp_path / f"{name}.sha256").unlink()
    assert contents(cached_files(tmp_path, NAMES, make)) == CONTENTS
    assert make.calls == 3


def test_digests_are_those_of_sha256sum(tmp_path: Path) -> None:
    """So that a person can check the cache too."""
    cached_files(tmp_path, NAMES, Maker())
    for name in NAMES:
        command = ["sha256sum", "--check", "--status", f"{name}.sha256"]
        subprocess.run(command, check=True, cwd=tmp_path)


def test_a_cache_that_cannot_be_written_has_a_temporary_one_in_its_place(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """It is told in one line, once; the files are made once too."""
    blocked = tmp_path / "file"
    blocked.write_bytes(b"")
    make, folder = Maker(), blocked / "cache"
    paths = cached_files(folder, NAMES, make)
    assert contents(paths) == CONTENTS
    assert cached_files(folder, NAMES, make) == paths
    assert make.calls == 1
    (message,) = (record.getMessage() for record in caplog.records)
    assert message.startswith(f"cannot write the cache {folder} (")
    assert "\n" not in message


def test_a_whole_cache_need_not_be_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where it is mounted read-only."""
    make, folder = Maker(), tmp_path / "read-only"
    cached_files(tmp_path / "written", NAMES, make)
    (tmp_path / "written").rename(folder)

    def fail(*_: object, **__: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr("tempfile.TemporaryFile", fail)
    monkeypatch.setattr(Path, "write_bytes", fail)
    paths = cached_files(folder, NAMES, make)
    assert paths == [folder / name for name in NAMES]
    assert make.calls == 1


def test_a_file_appears_in_one_piece(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where writing breaks off, nothing is taken for it; the next attempt succeeds."""
    with monkeypatch.context() as patch:

        def fail(*_: object) -> None:
            raise OSError(28, "No space left on device")

        patch.setattr(Path, "replace", fail)
        with pytest.raises(OSError, match="No space left"):
            cached_files(tmp_path, NAMES, Maker())
    assert not any((tmp_path / name).exists() for name in NAMES)
    assert contents(cached_files(tmp_path, NAMES, Maker())) == CONTENTS
