"""A run as an MCAP file, with a layout that shows it in Foxglove."""

import json
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from footfall.diagrams.export.messages import (
    SCHEMAS,
    Message,
    nanoseconds,
    signal_schema,
)
from footfall.diagrams.export.run_scene import SHOWN, shown_of
from footfall.diagrams.run_data import read_run_data
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signals import Run, RunError

MCAP_FILE, LAYOUT_FILE = "run.mcap", "foxglove.json"
VALUE_SCHEMA: Message = {"type": "object", "properties": {}}
"""Of an abstract signal: whatever its values hold."""


class Topic(NamedTuple):
    """What is written under one name."""

    name: str
    schema: str
    """Its name."""
    described: Message
    """The schema."""
    about: dict[str, str]
    """Metadata."""


def topic_of(signal: str) -> str:
    """Names the topic of a signal: "SYSTEM.PORT" is "/SYSTEM/PORT".

    In paths of messages a dot would have to be quoted.
    """
    return "/" + signal.replace(".", "/", 1)


def export_run(folder: Path, path: Path | None = None) -> tuple[Path, Path]:
    """Writes a run as an MCAP file, and the layout beside it.

    Vector signals are topics of JSON messages with a number a column, its unit and
    limits in the schema and their frame in the topic's metadata; abstract signals are
    topics of what they held. What is shown in 3D, the robot's frames and sticks, the
    scene, what was seen and planned, forces, CoM and ZMP, is in Foxglove's schemas.

    Args:
        folder: of the run.
        path: of the file; None for `MCAP_FILE` in the folder.

    Returns:
        The file and the layout.

    Raises:
        RunError: the folder holds no run, or `mcap` is missing.
        OSError: a file cannot be written.
    """
    try:
        from mcap.writer import Writer
    except ImportError:
        needs = "needs `mcap`: pip install 'footfall[mcap]'"
        raise RunError(f"footfall export: {needs}") from None
    data = read_run_data(folder)
    path = path or folder / MCAP_FILE
    with whole_file(path) as partial, partial.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="", library="footfall")
        scenario = (data.run.folder / "scenario.yaml").read_text(encoding="utf-8")
        writer.add_metadata("scenario", {"scenario.yaml": scenario})
        channels: dict[str, int] = {}
        for topic in topics(data.run):
            described = json.dumps(topic.described).encode()
            schema = writer.register_schema(topic.schema, "jsonschema", described)
            channels[topic.name] = writer.register_channel(
                topic.name, "json", schema, topic.about
            )
        for name, time, message in _messages(data.run):
            _add(writer, channels[name], time, message)
        for shown in shown_of(data):
            _add(writer, channels[shown.topic], shown.time, shown.message)
        writer.finish()
    layout = path.with_name(LAYOUT_FILE)
    with whole_file(layout) as partial:
        partial.write_text(shipped_layout(), encoding="utf-8")
    return path, layout


def shipped_layout() -> str:
    """Reads the layout that we ship, JSON."""
    return (files("footfall.diagrams.export") / LAYOUT_FILE).read_text("utf-8")


def topics(run: Run) -> Iterator[Topic]:
    """Lists the topics of a run, with what is shown in 3D."""
    for name, frame in run.signals.items():
        attrs = {key: frame.attrs[key] for key in ("units", "limits", "frame")}
        described = signal_schema(name, attrs)
        about = {
            "frame": str(attrs["frame"]),
            "units": json.dumps(attrs["units"]),
            "limits": json.dumps(attrs["limits"]),
        }
        yield Topic(topic_of(name), name, described, about)
    for name in run.value_names:
        yield Topic(topic_of(name), name, VALUE_SCHEMA, {})
    for name, schema in SHOWN.items():
        yield Topic(name, schema, SCHEMAS[schema], {"frame": "W, true"})


def _messages(run: Run) -> Iterator[tuple[str, float, Any]]:
    """Yields every sample of every signal: topic, time, s, and message."""
    for name, frame in run.signals.items():
        rows = frame.to_numpy(dtype=np.float64)
        plain = rows.astype(object)
        # JSON knows no nan.
        plain[~np.isfinite(rows)] = None
        columns = list(frame.columns)
        for row in plain.tolist():
            yield topic_of(name), row[0], dict(zip(columns, row, strict=True))
    for name in run.value_names:
        for time, value in run.values(name):
            yield topic_of(name), time, value


def _add(writer: Any, channel: int, time: float, message: Any) -> None:
    stamped = nanoseconds(time)
    content = json.dumps(message, allow_nan=False).encode()
    writer.add_message(channel, stamped, content, stamped)
