"""`python -m footfall`: what it says, and how it ends when the machine is unkind."""

import os
import signal
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
COMMAND = (sys.executable, "-m", "footfall")
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}


def footfall(*arguments: object, **options: object) -> subprocess.CompletedProcess[str]:
    """Runs the command in a process of its own."""
    return subprocess.run(
        [*COMMAND, *map(str, arguments)],
        check=False,
        text=True,
        stderr=subprocess.PIPE,
        **{"stdout": subprocess.PIPE, "env": ENVIRONMENT, **options},
    )


def test_says_its_version() -> None:
    """The one that is installed."""
    result = footfall("--version")
    assert result.stdout == f"footfall {version('footfall')}\n"
    assert (result.stderr, result.returncode) == ("", 0)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
@pytest.mark.parametrize("command", ["list", "--help", "segment"])
def test_output_that_cannot_be_written_is_told_in_a_line(
    command: str, tmp_path: Path
) -> None:
    """Neither a traceback nor Python's complaint at its end."""
    arguments: list[object] = [command]
    if command == "segment":
        cloud = tmp_path / "corner.xyz"
        cloud.write_text("0 0 0\n1 0 0\n0 1 0\n", encoding="utf-8")
        arguments += [cloud, "--out", tmp_path]
    with open("/dev/full", "w") as full:
        result = footfall(*arguments, stdout=full)
    assert result.returncode == 2
    assert result.stderr == "footfall: cannot print: No space left on device\n"


@pytest.mark.parametrize("imported", ["typer", "numpy", "trimesh", "open3d"])
def test_ctrl_c_while_it_imports(imported: str, tmp_path: Path) -> None:
    """Status 130 at once, whatever is being imported; `-X importtime` tells what is.

    Open3D is imported while the diagram is built; a run that has begun says that it was
    interrupted.
    """
    command = [sys.executable, "-X", "importtime", "-m", "footfall", "run"]
    with subprocess.Popen(
        [*command, "stairs-exp1", "--out", str(tmp_path / "out")],
        stderr=subprocess.PIPE,
        text=True,
        env=ENVIRONMENT,
        cwd=tmp_path,
    ) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if line.rpartition("|")[2].strip() == imported:
                break
        process.send_signal(signal.SIGINT)
        rest = process.stderr.read()
    assert process.returncode == 130
    said = [line for line in rest.splitlines() if not line.startswith("import time:")]
    assert said == (["footfall: interrupted"] if imported == "open3d" else [])
    assert not (tmp_path / "out").exists()


def test_a_read_only_cache_is_told_in_a_line(tmp_path: Path) -> None:
    """Of all the libraries that want one; then the work goes on."""
    (tmp_path / "file").write_bytes(b"")
    environment = {**ENVIRONMENT, "XDG_CACHE_HOME": str(tmp_path / "file")}
    environment.pop("MPLCONFIGDIR", None)
    short = ("--set", "simulation.max_time=0.02", "--out", tmp_path / "run")
    result = footfall("run", "stairs-exp1", *short, env=environment)
    assert result.stdout.startswith("timed_out")
    assert (tmp_path / "run" / "figures").is_dir()
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"footfall: cannot write the cache {tmp_path}")
