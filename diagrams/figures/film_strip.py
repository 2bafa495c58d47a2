"""A run as pictures in a row, rendered without a display.

So the stair paper shows a climb (Fig. 8) and the obstacle paper a crossing (Fig. 10).
"""

import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from pydrake.geometry import (
    ClippingRange,
    ColorRenderCamera,
    LightParameter,
    MakeRenderEngineVtk,
    RenderCameraCore,
    RenderEngineVtkParams,
)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.sensors import CameraInfo

from footfall.diagrams.figures.crossing_data import PlannedCrossing, planned_crossings
from footfall.diagrams.run_data import mover_positions
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signal_names import PLAN_SIGNAL, STATE_SIGNAL
from footfall.diagrams.signals import Run, RunError, load_run
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.mover import add_movers
from footfall.models.scenes.solids import add_solids
from footfall.models.values.vector import Vector

STRIP_FILE = "figures/film_strip.png"
WIDTH, HEIGHT = 320, 480
"""Of a picture, pixels."""
COLUMNS = 6
VIEW = np.array([0.5, -2.1, 0.3])
"""From the robot's base to the camera, m: from its right, a little from the front."""
CROSSING_VIEW = np.array([1.1, -1.75, 0.55])
"""The same over obstacles: from higher up and farther ahead, so that neither the near
leg nor the obstacle hides a foot."""
LIGHTS = (((0.35, 0.6, -0.7), 1.0), ((-0.7, 0.3, -0.4), 0.55))
"""Directions in W in which light falls, and how bright it is."""
_ENGINE = "film"


def render_run(
    folder: Path, frames: int = 12, start: float | None = None, end: float | None = None
) -> Path:
    """Renders a run as a film strip into its folder; gives the picture's path.

    Args:
        folder: of the run.
        frames: how many pictures.
        start: when the first is taken, s; None for when the robot first moves or,
            where it crosses obstacles, a step before phase 1.
        end: when the last is taken, s; None for when it last moves or a step after
            phase 3. Without both what lies between two motions is left out.

    Raises:
        RunError: the folder holds no run, one without the plant's state, or nothing
            between start and end.
        ScenarioError: its scenario cannot be read.
    """
    run = load_run(folder)
    if STATE_SIGNAL not in run.signals:
        raise RunError(f"{folder}: the run did not log {STATE_SIGNAL}")
    samples = run.signals[STATE_SIGNAL].to_numpy(dtype=np.float64)
    time, state = samples[:, 0], samples[:, 1:]
    crossings = _crossings(run)
    stretches = _moving(run, time)
    if crossings:
        both = np.array([plan.stretch() for plan in crossings])
        stretches = [(float(both.min()), float(both.max()))]
    if start is not None or end is not None:
        first = stretches[0][0] if start is None else max(start, float(time[0]))
        last = stretches[-1][1] if end is None else min(end, float(time[-1]))
        stretches = [(first, last)]
    first, last = stretches[0][0], stretches[-1][1]
    if not first < last:
        raise RunError(f"{folder}: nothing to render between {first:g} and {last:g} s")
    moments = spread(stretches, frames)
    rows = np.minimum(np.searchsorted(time, moments), len(time) - 1)
    view = turned(CROSSING_VIEW, crossings[0].obstacles[0].yaw) if crossings else VIEW
    movers = mover_positions(run, time[rows])
    pictures = render_states(run, state[rows], view, movers)
    path = folder / STRIP_FILE
    path.parent.mkdir(exist_ok=True)
    figure = strip_figure(pictures, moments - first)
    with whole_file(path) as partial:
        FigureCanvasAgg(figure).print_png(str(partial))  # type: ignore[no-untyped-call]
    return path


def render_states(
    run: Run, states: Vector, view: Vector = VIEW, movers: Vector | None = None
) -> list[Vector]:
    """Renders the robot in its scene at each state, (height, width, 3) each.

    Args:
        run: its robot and scene.
        states: positions, then velocities of the robot, (n, nq + nv).
        view: from the robot's base to the camera in W, (3,), m.
        movers: x and y of each box that moves, in turn, (n, 2 k), m; None leaves them
            where they stand at first.
    """
    scenario = run.scenario
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    solids = scenario.scene.solids()
    add_solids(
        plant,
        (solid for solid in solids if solid.role != "wall"),
    )
    robot = scenario.robot.model()
    instance = add_robot(plant, scene_graph, robot)
    moving = add_movers(plant, scenario.scene.movers)
    plant.Finalize()
    lights = [
        LightParameter(
            type="directional",
            frame="world",
            direction=np.array(direction) / np.linalg.norm(direction),
            intensity=intensity,
        )
        for direction, intensity in LIGHTS
    ]
    with _without_warnings_of_materials():
        scene_graph.AddRenderer(
            _ENGINE, MakeRenderEngineVtk(RenderEngineVtkParams(lights=lights))
        )
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    plant_context = plant.GetMyMutableContextFromRoot(context)
    query = scene_graph.get_query_output_port()
    scene_context = scene_graph.GetMyContextFromRoot(context)
    camera = ColorRenderCamera(
        RenderCameraCore(
            _ENGINE,
            CameraInfo(WIDTH, HEIGHT, np.deg2rad(50.0)),
            ClippingRange(0.05, 20.0),
            RigidTransform(),
        ),
        False,
    )
    base = plant.GetBodyByName(robot.base_body, instance)
    positions = plant.num_positions(instance)
    pictures = []
    for index, row in enumerate(states):
        q: Vector = row[:positions]
        plant.SetPositions(plant_context, instance, q)
        if movers is not None:
            p_WM: Vector = movers[index]
            plant.SetPositions(plant_context, moving, p_WM)
        p_WBase = base.EvalPoseInWorld(plant_context).translation()
        image = query.Eval(scene_context).RenderColorImage(
            camera, scene_graph.world_frame_id(), look_at(p_WBase + view, p_WBase)
        )
        pictures.append(np.array(image.data)[:, :, :3])
    return pictures


@contextmanager
def _without_warnings_of_materials() -> Iterator[None]:
    """Drake warns of every mesh that brings its own material, as all of them do."""
    logger = logging.getLogger("drake")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


def look_at(p_WCamera: Vector, p_WTarget: Vector) -> RigidTransform:
    """Pose of a camera (x right, y down, z ahead) that looks at a point, upright."""
    ahead = (p_WTarget - p_WCamera) / np.linalg.norm(p_WTarget - p_WCamera)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    R: Vector = np.column_stack([right, np.cross(ahead, right), ahead])
    return RigidTransform(RotationMatrix(R), p_WCamera)


def strip_figure(pictures: list[Vector], moments: Vector) -> Figure:
    """Pictures in rows with their time stamps, s, below them."""
    columns = min(COLUMNS, len(pictures))
    rows = -(-len(pictures) // columns)
    figure = Figure(figsize=(1.9 * columns, 3.1 * rows), dpi=120, layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False)
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, picture, moment in zip(axes.flat, pictures, moments, strict=False):
        ax.imshow(picture)
        ax.set_title(f"{moment:.1f} s", y=-0.09, fontsize=10)
    return figure


def turned(v: Vector, yaw: float) -> Vector:
    """Turns a vector by yaw, rad, about z, (3,)."""
    R_z: Vector = RotationMatrix.MakeZRotation(yaw).matrix()
    return R_z @ v


def _crossings(run: Run) -> tuple[PlannedCrossing, ...]:
    """Reads what was crossed, if anything."""
    if PLAN_SIGNAL not in run.value_names:
        return ()
    return planned_crossings(run.values(PLAN_SIGNAL))


def spread(stretches: Sequence[tuple[float, float]], count: int) -> Vector:
    """Moments at equal distances over stretches of time put end to end, (count,), s.

    Args:
        stretches: begin and end of each, s, in order.
        count: how many moments; the first is the begin of all, the last the end.
    """
    begins, ends = np.array(stretches, dtype=np.float64).T
    passed = np.concatenate([[0.0], np.cumsum(ends - begins)])
    wanted = np.linspace(0.0, passed[-1], count)
    index = np.clip(np.searchsorted(passed, wanted) - 1, 0, len(begins) - 1)
    moments: Vector = begins[index] + wanted - passed[index]
    return moments


def _moving(run: Run, time: Vector) -> list[tuple[float, float]]:
    """Finds when the robot moved, by its executive; all of the run without one."""
    always = [(float(time[0]), float(time[-1]))]
    if "executive.status" not in run.value_names:
        return always
    entries = run.values("executive.status")
    ends = [*(moment for moment, _ in entries[1:]), float(time[-1])]
    moves = [
        (moment, end)
        for (moment, status), end in zip(entries, ends, strict=True)
        if status.get("activity") in ("move", "walk") and end > moment
    ]
    return moves or always
