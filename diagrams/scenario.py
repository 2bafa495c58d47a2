"""What a scenario file holds, and reading and writing it."""

import difflib
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path

import numpy as np
from pydrake.common.yaml import yaml_dump, yaml_dump_typed, yaml_load_typed

from diagrams.schema import FieldError, Mapping, check, parse_yaml, set_field, validate
from diagrams.task_params import TaskParams
from models.contact_geometry import CONTACT_MODELS
from models.jvrc1 import JVRC1
from models.robot import RobotModel
from models.room_obstacles import place_boxes
from models.scene import SceneParams
from models.solids import upright_pose
from models.staircase import StaircaseParams
from models.validation import (
    require_at_least,
    require_finite,
    require_one_of,
    require_positive,
)
from systems.balance.landing_adaptor import LandingParams
from systems.balance.stabilizer import StabilizerParams
from systems.balance.zmp_preview import ZmpPreviewParams
from systems.perception.boxes import ObstacleClustererParams
from systems.perception.depth_cloud import DepthCloudParams
from systems.perception.floor import FloorParams
from systems.perception.obstacles import ObstacleFinderParams
from systems.perception.scan_assembler import ScanAssemblerParams
from systems.perception.segmenter_params import PlaneSegmenterParams
from systems.perception.staircase_merging import StaircaseMapParams
from systems.planning.crossing_params import CrossingParams
from systems.planning.executive import ExecutiveParams
from systems.planning.footstep_params import FootstepPlannerParams
from systems.planning.motion_params import MotionPlannerParams
from systems.planning.path_executive import PathExecutiveParams
from systems.planning.path_params import PathPlannerParams
from systems.sensing.depth_camera import DepthCameraParams
from systems.sensing.tilting_lidar import TiltingLidarParams
from systems.tracking.whole_body_ik import IkParams

ROBOTS: dict[str, RobotModel] = {"jvrc1": JVRC1}
"""The robots that a scenario may name."""
APPROXIMATIONS = ("lagged", "similar", "sap")
"""What Drake offers of its contact problem that is convex."""


class ScenarioError(ValueError):
    """A scenario cannot be used; the message is one line naming file and field."""


@dataclass(kw_only=True)
class RobotParams:
    """The robot and where it starts."""

    name: str = "jvrc1"
    """Which robot."""
    x: float = 0.0
    """Midpoint of its feet along x of W, m."""
    y: float = 0.0
    """Midpoint of its feet along y of W, m."""
    yaw: float = 0.0
    """Where it faces, about z of W from its x, rad."""

    def model(self) -> RobotModel:
        """The robot's names, sole, postures and gains."""
        return ROBOTS[self.name]

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        require_one_of("name", self.name, tuple(ROBOTS))
        require_finite("x", self.x, "m")
        require_finite("y", self.y, "m")
        require_finite("yaw", self.yaw, "rad")


@dataclass(kw_only=True)
class SensorsParams:
    """What the robot senses with."""

    camera: DepthCameraParams = field(default_factory=DepthCameraParams)
    """The room's ceiling camera; "room_crossing" only."""
    lidar: TiltingLidarParams = field(default_factory=TiltingLidarParams)
    """The scanner on its head. `simulation.seed` is added to its seed."""


@dataclass(kw_only=True)
class ControllerParams:
    """The parameters of the systems, a field for each of them."""

    scan_assembler: ScanAssemblerParams = field(default_factory=ScanAssemblerParams)
    """From scan lines to a cloud."""
    segmenter: PlaneSegmenterParams = field(default_factory=PlaneSegmenterParams)
    """From the cloud to planes and the staircase."""
    staircase_map: StaircaseMapParams = field(default_factory=StaircaseMapParams)
    """What is remembered from scan to scan."""
    footstep_planner: FootstepPlannerParams = field(
        default_factory=FootstepPlannerParams
    )
    """Where the feet go; `task.steps_between_scans` takes precedence over its own."""
    motion_planner: MotionPlannerParams = field(default_factory=MotionPlannerParams)
    """When and how they go there."""
    zmp_preview: ZmpPreviewParams = field(
        default_factory=lambda: ZmpPreviewParams(com_height=0.85)
    )
    """The cart-table's preview control."""
    landing: LandingParams = field(default_factory=LandingParams)
    """When a foot counts as landed."""
    stabilizer: StabilizerParams = field(default_factory=StabilizerParams)
    """Balance feedback."""
    ik: IkParams = field(default_factory=IkParams)
    """Whole-body tracking."""
    depth_cloud: DepthCloudParams = field(default_factory=DepthCloudParams)
    """From a depth image to a cloud."""
    floor: FloorParams = field(default_factory=FloorParams)
    """What counts as the floor."""
    obstacles: ObstacleClustererParams = field(default_factory=ObstacleClustererParams)
    """From the points above the floor to boxes."""
    path_planner: PathPlannerParams = field(default_factory=PathPlannerParams)
    """The way through the room."""
    path_executive: PathExecutiveParams = field(default_factory=PathExecutiveParams)
    """When to look, plan and walk in a room."""
    executive: ExecutiveParams = field(default_factory=ExecutiveParams)
    """When to scan, plan and move."""
    obstacle_finder: ObstacleFinderParams = field(default_factory=ObstacleFinderParams)
    """From the cloud to what lies in the way."""
    crossing: CrossingParams = field(default_factory=CrossingParams)
    """How that is stepped over."""


@dataclass(kw_only=True)
class SimulationParams:
    """How the world is simulated."""

    time_step: float = 0.0025
    """Step of the plant, s."""
    contact_model: str = "hydroelastic"
    """How soles meet the ground: "hydroelastic" (rubber that carries wherever something
    is under it), or "point" (six small spheres)."""
    contact_approximation: str = "lagged"
    """How Drake solves contact: "lagged", "similar" or "sap"."""
    max_time: float = 120.0
    """When the run is given up, s of simulated time."""
    seed: int = 0
    """Seed of everything that is random."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        require_positive("time_step", self.time_step, "s")
        require_one_of("contact_model", self.contact_model, CONTACT_MODELS)
        require_one_of(
            "contact_approximation", self.contact_approximation, APPROXIMATIONS
        )
        require_positive("max_time", self.max_time, "s")
        require_at_least("seed", self.seed, 0)


@dataclass(kw_only=True)
class Scenario:
    """A robot, what is around it and what it is to do."""

    name: str = ""
    """What it is called; the file's own name where the file does not say."""
    description: str = ""
    """One line for the list of scenarios."""
    robot: RobotParams = field(default_factory=RobotParams)
    """The robot and where it starts."""
    scene: SceneParams = field(default_factory=SceneParams)
    """What is around it."""
    sensors: SensorsParams = field(default_factory=SensorsParams)
    """What it senses with."""
    task: TaskParams = field(default_factory=TaskParams)
    """What it is to do."""
    parameters: ControllerParams = field(default_factory=ControllerParams)
    """How its systems do it."""
    simulation: SimulationParams = field(default_factory=SimulationParams)
    """How all of it is simulated."""

    def lidar(self) -> TiltingLidarParams:
        """The scanner's parameters with the seed of this run."""
        lidar = self.sensors.lidar
        return replace(lidar, seed=lidar.seed + self.simulation.seed)

    def validate(self) -> None:
        """Checks what concerns more than one part; each part checks itself.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        model, room, stairs = self.robot.model(), self.scene.room, self.scene.staircase
        start = upright_pose(self.robot.x, self.robot.y)
        p_RStart = room.X_WR().inverse().multiply(start).translation()
        if abs(p_RStart[0]) > room.length / 2 or abs(p_RStart[1]) > room.width / 2:
            raise ValueError(
                "robot: must start inside the room, "
                f"got x {self.robot.x:g} m, y {self.robot.y:g} m"
            )
        if stairs is not None:
            self._check_width(stairs, model)
        elif self.task.kind == "stair_climbing":
            raise ValueError(f"scene.staircase: the task {self.task.kind} needs one")
        if self.task.mode != "dynamic" and self.task.kind == "room_crossing":
            raise ValueError(
                f"task.mode: {self.task.kind} is only done dynamic, "
                f"got {self.task.mode!r}"
            )
        links = {
            link.attrib["name"]
            for link in ET.parse(model.urdf).getroot().findall("link")
        }
        for index, push in enumerate(self.task.pushes):
            if push.body not in links:
                close = difflib.get_close_matches(push.body, sorted(links), n=1)
                hint = f"; did you mean {close[0]}?" if close else ""
                raise ValueError(
                    f"task.pushes[{index}].body: {model.name} has no link "
                    f"{push.body!r}{hint}"
                )

    def _check_width(self, stairs: StaircaseParams, model: RobotModel) -> None:
        soles = 4.0 * model.sole.half_width
        if stairs.width < soles:
            raise ValueError(
                f"scene.staircase.width: must be at least {soles:g} m, two soles of "
                f"{model.name} abreast, got {stairs.width:g} m"
            )


def load_scenario(name_or_path: str | Path, overrides: Sequence[str] = ()) -> Scenario:
    """Reads a scenario, every field checked.

    Args:
        name_or_path: name of a shipped scenario, or the path of a YAML file.
        overrides: "KEY=VALUE" each, with a dotted key ("scene.staircase.rise=0.15",
            "scene.boxes[0].size=[1, 1, 0.2]"); values are YAML. The last one counts.

    Raises:
        ScenarioError: it cannot be used, and why, in one line.
    """
    label, stem, text = _read(name_or_path)
    applied: list[tuple[str, str]] = []
    try:
        data = parse_yaml(text)
        if not isinstance(data, dict):
            raise FieldError("", "must hold the fields of a scenario")
        data = {key: value for key, value in data.items() if str(key)[:1] != "_"}
        data.setdefault("name", stem)
        check(data, Scenario)
        for override in overrides:
            applied.append((_override(data, override), override))
            check(data, Scenario)
        scenario: Scenario = yaml_load_typed(  # type: ignore[no-untyped-call]
            schema=Scenario,
            data=yaml_dump(data),  # type: ignore[no-untyped-call]
        )
        validate(scenario)
        scenario = place_clutter(scenario)
    except FieldError as error:
        for key, override in applied:
            if _concerns(error.path, key):
                label = f"{label} with --set {override}"
        raise ScenarioError(f"{label}: {error}") from None
    return scenario


def place_clutter(scenario: Scenario) -> Scenario:
    """The scenario with the boxes of its clutter in place, drawn with the run's seed.

    Raises:
        FieldError: there is no room for them.
    """
    clutter = scenario.scene.clutter
    if clutter is None:
        return scenario
    start, goal = scenario.robot, scenario.task.goal
    try:
        boxes = place_boxes(
            replace(clutter, seed=clutter.seed + scenario.simulation.seed),
            np.array([[start.x, start.y], goal[:2]]),
        )
    except ValueError as error:
        raise FieldError("scene.clutter", str(error)) from None
    scene = replace(scenario.scene, boxes=[*scenario.scene.boxes, *boxes], clutter=None)
    return replace(scenario, scene=scene)


def save_scenario(scenario: Scenario, path: str | Path) -> None:
    """Writes the scenario with every field resolved; it loads back equal."""
    text = yaml_dump_typed(scenario, schema=Scenario)  # type: ignore[no-untyped-call]
    Path(path).write_text(text, encoding="utf-8")


def list_scenarios() -> tuple[tuple[str, str], ...]:
    """Name and description of every shipped scenario, by name."""
    return tuple((name, load_scenario(name).description) for name in sorted(_shipped()))


def _shipped() -> dict[str, str]:
    """Text of every shipped scenario by name."""
    folder = resources.files("diagrams.scenarios")
    return {
        item.name.removesuffix(".yaml"): item.read_text(encoding="utf-8")
        for item in folder.iterdir()
        if item.name.endswith(".yaml")
    }


def _read(name_or_path: str | Path) -> tuple[str, str, str]:
    """What to call the scenario in messages, its name unless it has one, its text."""
    path, shipped = Path(name_or_path), _shipped()
    if str(name_or_path) in shipped:
        name = str(name_or_path)
        return f"{name}.yaml", name, shipped[name]
    looks_like_a_path = isinstance(name_or_path, Path) or path.parent != Path(".")
    if not (looks_like_a_path or path.suffix or path.exists()):
        close = difflib.get_close_matches(path.name, shipped, n=3, cutoff=0.5)
        hint = f"did you mean {' or '.join(close)}?" if close else ""
        hint = hint or f"there are {', '.join(sorted(shipped))}"
        raise ScenarioError(f"{name_or_path}: no such scenario; {hint}")
    try:
        return str(name_or_path), path.stem, path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ScenarioError(f"{name_or_path}: no such file") from None
    except UnicodeDecodeError:
        raise ScenarioError(f"{name_or_path}: not a text file in UTF-8") from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ScenarioError(f"{name_or_path}: cannot be read: {reason}") from None


def _concerns(path: str, key: str) -> bool:
    """Whether one of two paths to a field leads through the other."""
    short, long = sorted((path, key), key=len)
    return bool(short) and (
        short == long or long.startswith((f"{short}.", f"{short}["))
    )


def _override(data: Mapping, override: str) -> str:
    """Applies one "KEY=VALUE" to the document and returns its key."""
    key, found, value = override.partition("=")
    key = key.strip()
    if not found or not key:
        raise ScenarioError(f"--set {override}: must read KEY=VALUE")
    try:
        set_field(data, key, parse_yaml(value))
    except FieldError as error:
        raise ScenarioError(f"--set {override}: {error}") from None
    return key
