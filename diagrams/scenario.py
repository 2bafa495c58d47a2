"""What a scenario file holds, and reading and writing it."""

import difflib
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from pydrake.common.yaml import yaml_dump, yaml_load_typed

from footfall.diagrams.controller_params import ControllerParams
from footfall.diagrams.fields.commented_yaml import commented_yaml
from footfall.diagrams.fields.words import expand_words
from footfall.diagrams.robots.robot_files import ROBOTS, model_of
from footfall.diagrams.robots.scenario_robot import expand_robot, name_robot
from footfall.diagrams.schema import (
    FieldError,
    Mapping,
    check,
    parse_yaml,
    set_field,
    validate,
)
from footfall.diagrams.shipped import shipped_scenarios
from footfall.diagrams.task_params import TaskParams
from footfall.models.robots.contact_geometry import CONTACT_MODELS
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_description import RobotDescription
from footfall.models.robots.robot_errors import RobotError
from footfall.models.scenes.room_obstacles import place_boxes
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.solids import upright_pose
from footfall.models.values.validation import (
    MAX_SEED,
    Parameters,
    choice,
    number,
    share,
)
from footfall.systems.sensing.ankle_force_sensors import AnkleForceParams
from footfall.systems.sensing.depth_camera import DepthCameraParams
from footfall.systems.sensing.imu import ImuParams
from footfall.systems.sensing.joint_encoders import JointEncoderParams
from footfall.systems.sensing.tilting_lidar import TiltingLidarParams

ONLY_DYNAMIC = ("room_crossing", "stand")
"""Tasks that are not done quasi-static."""
APPROXIMATIONS = ("lagged", "similar", "sap")
"""What Drake offers of its contact problem that is convex."""


ESTIMATED = "estimated"
STATES = (ESTIMATED, "true")
"""What the robot may know of itself."""


class ScenarioError(ValueError):
    """A scenario cannot be used; the message is one line naming file and field."""


@dataclass(kw_only=True)
class RobotParams(Parameters):
    """The robot and where it starts."""

    name: str = "jvrc1"
    """Which robot: "jvrc1", or a YAML file of one's own, its path from the scenario's
    file (of --set from the working folder), as in `robot: my_robot.yaml`."""
    description: RobotDescription | None = None
    """What a file of one's own says, and what it leaves out as it was read off the
    URDF; in a scenario what is said here counts before the file."""
    x: float = number(0.0, "m")
    """Midpoint of its feet along x of W, m."""
    y: float = number(0.0, "m")
    """Midpoint of its feet along y of W, m."""
    yaw: float = number(0.0, "rad")
    """Where it faces, about z of W from its x, rad."""
    state: str = choice(ESTIMATED, STATES)
    """What controllers and planners know of the robot: "estimated", by its own sensors,
    or "true", what the simulation knows, without noise and delay, to compare with."""
    com_error_ahead: float = number(0.0, "m", least=-0.1, most=0.1)
    """How far ahead of where it is the robot's model has its CoM, m: to see what a
    wrong model does."""
    com_error_left: float = number(0.0, "m", least=-0.1, most=0.1)
    """How far to the left of it, m."""

    def model(self) -> RobotModel:
        """Gives the robot's names, sole, postures and gains."""
        if self.description is not None:
            return model_of(self.description)
        return ROBOTS[self.name]

    def validate(self) -> None:
        """Checks every field, and that the robot is known.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if self.description is None and self.name not in ROBOTS:
            raise ValueError(
                f"name: must be one of {', '.join(ROBOTS)}, or a file that ends with "
                f".yaml, got {self.name!r}"
            )


@dataclass(kw_only=True)
class SensorsParams(Parameters):
    """What the robot senses with."""

    camera: DepthCameraParams = field(default_factory=DepthCameraParams)
    """The room's ceiling camera; "room_crossing" only."""
    lidar: TiltingLidarParams = field(default_factory=TiltingLidarParams)
    """The scanner on its head. `simulation.seed` is added to its seed."""
    imu: ImuParams = field(default_factory=ImuParams)
    """The inertial unit in its pelvis."""
    encoders: JointEncoderParams = field(default_factory=JointEncoderParams)
    """Those of its joints."""
    ankles: AnkleForceParams = field(default_factory=AnkleForceParams)
    """The force sensors above its feet."""


@dataclass(kw_only=True)
class SimulationParams(Parameters):
    """How the world is simulated."""

    time_step: float = number(0.0025, "s", least=1e-5, most=0.1)
    """Step of the plant, s."""
    contact_model: str = choice("hydroelastic", CONTACT_MODELS)
    """How soles meet the ground: "hydroelastic" (rubber that carries wherever something
    is under it), or "point" (six small spheres and a plate above them)."""
    contact_approximation: str = choice("lagged", APPROXIMATIONS)
    """How Drake solves contact: "lagged", "similar" or "sap"."""
    max_time: float = number(120.0, "s", above=0.0)
    """When the run is given up, s of simulated time."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Seed of everything that is random."""


@dataclass(kw_only=True)
class Scenario(Parameters):
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
        """Gives the scanner's parameters with the seed of this run."""
        lidar = self.sensors.lidar
        return replace(lidar, seed=lidar.seed + self.simulation.seed)

    def controllers(self) -> ControllerParams:
        """Gives the parameters of the systems, with what they share in each of them.

        What a section itself holds for a number that is shared does not count.
        """
        params, lidar = self.parameters, self.sensors.lidar
        return share(
            params,
            {
                "parameters.control_period": params.control_period,
                "parameters.friction": params.friction,
                "parameters.com_height": params.com_height,
                "sensors.lidar.line_period": lidar.line_period,
                "task.steps_between_scans": self.task.steps_between_scans,
            },
        )

    def validate(self) -> None:
        """Checks every part, and what concerns more than one.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        self._check_shared()
        model, room = self.robot.model(), self.scene.room
        start = upright_pose(self.robot.x, self.robot.y)
        p_RStart = room.X_WR().inverse().multiply(start).translation()
        if abs(p_RStart[0]) > room.length / 2 or abs(p_RStart[1]) > room.width / 2:
            raise ValueError(
                "robot: must start inside the room, "
                f"got x {self.robot.x:g} m, y {self.robot.y:g} m"
            )
        try:
            self.parameters.footstep_planner.validate(model.sole)
        except ValueError as error:
            raise ValueError(f"parameters.footstep_planner.{error}") from None
        self._check_widths(model)
        if self.task.kind == "stair_climbing" and not self.scene.treads():
            raise ValueError(
                f"scene.staircase: the task {self.task.kind} needs one, or flights or "
                "models that have treads"
            )
        if self.task.mode != "dynamic" and self.task.kind in ONLY_DYNAMIC:
            raise ValueError(
                f"task.mode: {self.task.kind} is only done dynamic, "
                f"got {self.task.mode!r}"
            )
        for name in self.sensors.encoders.stuck_joints:
            if name not in model.limits:
                close = difflib.get_close_matches(name, sorted(model.limits), n=1)
                hint = f"; did you mean {close[0]}?" if close else ""
                raise ValueError(
                    f"sensors.encoders.stuck_joints: {model.name} has no joint "
                    f"{name!r}{hint}"
                )
        links = {
            link.attrib["name"]
            for link in ET.parse(model.urdf).getroot().findall("link")
        }
        for index, push in enumerate(self.task.pushes):
            if push.body and push.body not in links:
                close = difflib.get_close_matches(push.body, sorted(links), n=1)
                hint = f"; did you mean {close[0]}?" if close else ""
                raise ValueError(
                    f"task.pushes[{index}].body: {model.name} has no link "
                    f"{push.body!r}{hint}"
                )

    def _check_shared(self) -> None:
        tick, crossing = self.parameters.control_period, self.parameters.crossing
        for name, value, unit, step in (
            ("control_period", tick, "simulation.time_step", self.simulation.time_step),
            ("crossing.sampling", crossing.sampling, "parameters.control_period", tick),
            (
                "crossing.quasi_static.sampling",
                crossing.quasi_static.sampling,
                "parameters.control_period",
                tick,
            ),
        ):
            count = round(value / step)
            if count < 1 or abs(value - count * step) > 1e-9:
                raise ValueError(
                    f"parameters.{name}: must be a multiple of {unit}, {step:g} s, "
                    f"got {value:g} s"
                )
        try:
            self.controllers().validate()
        except ValueError as error:
            raise ValueError(f"parameters.{error}") from None

    def _check_widths(self, model: RobotModel) -> None:
        soles = 4.0 * model.sole.half_width
        widths = [(f"flights[{i}]", f.width) for i, f in enumerate(self.scene.flights)]
        if self.scene.staircase is not None:
            widths.insert(0, ("staircase", self.scene.staircase.width))
        for path, width in widths:
            if width < soles:
                raise ValueError(
                    f"scene.{path}.width: must be at least {soles:g} m, two soles of "
                    f"{model.name} abreast, got {width:g} m"
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
    folder = Path(name_or_path).absolute().parent
    applied: list[tuple[str, str]] = []
    try:
        data = parse_yaml(text)
        if not isinstance(data, dict):
            raise FieldError("", "must hold the fields of a scenario")
        data = {key: value for key, value in data.items() if str(key)[:1] != "_"}
        data.setdefault("name", stem)
        name_parts(data, folder)
        check(data, Scenario)
        for override in overrides:
            applied.append((_override(data, override), override))
            name_parts(data, Path.cwd())
            check(data, Scenario)
        expand_robot(data, Path(name_or_path).absolute())
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
    except RobotError as error:
        raise ScenarioError(f"{label}: robot: {error.one_line}") from None
    return scenario


def name_parts(data: Mapping, folder: Path) -> None:
    """Spells out what a scenario may say in a word: robot, sensors and paths."""
    name_robot(data, folder)
    name_models(data, folder)
    expand_words(data)


def name_models(data: Mapping, folder: Path) -> None:
    """Writes the paths of the scene's models in full.

    Args:
        data: of a scenario; changed in place.
        folder: that the paths start in.
    """
    scene = data.get("scene")
    models = scene.get("models") if isinstance(scene, dict) else None
    for model in models if isinstance(models, list) else ():
        if isinstance(model, dict) and isinstance(model.get("file"), str):
            model["file"] = str(folder / model["file"])


def place_clutter(scenario: Scenario) -> Scenario:
    """Places the boxes of the scenario's clutter, drawn with the run's seed.

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
    """Writes every field that acts, with its unit; it loads back equal."""
    Path(path).write_text(commented_yaml(scenario), encoding="utf-8")


def _read(name_or_path: str | Path) -> tuple[str, str, str]:
    """Reads a scenario: what messages call it, a name where it has none, its text."""
    path, shipped = Path(name_or_path), shipped_scenarios()
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
    """Tells whether one of two paths to a field leads through the other."""
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
