"""Scenarios: those that ship, reading, overriding, writing, and every error."""

from dataclasses import fields
from math import hypot
from pathlib import Path

import numpy as np
import pytest
import trimesh
import yaml

from footfall.diagrams.scenario import (
    Scenario,
    ScenarioError,
    load_scenario,
    save_scenario,
)
from footfall.diagrams.shipped import list_scenarios

STAIRS = "scene: {staircase: {rise: 0.1}}"


def _message(name_or_path: str | Path, *overrides: str) -> str:
    with pytest.raises(ScenarioError) as raised:
        load_scenario(name_or_path, overrides)
    message = str(raised.value)
    assert "\n" not in message
    return message


def test_shipped_scenarios_are_listed_with_a_description() -> None:
    """A line each."""
    listed = dict(list_scenarios())
    assert {"stairs-exp1", "stairs-exp2", "stair-24cm"} <= set(listed)
    assert all(text and "\n" not in text for text in listed.values())


@pytest.mark.parametrize(
    ("name", "steps", "rise", "run", "width"),
    [
        ("stairs-exp1", 3, 0.20, 0.27, 0.50),
        ("stairs-exp2", 11, 0.18, 0.265, 1.23),
        ("stair-24cm", 1, 0.24, 0.35, 0.80),
    ],
)
def test_shipped_stairs_have_the_published_dimensions(
    name: str, steps: int, rise: float, run: float, width: float
) -> None:
    """Stair paper, Sec. 5."""
    scenario = load_scenario(name)
    stairs = scenario.scene.staircase
    assert stairs is not None
    assert (stairs.steps, stairs.rise, stairs.run) == (steps, rise, run)
    assert stairs.width == width
    assert scenario.name == name
    assert (scenario.scene.room.length, scenario.scene.room.width) == (11.0, 7.0)
    assert stairs.x - scenario.robot.x == pytest.approx(0.6)
    # A robot of 1.71 m can stand on the top tread.
    assert steps * rise + 1.9 < scenario.scene.room.height


@pytest.mark.parametrize("name", [name for name, _ in list_scenarios()])
def test_what_is_saved_loads_back_equal(name: str, tmp_path: Path) -> None:
    """Every field that acts is written, also those that the file left out."""
    scenario = load_scenario(name, ["simulation.seed=7", "scene.room.yaw=0.1"])
    path = tmp_path / "resolved.yaml"
    save_scenario(scenario, path)
    assert load_scenario(path) == scenario
    text = path.read_text()
    silent = {"sensors"} if scenario.task.kind == "stand" else set()
    groups = {item.name for item in fields(Scenario)} - silent
    assert all(f"\n{group}:" in f"\n{text}" for group in groups)
    scans = scenario.task.kind in ("stair_climbing", "obstacle_crossing")
    assert ("tilt_step_deg: 0.25" in text) == scans


def test_file_names_a_scenario_that_does_not_name_itself(tmp_path: Path) -> None:
    """Any user's YAML works like a shipped one; roots with _ are the user's own."""
    path = tmp_path / "attic.yaml"
    path.write_text(f"_note: [1, 2]\n{STAIRS}\n")
    assert load_scenario(path).name == "attic"
    assert load_scenario(str(path), ["name=loft"]).name == "loft"


def test_overrides_are_applied_in_order() -> None:
    """Dotted keys, lists in flow syntax, the last one counts."""
    scenario = load_scenario(
        "stairs-exp1",
        [
            "scene.staircase.rise=0.10",
            "scene.staircase.rise=0.15",
            "scene.staircase.closed_risers=false",
            "simulation.time_step=1e-3",
            "task.pushes=[{time: 3, force: [0, 50, 0]}]",
            "task.pushes[0].duration=0.2",
            "scene.boxes=[{name: crate, x: -2, size: [0.3, 0.3, 0.3]}]",
        ],
    )
    stairs = scenario.scene.staircase
    assert stairs is not None
    assert (stairs.rise, stairs.closed_risers, stairs.run) == (0.15, False, 0.27)
    assert scenario.simulation.time_step == 0.001
    push = scenario.task.pushes[0]
    assert (push.time, push.duration, push.force) == (3.0, 0.2, [0.0, 50.0, 0.0])
    assert scenario.scene.solids()[-1].name == "box/crate"


def test_what_systems_share_is_one_field() -> None:
    """Period, friction, the CoM's height and the time of a scan line."""
    scenario = load_scenario(
        "stairs-exp1",
        [
            "parameters.control_period=0.01",
            "parameters.friction=0.3",
            "parameters.com_height=0.8",
            "sensors.lidar.line_period=0.05",
            "task.steps_between_scans=3",
        ],
    )
    params = scenario.controllers()
    parts = (params.motion_planner, params.zmp_preview, params.landing, params.ik)
    assert {part.period for part in parts} == {params.control_period} == {0.01}
    assert (
        {
            params.stabilizer.distribution.friction,
            params.motion_planner.quasi_static.friction,
            params.crossing.quasi_static.friction,
        }
        == {params.friction}
        == {0.3}
    )
    heights = (params.motion_planner.com_height, params.zmp_preview.com_height)
    assert heights == (0.8, 0.8)
    assert params.footstep_planner.steps_between_scans == 3
    assert params.scan_assembler.period == scenario.lidar().line_period == 0.05


@pytest.mark.parametrize(
    ("field", "one"),
    [
        ("parameters.ik.period", "parameters.control_period"),
        ("parameters.landing.period", "parameters.control_period"),
        ("parameters.motion_planner.period", "parameters.control_period"),
        ("parameters.zmp_preview.period", "parameters.control_period"),
        ("parameters.motion_planner.com_height", "parameters.com_height"),
        ("parameters.zmp_preview.com_height", "parameters.com_height"),
        ("parameters.stabilizer.distribution.friction", "parameters.friction"),
        ("parameters.motion_planner.quasi_static.friction", "parameters.friction"),
        ("parameters.crossing.quasi_static.friction", "parameters.friction"),
        ("parameters.scan_assembler.period", "sensors.lidar.line_period"),
        (
            "parameters.footstep_planner.steps_between_scans",
            "task.steps_between_scans",
        ),
    ],
)
def test_a_second_field_for_the_same_is_refused(
    field: str, one: str, tmp_path: Path
) -> None:
    """With the one that there is; what is saved has that alone."""
    message = _message("stairs-exp1", f"{field}=0.5")
    assert message.endswith(f": {field}: no such field; did you mean {one}?")
    path = tmp_path / "resolved.yaml"
    mode = ["task.mode=quasi_static"] if "quasi_static" in field else []
    task = "obstacle-15cm" if "crossing" in field else "stairs-exp1"
    save_scenario(load_scenario(task, mode), path)
    data = yaml.safe_load(path.read_text())
    for name in field.split(".")[:-1]:
        data = data[name]
    assert field.rsplit(".", maxsplit=1)[-1] not in data


def test_one_seed_rules_the_scanner() -> None:
    """The run's seed moves the scanner's."""
    scenario = load_scenario(
        "stairs-exp1", ["simulation.seed=4", "sensors.lidar.seed=3"]
    )
    assert scenario.lidar().seed == 7
    assert scenario.sensors.lidar.seed == 3


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("scene.staircase.rize=1", "scene.staircase.rize: no such field; did you mean"),
        ("scene.stairs.rise=1", "scene.stairs: no such field; did you mean staircase?"),
        ("scene.staircase.rise=-0.2", "scene.staircase.rise: must be positive, got -0"),
        ("scene.staircase.rise=.nan", "scene.staircase.rise: must be finite, got nan"),
        ("scene.staircase.rise=high", "scene.staircase.rise: must be a number, got 'h"),
        ("scene.staircase.steps=0", "scene.staircase.steps: must be at least 1, got 0"),
        ("scene.staircase.width=0.1", "scene.staircase.width: must be at least 0.168"),
        ("scene.staircase.x=5", "scene.staircase: must lie inside the room"),
        ("scene.staircase=null", "scene.staircase: the task stair_climbing needs one"),
        ("scene.room.height=0", "scene.room.height: must be positive, got 0 m"),
        ("scene.boxes=[{size: [1]}]", "scene.boxes[0].size: must have 3 elements, got"),
        ("sensors.lidar.noise=-1", "sensors.lidar.noise: must be at least 0 m, got -1"),
        ("parameters.segmenter.voxel_size=0", "parameters.segmenter.voxel_size: must "),
        (
            "parameters.footstep_planner.stance_width=0.05",
            "parameters.footstep_planner.stance_width: must lie between 0.114 m (two ",
        ),
        (
            "robot.name=hrp4",
            "robot.name: must be one of jvrc1, or a file that ends with .yaml, ",
        ),
        ("robot.x=20", "robot: must start inside the room, got x 20 m, y 0 m"),
        (
            "task.kind=fly",
            "task.kind: must be one of stair_climbing, room_crossing, ",
        ),
        (
            "task.mode=fast",
            "task.mode: must be one of dynamic, quasi_static, got 'fast'",
        ),
        ("task.goal=[1, 0, 7]", "task.goal[2]: must be at most a turn, got 7 rad"),
        ("task.steps_between_scans=0", "task.steps_between_scans: must be at least 1"),
        (
            "task.pushes=[{body: HEAD, force: [1, 0, 0]}]",
            "task.pushes[0].body: jvrc1 has no link 'HEAD'",
        ),
        ("task.pushes=[{}]", "task.pushes[0].force: must not be zero, got [0.0, 0.0, "),
        ("task.pushes=[{force: [1]}]", "task.pushes[0].force: must have 3 elements, g"),
        ("simulation.time_step=0", "simulation.time_step: must be at least 1e-05"),
        (
            "parameters.control_period=0.004",
            "parameters.control_period: must be a multiple of simulation.time_step, ",
        ),
        (
            "parameters.control_period=0.001",
            "parameters.control_period: must be a multiple of simulation.time_step, ",
        ),
        (
            "parameters.crossing.sampling=0.012",
            "parameters.crossing.sampling: must be a multiple of parameters.control_p",
        ),
        (
            "parameters.scan_assembler.offset=0.03",
            "parameters.scan_assembler.offset: must be less than the period, got 0.03",
        ),
        ("simulation.seed=-1", "simulation.seed: must be at least 0, got -1"),
    ],
)
def test_wrong_override_is_refused_under_its_field(override: str, message: str) -> None:
    """File, override and field are all named."""
    assert _message("stairs-exp1", override).startswith(
        f"stairs-exp1.yaml with --set {override}: {message}"
    )


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("scene.staircase.rise", "must read KEY=VALUE"),
        ("=3", "must read KEY=VALUE"),
        ("scene.room.length.x=3", "scene.room.length: has no fields"),
        ("task.pushes=[{", "line 1: not YAML: "),
    ],
)
def test_override_that_cannot_be_read_is_refused(override: str, message: str) -> None:
    """The override itself is named."""
    assert _message("stairs-exp1", override).startswith(f"--set {override}: {message}")


def test_only_the_override_that_is_wrong_is_named() -> None:
    """Others that were given with it are not."""
    message = _message("stairs-exp1", "robot.y=0.1", "scene.staircase.rise=-1")
    assert message.startswith("stairs-exp1.yaml with --set scene.staircase.rise=-1: ")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("stairs-exp", "stairs-exp: no such scenario; did you mean stairs-exp"),
        ("kitchen", "kitchen: no such scenario; there are "),
    ],
)
def test_unknown_name_is_refused_with_close_matches(name: str, message: str) -> None:
    """Someone who mistypes a name gets the right one."""
    assert _message(name).startswith(message)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "no such file"),
        (b"", "must hold the fields of a scenario"),
        (b"- 1", "must hold the fields of a scenario"),
        (b"scene: [", "line 1: not YAML: "),
        (b"\xff\xfe\x00", "not a text file in UTF-8"),
        (b"scene: {staircase: {rize: 1}}", "scene.staircase.rize: no such field; did"),
        (b"robot: 7", "robot: must hold fields, got 7"),
        (b"name: a\nname: b", "line 2: not YAML: the key 'name' occurs twice"),
    ],
)
def test_wrong_file_is_refused_under_its_path(
    content: bytes | None, message: str, tmp_path: Path
) -> None:
    """The path is named as it was given."""
    path = tmp_path / "stairs.yaml"
    if content is not None:
        path.write_bytes(content)
    assert _message(str(path)).startswith(f"{path}: {message}")


def test_folder_is_refused(tmp_path: Path) -> None:
    """A folder is no scenario."""
    assert _message(tmp_path) == f"{tmp_path}: cannot be read: is a directory"


def test_clutter_is_in_place_once_a_scenario_is_loaded(tmp_path: Path) -> None:
    """By the run's seed, beside the boxes that are named; kept when it is written."""
    crate = "scene.boxes=[{name: crate, x: 3.5, y: 2.5}]"
    room = load_scenario("room", ["simulation.seed=3", crate])
    assert room.scene.clutter is None
    names = [box.name for box in room.scene.boxes]
    assert names[0] == "crate"
    assert 6 <= len(names[1:]) <= 10
    assert names[1:] == [f"clutter_{index}" for index in range(len(names) - 1)]
    for x, y in ((room.robot.x, room.robot.y), room.task.goal[:2]):
        assert all(hypot(box.x - x, box.y - y) > 0.55 for box in room.scene.boxes)
    save_scenario(room, tmp_path / "room.yaml")
    assert load_scenario(tmp_path / "room.yaml") == room
    assert load_scenario("room", ["simulation.seed=3", crate]) == room
    assert load_scenario("room", ["simulation.seed=4", crate]).scene != room.scene


def test_a_room_that_is_too_full_is_refused() -> None:
    """The field is named, and how many boxes were to be placed."""
    message = _message("room", "scene.clutter={min_count: 500, max_count: 500}")
    assert "scene.clutter: " in message
    assert "no room for 500 boxes" in message


def test_stairs_and_obstacles_are_crossed_quasi_statically_too() -> None:
    """A room is not crossed so slowly."""
    assert load_scenario("stair-24cm", ["task.mode=quasi_static"])
    assert load_scenario("obstacle-15cm", ["task.mode=quasi_static"])
    message = _message("room", "task.mode=quasi_static")
    assert "task.mode: room_crossing is only done dynamic, got" in message


def test_a_model_s_path_starts_at_the_scenario_s_file(tmp_path: Path) -> None:
    """And a scenario that is saved elsewhere finds it again."""
    trimesh.creation.box(bounds=[[0, -0.4, 0], [0.3, 0.4, 0.2]]).export(
        tmp_path / "step.stl"
    )
    file = tmp_path / "step.yaml"
    file.write_text("scene: {models: [{file: step.stl, x: 0.6}]}")
    scenario = load_scenario(file)
    (tread,) = scenario.scene.treads()
    np.testing.assert_allclose(tread.X_WR.translation(), [0.75, 0.0, 0.2], atol=1e-9)
    elsewhere = tmp_path / "deeper" / "scenario.yaml"
    elsewhere.parent.mkdir()
    save_scenario(scenario, elsewhere)
    assert load_scenario(elsewhere).scene.models == scenario.scene.models


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        ("models: [{file: no.stl}]", r"scene\.models\[0\]\.file: .*no\.stl: no such"),
        ("models: [{}]", r"scene\.models\[0\]\.file: must end with"),
        ("flights: [{width: 0.1}]", r"scene\.flights\[0\]\.width: must be at least"),
        ("flights: [{runs: [1]}]", r"scene\.flights\[0\]\.runs: must have as many"),
        ("platforms: [{x: 6}]", r"scene\.platforms\[0\]: must lie inside the room"),
        ("boxes: []", r"scene\.staircase: the task stair_climbing needs one, or"),
    ],
)
def test_a_scene_of_one_s_own_that_is_wrong_is_told(
    tmp_path: Path, scene: str, message: str
) -> None:
    """In one line, with file and field."""
    file = tmp_path / "own.yaml"
    file.write_text(f"scene: {{{scene}}}")
    with pytest.raises(ScenarioError, match=message) as told:
        load_scenario(file)
    assert str(told.value).startswith(f"{file}: ")
    assert "\n" not in str(told.value)


def test_an_encoder_of_no_joint_is_refused() -> None:
    """In one line that says what it might have meant."""
    with pytest.raises(
        ScenarioError,
        match=r"^stand.yaml with --set sensors.*: sensors.encoders.stuck_joints: jvrc1 "
        r"has no joint 'R_KNE'; did you mean R_KNEE\?$",
    ):
        load_scenario("stand", ["sensors.encoders.stuck_joints=[R_KNE]"])
