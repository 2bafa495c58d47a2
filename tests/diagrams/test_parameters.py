"""Every number of every parameter class is either refused by name or can be used."""

import dataclasses
import functools
import importlib
import math
import pkgutil
import re
import tempfile
import typing
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from pydrake.math import RigidTransform

import footfall.diagrams
import footfall.models
import footfall.systems
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.task_params import PushParams
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_description import FeetDescription, RobotDescription
from footfall.models.scenes.flight import FlightParams, PlatformParams
from footfall.models.scenes.mover import MoverParams
from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.scene_model import SceneModelParams
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.bounds import BOUNDS, CHOICES
from footfall.models.values.validation import Parameters
from footfall.systems.balance.landing_adaptor import LandingAdaptor, LandingParams
from footfall.systems.balance.stabilizer import Stabilizer, StabilizerParams
from footfall.systems.balance.zmp_preview import ZmpPreviewParams, preview_gains
from footfall.systems.perception.depth_cloud import DepthCloud, DepthCloudParams
from footfall.systems.perception.obstacles.boxes import ObstacleClustererParams
from footfall.systems.perception.obstacles.obstacle_clusterer import ObstacleClusterer
from footfall.systems.perception.obstacles.obstacle_finder import ObstacleFinder
from footfall.systems.perception.obstacles.obstacles import ObstacleFinderParams
from footfall.systems.perception.planes.plane_segmenter import PlaneSegmenter
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.room.floor import FloorParams
from footfall.systems.perception.room.floor_extractor import FloorExtractor
from footfall.systems.perception.scan_assembler import (
    ScanAssembler,
    ScanAssemblerParams,
)
from footfall.systems.perception.staircases.staircase_map import StaircaseMap
from footfall.systems.perception.staircases.staircase_merging import StaircaseMapParams
from footfall.systems.planning.crossing.params import CrossingParams, HighCrossingParams
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_planner import MotionPlanner
from footfall.systems.planning.motion.motion_task import Walker
from footfall.systems.planning.motion.swing_trajectory import SwingParams
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.planning.path.path_planner import PathPlanner
from footfall.systems.sensing.depth_camera import DepthCameraParams
from footfall.systems.sensing.tilting_lidar import TiltingLidarParams

NUMBERS = (int, float, float | None, list[float], list[float] | None)
"""The types of the fields that hold numbers."""
FREE_TEXTS = ("name", "description", "body", "urdf", "left", "right", "file")
LARGEST = 2**31
"""No number of a scenario is larger."""


def _modules() -> Iterator[Any]:
    for package in (footfall.diagrams, footfall.models, footfall.systems):
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            yield importlib.import_module(found.name)


def _reachable(schema: Any) -> set[type]:
    """The dataclasses that values of a type may hold, itself included."""
    arguments = typing.get_args(schema)
    if arguments:
        return set().union(*map(_reachable, arguments))
    if not dataclasses.is_dataclass(schema):
        return set()
    parts = typing.get_type_hints(schema).values()
    return {schema}.union(*map(_reachable, parts))  # type: ignore[arg-type]


def _parameter_classes() -> list[type[Parameters]]:
    """Those of a scenario, and whatever is called Params in any module."""
    found = _reachable(Scenario)
    for module in _modules():
        for name, value in vars(module).items():
            if isinstance(value, type) and value.__module__ == module.__name__:
                found |= {value} if name.endswith("Params") else set()
    return sorted(found, key=lambda one: one.__qualname__)


CLASSES = _parameter_classes()
FIELDS = [
    pytest.param(one, item.name, id=f"{one.__name__}.{item.name}")
    for one in CLASSES
    for item in dataclasses.fields(one)
    if item.type in NUMBERS
]
BUILT: dict[type[Parameters], Callable[[Any], object]] = {
    BoxParams: lambda p: p.solid(),
    DepthCameraParams: lambda p: (p.focal_length, p.X_WC()),
    DepthCloudParams: lambda p: DepthCloud(p, []),
    FloorParams: FloorExtractor,
    LandingParams: lambda p: LandingAdaptor(p, np.zeros(12)),
    MotionPlannerParams: lambda p: MotionPlanner(Walker(p, ZmpPreviewParams(), JVRC1)),
    MoverParams: lambda p: p.solid(),
    ObstacleClustererParams: ObstacleClusterer,
    ObstacleFinderParams: ObstacleFinder,
    PathPlannerParams: PathPlanner,
    PlaneSegmenterParams: lambda p: PlaneSegmenter(JVRC1.sole, p),
    RoomParams: lambda p: p.solids(),
    ScanAssemblerParams: lambda p: ScanAssembler(
        p, beam_angles=np.zeros(1), mount_body=0, X_BM=RigidTransform()
    ),
    StabilizerParams: lambda p: Stabilizer(p, JVRC1.sole, 62.4),
    FlightParams: lambda p: p.solids(),
    PlatformParams: lambda p: p.solids(),
    SceneModelParams: lambda p: p.solids(),
    StaircaseMapParams: StaircaseMap,
    StaircaseParams: lambda p: p.solids(),
    TiltingLidarParams: lambda p: (p.angles(), p.tilts()),
    ZmpPreviewParams: preview_gains,
}
"""What is made of the parameters that are enough to make something of."""


def _valid(one: type[Parameters]) -> Parameters:
    if one is Scenario:
        return Scenario(scene=SceneParams(staircase=StaircaseParams()))
    if one is RobotDescription:
        feet = FeetDescription(left="left_foot", right="right_foot")
        return RobotDescription(urdf="robot.urdf", foot_bodies=feet)
    if one is SceneModelParams:
        return SceneModelParams(file=_block())
    return PushParams(force=[1.0, 0.0, 0.0]) if one is PushParams else one()


@functools.cache
def _block() -> str:
    """A file that a scene may name."""
    file = Path(tempfile.mkdtemp()) / "block.stl"
    trimesh.creation.box((0.5, 0.5, 0.5)).export(file)
    return str(file)


def _with(one: type[Parameters], name: str, value: float) -> Parameters:
    """Valid parameters, but for one number of one field."""
    params = _valid(one)
    before = getattr(params, name)
    item = next(item for item in dataclasses.fields(one) if item.name == name)
    if item.type not in (int, float, float | None):
        length = item.metadata[BOUNDS].length or 3
        before = list(before or [-1.0] * length)
        value = [*before[:-1], value]  # type: ignore[assignment]
    elif item.type is int and math.isfinite(value):
        value = int(value)
    setattr(params, name, value)
    return params


@pytest.mark.parametrize("one", CLASSES)
def test_every_number_states_its_bounds(one: type[Parameters]) -> None:
    """Beside its field; the default lies within, and every class checks itself."""
    assert issubclass(one, Parameters)
    _valid(one).validate()
    for item in dataclasses.fields(one):
        assert (BOUNDS in item.metadata) == (item.type in NUMBERS)
        if item.type is str and item.name not in FREE_TEXTS:
            assert CHOICES in item.metadata


@pytest.mark.parametrize(("one", "name"), FIELDS)
@settings(max_examples=25, deadline=None, derandomize=True)
@given(value=st.floats() | st.floats(-10.0, 10.0))
@example(value=math.nan)
@example(value=math.inf)
@example(value=-math.inf)
@example(value=0.0)
@example(value=-1.0)
@example(value=5e-324)
@example(value=1e12)
@example(value=-1e12)
def test_a_number_is_refused_by_name_or_can_be_used(
    one: type[Parameters], name: str, value: float
) -> None:
    """In one line; nothing is made that breaks later."""
    params = _with(one, name, value)
    refusal = ""
    try:
        params.validate()
    except ValueError as error:
        refusal = str(error)
    if refusal:
        assert re.fullmatch(r"[\w\[\]]+: must .+, got .+", refusal)
    else:
        BUILT.get(one, lambda made: made)(params)
    if not math.isfinite(value):
        assert re.match(rf"{name}(\[\d\])?: must be finite, ", refusal)
    elif abs(value) > LARGEST:
        assert re.match(rf"{name}(\[\d\])?: ", refusal)


@pytest.mark.parametrize(
    ("one", "name", "value"),
    [
        (CrossingParams, "min_gap", -1.0),
        (CrossingParams, "min_limit_distance", -1.0),
        (CrossingParams, "max_foot_shortfall", -1.0),
        (CrossingParams, "waist_share", 0.0),
        (CrossingParams, "waist_share", 1.5),
        (HighCrossingParams, "min_gap", -1.0),
        (HighCrossingParams, "lead_pitch", 1.6),
        (HighCrossingParams, "over_share", 1.1),
        (MotionPlannerParams, "single_support", 1e4),
        (ObstacleFinderParams, "back_allowance", -0.01),
        (PushParams, "duration", 0.0),
        (SwingParams, "retraction", -0.1),
        (StaircaseParams, "steps", 1_000_000),
        (TiltingLidarParams, "resolution_deg", 1e-9),
    ],
)
def test_a_number_that_makes_no_sense_is_refused(
    one: type[Parameters], name: str, value: float
) -> None:
    """Though it is finite."""
    with pytest.raises(ValueError, match=rf"^{name}: must "):
        _with(one, name, value).validate()


@pytest.mark.parametrize(
    ("one", "name", "value", "message"),
    [
        (RoomParams, "length", "wide", "length: must be a number, got 'wide'"),
        (RoomParams, "length", True, "length: must be a number, got True"),
        (StaircaseParams, "steps", 2.5, "steps: must be a whole number, got 2.5"),
        (PushParams, "force", [1.0, 2.0], "force: must have 3 elements, got 2"),
        (CrossingParams, "cwtg1", "best", "cwtg1: must be one of exact, preview, "),
    ],
)
def test_a_value_of_another_kind_is_refused(
    one: type[Parameters], name: str, value: object, message: str
) -> None:
    """Where parameters are made in Python too, where no schema looks at them."""
    params = _valid(one)
    setattr(params, name, value)
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        params.validate()
