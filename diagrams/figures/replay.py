"""A run as a page that moves: Meshcat recorded, openable without a server."""

from pathlib import Path

import numpy as np
from pydrake.geometry import Meshcat, MeshcatVisualizer, MeshcatVisualizerParams, Role
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder

from footfall.diagrams.figures.live_view import meshcat_at
from footfall.diagrams.figures.replay_overlays import (
    Overlays,
    add_overlays,
    read_overlays,
)
from footfall.diagrams.run_data import mover_positions, read_run_data
from footfall.diagrams.signal_files import whole_file
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.mover import add_movers
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.solids import add_solids
from footfall.models.values.vector import Vector

REPLAY_FILE = "replay.html"
FRAME_RATE = 32.0
"""Frames a second of the recording, at most."""
MAX_FRAMES = 2000
"""A longer run is recorded at fewer frames a second, so that the page stays below
15 MB."""


LATER = 1e-7
"""How long past the beginning of a frame it is taken, s."""
OPEN_CONTROLS = """<script>
    viewer.gui.open();
    viewer.gui.width = 360;
    viewer.gui.__folders["Scene"].close();
  </script>
"""
"""Put at the end of Meshcat's page; the folder with the time slider opens itself."""


def replay_html(
    robot: RobotModel,
    scene: SceneParams,
    time: Vector,
    state: Vector,
    movers: Vector | None = None,
    overlays: Overlays | None = None,
) -> str:
    """Writes a self-contained page that plays the robot's motion in its scene.

    The walls and the ceiling of the room are left out, so that one can look in.

    Args:
        robot: which robot.
        scene: what stands around it.
        time: of the samples, (n,), s.
        state: positions, then velocities of the robot, (n, nq + nv).
        movers: x and y of each box that moves, in turn, (n, 2 k), m; None leaves them
            where they stand at first.
        overlays: what is shown beside the robot, of the same samples.

    Raises:
        ValueError: the state has another size than the robot's, or the movers than
            the scene's.
    """
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    add_solids(plant, (solid for solid in scene.solids() if solid.role != "wall"))
    instance = add_robot(plant, scene_graph, robot)
    moving = add_movers(plant, scene.movers)
    plant.Finalize()
    size = plant.num_multibody_states(instance)
    if state.shape != (len(time), size):
        raise ValueError(
            f"state: expected shape ({len(time)}, {size}), got {state.shape}"
        )
    if movers is not None and movers.shape != (len(time), 2 * len(scene.movers)):
        raise ValueError(
            f"movers: expected shape ({len(time)}, {2 * len(scene.movers)}), "
            f"got {movers.shape}"
        )
    positions = state[:, : plant.num_positions(instance)]
    rate = min(FRAME_RATE, MAX_FRAMES / max(float(time[-1] - time[0]), 1e-3))
    meshcat = meshcat_at()
    for path in ("/Grid", "/Axes"):
        meshcat.SetProperty(path, "visible", False)
    params = MeshcatVisualizerParams()
    params.role = Role.kIllustration
    params.publish_period = 1.0 / rate
    visualizer = MeshcatVisualizer.AddToBuilder(builder, scene_graph, meshcat, params)
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    plant_context = plant.GetMyMutableContextFromRoot(context)
    recording = visualizer.StartRecording(set_transforms_while_recording=False)
    recording.set_loop_mode(type(recording).LoopMode.kLoopOnce)
    moments = [
        (float(moment), min(int(np.searchsorted(time, moment)), len(time) - 1))
        for moment in frame_times(float(time[0]), float(time[-1]), rate)
    ]
    for moment, sample in moments:
        context.SetTime(moment)
        plant.SetPositions(plant_context, instance, positions[sample])
        if movers is not None:
            plant.SetPositions(plant_context, moving, movers[sample])
        diagram.ForcedPublish(context)
    visualizer.StopRecording()
    if overlays is not None:
        add_overlays(meshcat, recording, overlays, robot.sole, moments)
    visualizer.PublishRecording()
    _place_camera(meshcat, positions)
    return with_open_controls(meshcat.StaticHtml())


def frame_times(begin: float, end: float, rate: float) -> Vector:
    """Times of all frames, s, each just past its beginning.

    Drake rounds a time down to a frame: right at its beginning that may be the one
    before, and one is left out.

    Args:
        begin: of the recording, s.
        end: of it, s.
        rate: frames a second.
    """
    times: Vector = np.arange(begin, end, 1.0 / rate) + LATER
    return times


def replay_run(folder: Path) -> Path:
    """Writes the page of a run into its folder, from what was logged; gives its path.

    Beside the robot it shows what the robot saw, the planned footholds, CoM, ZMP and
    the forces on the feet; see `replay_overlays`.

    Raises:
        RunError: the folder holds no run, or one without the plant's state.
        ScenarioError: its scenario cannot be read.
    """
    data = read_run_data(folder)
    run, time = data.run, data.motion.time
    html = replay_html(
        run.scenario.robot.model(),
        run.scenario.scene,
        time,
        data.state,
        mover_positions(run, time),
        read_overlays(data),
    )
    path = folder / REPLAY_FILE
    with whole_file(path) as partial:
        partial.write_text(html, encoding="utf-8")
    return path


def with_open_controls(page: str) -> str:
    """Opens the panel with the time slider, which is closed in Meshcat's page.

    Args:
        page: what `Meshcat.StaticHtml` gives.
    """
    before, end, after = page.rpartition("</body>")
    return f"{before}{OPEN_CONTROLS}{end}{after}"


def _place_camera(meshcat: Meshcat, positions: Vector) -> None:
    """Looks at the whole path from the side, a little from above."""
    path = positions[:, 4:7]
    centre = (path.min(axis=0) + path.max(axis=0)) / 2.0
    extent = float(np.ptp(path, axis=0).max())
    distance = 1.4 + 0.5 * extent
    camera = centre + distance * np.array([-0.35, -0.9, 0.3])
    meshcat.SetCameraPose(camera, centre)
