"""A run as an MCAP file, read by the format's own library, and its layout."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.export.mcap_file import (
    export_run,
    shipped_layout,
    topic_of,
)
from footfall.diagrams.export.run_scene import SHOWN, samples_at
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import load_run
from footfall.diagrams.simulation import run_task

reader = pytest.importorskip(
    "mcap.reader", reason="needs the extra mcap: footfall[mcap]"
)


@pytest.fixture(scope="module")
def stood(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A robot that stands for a moment, and its MCAP file."""
    scenario = load_scenario("stand", ["task.stand_time=0.1"])
    folder = tmp_path_factory.mktemp("stood") / "run"
    run_task(build_task(scenario), scenario, folder)
    export_run(folder)
    return folder


def messages(folder: Path, topic: str) -> list[tuple[float, Any]]:
    """Time, s, and content of every message of a topic, its checksum checked."""
    with (folder / "run.mcap").open("rb") as file:
        found = reader.make_reader(file, validate_crcs=True)
        return [
            (message.log_time / 1e9, json.loads(message.data))
            for _, _, message in found.iter_messages(topics=[topic])
        ]


def test_every_message_is_of_its_schema(stood: Path) -> None:
    """The whole file is read, every checksum checked; its index counts them right."""
    with (stood / "run.mcap").open("rb") as file:
        found = reader.make_reader(file, validate_crcs=True)
        summary = found.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        count, last = 0, -1
        checked: dict[str, int] = {}
        for schema, channel, message in found.iter_messages():
            assert message.log_time >= last
            count, last = count + 1, message.log_time
            checked[channel.topic] = checked.get(channel.topic, 0) + 1
            if checked[channel.topic] <= 3:
                jsonschema.validate(json.loads(message.data), json.loads(schema.data))
        assert count == summary.statistics.message_count > 1000
        names = {channel.topic for channel in summary.channels.values()}
    run = load_run(stood)
    signals = {topic_of(name) for name in (*run.signals, *run.value_names)}
    assert names == signals | set(SHOWN)


def test_signals_come_back_with_units_frames_and_limits(stood: Path) -> None:
    """Sample by sample."""
    frame = load_run(stood).signals["plant.net_actuation"]
    found = messages(stood, "/plant/net_actuation")
    np.testing.assert_allclose([time for time, _ in found], frame["time"], atol=1e-9)
    knees = [message["R_KNEE"] for _, message in found]
    np.testing.assert_array_equal(knees, frame["R_KNEE"])
    with (stood / "run.mcap").open("rb") as file:
        summary = reader.make_reader(file).get_summary()
        assert summary is not None
        about = {one.topic: one.metadata for one in summary.channels.values()}
    told = about["/plant/net_actuation"]
    assert json.loads(told["units"])["R_KNEE"] == "N m"
    assert json.loads(told["limits"])["R_KNEE"] == [-100.0, 100.0]
    assert told["frame"] == "each joint's own"


def test_the_robot_is_where_it_was(stood: Path) -> None:
    """Its pelvis by the transforms, and its CoM by a ball."""
    state = load_run(stood).signals["plant.state"]
    time, message = messages(stood, "/tf")[-1]
    (pelvis,) = [
        one for one in message["transforms"] if one["child_frame_id"] == "PELVIS_S"
    ]
    height = np.interp(time, state["time"], state["PELVIS_S_z"])
    assert pelvis["translation"]["z"] == pytest.approx(height, abs=1e-9)
    com = load_run(stood).signals["balance_state.com"]
    time, message = messages(stood, "/scene/balance")[-1]
    ball = message["entities"][0]["spheres"][0]["pose"]["position"]
    assert ball["z"] == pytest.approx(np.interp(time, com["time"], com["z"]), abs=1e-6)


def paths_of(layout: Any) -> Iterator[str]:
    """Every path of a message that a layout's plots draw."""
    for panel in layout["configById"].values():
        yield from (path["value"] for path in panel.get("paths", ()))


def test_the_layout_names_what_there_is(stood: Path) -> None:
    """Every topic, every field of it, every panel, and the frame it follows."""
    layout = json.loads((stood / "foxglove.json").read_text("utf-8"))
    assert layout == json.loads(shipped_layout())
    assert len(list(paths_of(layout))) >= 10
    for path in paths_of(layout):
        topic, _, field = path.partition(".")
        found = messages(stood, topic)
        assert found, topic
        assert isinstance(found[0][1][field], float), path
    panels = layout["configById"]
    shown = panels["3D!footfall"]
    assert set(shown["topics"]) == set(SHOWN) - {"/tf"}
    frames = messages(stood, "/tf")[0][1]["transforms"]
    assert shown["followTf"] in {one["child_frame_id"] for one in frames}
    assert messages(stood, panels["RawMessages!status"]["topicPath"])
    placed = set(panels_of(layout["layout"]))
    assert placed == set(panels)


def panels_of(layout: Any) -> Iterator[str]:
    """The panels that a layout places."""
    if isinstance(layout, str):
        yield layout
        return
    for side in ("first", "second"):
        yield from panels_of(layout[side])


def test_samples_are_picked_at_a_rate() -> None:
    """Each once, the first and the last in reach among them."""
    time = np.arange(0.0, 1.0005, 0.005)
    picked = samples_at(time, 10.0)
    np.testing.assert_allclose(time[picked], np.arange(0.0, 1.05, 0.1))
    assert samples_at(time[:2], 1000.0) == [0, 1]
