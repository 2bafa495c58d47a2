"""Folders of runs: named for people, and never shared."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

from footfall.diagrams.run_folder import begin_run, make_numbered, run_name
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.staircase import StaircaseParams


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ((), "stairs-seed3"),
        (("simulation.seed=3",), "stairs-seed3"),
        (("scene.staircase.rise=0.18",), "stairs-seed3-scene.staircase.rise=0.18"),
        (("a.b=1", "c=-2e3"), "stairs-seed3-a.b=1,c=-2e3"),
    ],
)
def test_the_name_tells_what_was_changed(changes, name) -> None:
    """As it was typed, the seed aside."""
    assert run_name("stairs", 3, changes) == name


def test_changes_that_make_no_name_are_told_apart_by_a_hash() -> None:
    """Brackets and slashes, and more than is to be read."""
    changes = [
        ("task.goal=[1.75, 0.0, 0.0]",),
        ("task.goal=[1.75 0.0 0.0]",),
        ("name=../../etc",),
        tuple(f"parameters.zmp_preview.field_{n}=0.125" for n in range(9)),
        tuple(f"parameters.zmp_preview.field_{n}=0.125" for n in range(10)),
    ]
    names = [run_name("s", 0, each) for each in changes]
    assert len(set(names)) == len(names)
    assert names[0].startswith("s-seed0-task.goal=_1.75,_0.0,_0.0")
    assert all(len(name) <= 68 and "/" not in name for name in names)


def test_numbers_are_given_once_however_many_ask(tmp_path) -> None:
    """At the same moment."""
    together = Barrier(16)

    def ask(_: int) -> str:
        together.wait()
        return make_numbered(tmp_path / "runs", "s").name

    with ThreadPoolExecutor(16) as pool:
        names = sorted(pool.map(ask, range(16)))
    assert names == sorted(["s", *(f"s-{number}" for number in range(2, 17))])


def test_one_of_many_gets_a_folder(tmp_path) -> None:
    """The others are told that it is taken."""
    folder = tmp_path / "run"
    folder.mkdir()
    stairs = SceneParams(staircase=StaircaseParams())
    together = Barrier(16)

    def ask(number: int) -> str:
        together.wait()
        try:
            begin_run(folder, Scenario(name=f"s{number}", scene=stairs))
        except FileExistsError as error:
            return str(error)
        return f"s{number}"

    with ThreadPoolExecutor(16) as pool:
        told = sorted(pool.map(ask, range(16)))
    assert told[:15] == 15 * [f"{folder}: exists and is not empty"]
    assert told[15] == load_scenario(folder / "scenario.yaml").name


def test_a_folder_that_another_run_takes_meanwhile_is_taken(
    tmp_path, monkeypatch
) -> None:
    """It was empty when it was looked at."""
    (tmp_path / "run" / "signals").mkdir(parents=True)
    monkeypatch.setattr("pathlib.Path.iterdir", lambda _: iter(()))
    with pytest.raises(FileExistsError, match="run: exists and is not empty"):
        begin_run(tmp_path / "run", Scenario(name="s"))


def test_a_folder_that_cannot_be_begun_is_not_left_there(tmp_path, monkeypatch) -> None:
    """Where the scenario does not fit on the disk."""

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("footfall.diagrams.run_folder.save_scenario", full)
    with pytest.raises(OSError, match=r"No space left.*run/scenario\.yaml"):
        begin_run(tmp_path / "run", Scenario(name="s"))
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "run").mkdir()
    with pytest.raises(OSError, match="No space left"):
        begin_run(tmp_path / "run", Scenario(name="s"))
    assert [path.name for path in tmp_path.rglob("*")] == ["run"]
