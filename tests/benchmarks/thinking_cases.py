"""What a robot thinks about, timed: sweeps, frames and plans of drawn scenes.

Each task's closed loop is built once. Its robot is put where it would think, sees a
drawn scene without being simulated, and goes on at the end of what it has planned.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter, process_time
from typing import Any, TypeVar

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.framework import System

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.solids import triangle_mesh, upright_pose
from footfall.models.values.perceived import PlaneSegmentation, Staircase
from footfall.models.values.planned import FootstepPlan, MotionPlan
from footfall.models.values.room import DepthImage, Environment
from footfall.models.values.vector import Vector
from footfall.systems.perception.depth_cloud import point_cloud
from footfall.systems.perception.obstacles.obstacles import find_obstacles
from footfall.systems.perception.staircases.staircase_merging import merge_staircase
from footfall.systems.planning.executive.path_executive import blocking_box
from footfall.systems.planning.motion.motion_choice import Mode
from footfall.systems.planning.motion.motion_stop import stop_early
from footfall.systems.planning.motion.motion_task import Walker
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    planning_body,
)
from footfall.systems.sensing.depth_camera import measure_depth
from footfall.systems.sensing.pinhole import pixel_rays
from footfall.systems.sensing.ray_caster import RayCaster
from footfall.systems.sensing.scan_geometry import (
    beam_directions,
    line_to_points,
    tilt_pose,
)
from footfall.systems.sensing.tilting_lidar import measure

T = TypeVar("T")
PLANNING: dict[tuple[str, Mode], str] = {
    ("climb", "dynamic"): "climb_planning",
    ("climb", "quasi_static"): "quasi_static_climb_planning",
    ("crossing", "dynamic"): "crossing_planning",
    ("crossing", "quasi_static"): "quasi_static_crossing_planning",
}
"""Which field of `ThinkingParams` holds the time of a plan."""
MAX_LEGS = 4
"""After so many plans the next scene is drawn."""


@dataclass(frozen=True)
class Sample:
    """How long one thought took."""

    kind: str
    """The field of `ThinkingParams` that it belongs to."""
    wall: float
    """s."""
    cpu: float
    """Of all threads of this process, s."""


class Stopwatch:
    """Collects samples."""

    def __init__(self) -> None:
        """Has none."""
        self.samples: list[Sample] = []

    def time(self, kind: str, think: Callable[[], T]) -> T:
        """The thought's result; how long it took is kept."""
        wall, cpu = perf_counter(), process_time()
        result = think()
        wall, cpu = perf_counter() - wall, process_time() - cpu
        self.samples.append(Sample(kind, wall, cpu))
        return result


class Robot:
    """A task's closed loop, not simulated: its inputs are fixed as they are wanted."""

    def __init__(self, scenario: Scenario) -> None:
        """Builds it; the robot stands where the scenario starts it."""
        self.scenario = scenario
        self.task = build_task(scenario)
        self.context = self.task.diagram.CreateDefaultContext()
        body_poses = self.task.plant.get_body_poses_output_port()
        poses = body_poses.Eval(self.task.plant.GetMyContextFromRoot(self.context))
        self.body_poses = [RigidTransform(pose) for pose in poses]
        self.believed_poses = self.task.output(
            "believed_poses.body_poses", self.context
        )
        model = scenario.robot.model()
        head = self.task.plant.GetBodyByName(model.head_body, self.task.robot_instance)
        mount = upright_pose(*model.lidar_position)
        self.feet = self.port("motion_player", "foot_references")[:12].reshape(2, 6)
        self.com = self.port("com_reference", "com_reference")[:3]
        self._X_FeetM = self._X_WFeet().inverse() @ (
            self.body_poses[int(head.index())] @ mount
        )

    def _X_WFeet(self) -> RigidTransform:
        """Midway between the feet."""
        return upright_pose(*self.feet[:, :3].mean(axis=0), self.feet[:, 5].mean())

    def system(self, name: str) -> System:
        """A subsystem."""
        return self.task.system(name)

    def port(self, name: str, port: str) -> Any:
        """The value at a subsystem's output."""
        system = self.system(name)
        context = system.GetMyContextFromRoot(self.context)
        return system.GetOutputPort(port).Eval(context)

    def fix(self, name: str, **values: object) -> None:
        """Sets a subsystem's inputs, whatever they are connected to."""
        system = self.system(name)
        context = system.GetMyMutableContextFromRoot(self.context)
        for port, value in values.items():
            if not isinstance(value, np.ndarray):
                value = AbstractValue.Make(value)
            system.GetInputPort(port).FixValue(context, value)

    def stand(self, feet: Vector, com: Vector) -> None:
        """Puts feet, (2, 6), and CoM, (3,), where its planners are to begin."""
        self.feet, self.com = feet, com
        references = np.concatenate([feet.ravel(), np.zeros(12)])
        planners = ("footstep_planner", "motion_planner", "crossing_planner")
        names = [leaf.get_name() for _, leaf in leaf_systems(self.task.diagram)]
        for name in (name for name in planners if name in names):
            for port, value in (
                ("foot_poses", feet.ravel()),
                ("foot_references", references),
                ("com_reference", np.concatenate([com, np.zeros(6)])),
            ):
                if self.system(name).HasInputPort(port):
                    self.fix(name, **{port: value})

    def sweep(self, scene: SceneParams, seed: int) -> tuple[Vector, Vector]:
        """Points in W, (n, 3), m, that the scanner sees from here, and from where."""
        lidar = self.scenario.lidar()
        angles, directions = lidar.angles(), beam_directions(lidar.angles())
        caster = RayCaster(triangle_mesh(scene.solids()), ())
        X_WM = self._X_WFeet() @ self._X_FeetM
        lines = []
        for number, tilt in enumerate(lidar.tilts()):
            X_WL = X_WM @ tilt_pose(float(tilt))
            distances = caster.cast(X_WL, angles, directions, ())
            ranges = measure(distances, number, replace(lidar, seed=seed))
            lines.append(line_to_points(ranges, angles, X_WL))
        return np.vstack(lines), X_WM.translation()


def climbs(watch: Stopwatch, count: int, mode: Mode) -> None:
    """Staircases of 2 to 5 steps, seen and climbed."""
    robot = Robot(load_scenario("stairs-exp1", [f"task.mode={mode}"]))
    start, random = (robot.feet, robot.com), np.random.default_rng(0)
    merging = robot.scenario.parameters.staircase_map
    for seed in range(count):
        staircase = replace(
            robot.scenario.scene.staircase,  # type: ignore[type-var]
            rise=random.uniform(0.10, 0.20),
            run=random.uniform(0.27, 0.32),
            steps=int(random.integers(2, 6)),
            width=random.uniform(0.5, 1.2),
            yaw=np.radians(random.uniform(-10.0, 10.0)),
        )
        scene = replace(robot.scenario.scene, staircase=staircase)
        known = Staircase()
        robot.stand(*start)
        for _ in range(MAX_LEGS):
            points, eye = robot.sweep(scene, seed)
            robot.fix("plane_segmenter", cloud=point_cloud(points), viewpoint=eye)

            def segment(known: Staircase = known) -> Staircase:
                seen = robot.port("plane_segmenter", "segmentation")
                assert isinstance(seen, PlaneSegmentation)
                return merge_staircase(known, seen, merging)

            known = watch.time("segmentation", segment)
            for name in ("footstep_planner", "motion_planner"):
                robot.fix(name, staircase=known)
            if not _walk(robot, watch, PLANNING["climb", mode]):
                break


def crossings(watch: Stopwatch, count: int, mode: Mode) -> None:
    """Obstacles that are low, high and too high, found and crossed."""
    robot = Robot(load_scenario("obstacle-15cm", [f"task.mode={mode}"]))
    highest = 0.28 if mode == "dynamic" else 0.17
    start, random = (robot.feet, robot.com), np.random.default_rng(0)
    for seed in range(count):
        height, width = random.uniform(0.05, highest), random.uniform(0.02, 0.08)
        box = replace(
            robot.scenario.scene.boxes[0],
            x=random.uniform(0.8, 1.5),
            yaw=np.radians(random.uniform(-15.0, 15.0)),
            size=[width, 1.2, height],
        )
        scene = replace(robot.scenario.scene, boxes=[box])
        robot.stand(*start)
        for _ in range(MAX_LEGS):
            points, eye = robot.sweep(scene, seed)
            find = partial(
                find_obstacles, points, eye, robot.scenario.parameters.obstacle_finder
            )
            found = watch.time("obstacle_finding", find)
            robot.fix("crossing_planner", obstacle_map=found)
            if not _walk(robot, watch, PLANNING["crossing", mode]):
                break


def _walk(robot: Robot, watch: Stopwatch, kind: str) -> bool:
    """Plans and stands where the plan ends; False where there is nothing to walk."""
    crosses = robot.task.diagram.HasSubsystemNamed("crossing_planner")

    def plan() -> tuple[FootstepPlan, MotionPlan | None]:
        planner = "crossing_planner" if crosses else "footstep_planner"
        footsteps = robot.port(planner, "footstep_plan")
        if footsteps.status != "planned":
            return footsteps, None
        planner = "crossing_planner" if crosses else "motion_planner"
        return footsteps, robot.port(planner, "motion_plan")

    footsteps, motion = watch.time(kind, plan)
    if footsteps.status == "finished":
        # Seen at a glance; it would only hide how long a plan takes.
        watch.samples.pop()
    if motion is None or motion.reason:
        return False
    robot.stand(motion.foot_poses[-1], motion.com[-1])
    return True


def rooms(watch: Stopwatch, count: int) -> None:
    """Rooms with 6 to 10 boxes, seen, crossed, and stopped in at four times."""
    robot = Robot(load_scenario("room"))
    model = robot.scenario.robot.model()
    body = planning_body(model, robot_alone(model))
    camera = robot.scenario.sensors.camera
    rays = pixel_rays(camera.rows, camera.columns, camera.focal_length)
    for seed in range(count):
        scene = load_scenario("room", [f"simulation.seed={seed}"]).scene
        caster = RayCaster(triangle_mesh(scene.solids()), ())
        depth = caster.cast_beams(camera.X_WC(), rays, (), lambda p, r: (), threads=0)
        picture = measure_depth(depth, 0, replace(camera, seed=seed))
        shape = camera.rows, camera.columns
        image = DepthImage(
            0.0, camera.X_WC(), camera.focal_length, picture.reshape(shape)
        )
        robot.fix("depth_cloud", depth_image=image, body_poses=robot.believed_poses)

        def perceive() -> Environment:
            seen = robot.port("environment_exchange", "environment")
            assert isinstance(seen, Environment)
            return seen

        environment = watch.time("room_perception", perceive)

        def plan() -> MotionPlan:
            motion = robot.port("motion_planner", "motion_plan")
            assert isinstance(motion, MotionPlan)
            return motion

        motion = watch.time("room_planning", plan)
        for share in (0.1, 0.3, 0.5, 0.7):
            watch.time(
                "stopping", partial(_stop, robot, body, environment, motion, share)
            )


def _stop(
    robot: Robot,
    body: WholeBody,
    environment: Environment,
    motion: MotionPlan,
    share: float,
) -> MotionPlan | None:
    """What is thought on the way, after a share of the walk."""
    model, parameters = robot.scenario.robot.model(), robot.scenario.parameters
    radius = parameters.path_executive.body_radius
    blocking_box(motion.footsteps, environment, model.sole, radius)
    return stop_early(
        motion,
        share * motion.duration,
        parameters.footstep_planner.stance_width,
        Walker(parameters.motion_planner, parameters.zmp_preview, model, body),
    )


def think(scenes: int, quasi_static: int) -> list[Sample]:
    """Times every kind of thought.

    Args:
        scenes: how many staircases, obstacles and rooms are drawn.
        quasi_static: how many staircases and obstacles more for quasi-static motion.
    """
    watch = Stopwatch()
    climbs(watch, scenes, "dynamic")
    crossings(watch, scenes, "dynamic")
    rooms(watch, scenes)
    climbs(watch, quasi_static, "quasi_static")
    crossings(watch, quasi_static, "quasi_static")
    return watch.samples
