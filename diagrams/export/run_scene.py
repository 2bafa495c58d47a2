"""What of a run is shown in 3D, as messages over time."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex
from pydrake.systems.framework import Context

from footfall.diagrams.export.messages import (
    Look,
    Message,
    arrow,
    box,
    lines,
    scene_update,
    sphere,
    transforms,
    triangles,
)
from footfall.diagrams.figures.colors import COM, SEEN_THING, SIDES, ZMP
from footfall.diagrams.figures.replay_overlays import (
    ABOVE,
    FORCE_LENGTH,
    Overlays,
    read_overlays,
)
from footfall.diagrams.run_data import RunData
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector

RATE = 30.0
"""Of what moves, Hz."""
STICK = 0.03
"""How thick the robot's sticks are, m."""
TRANSFORMS, ROBOT, SCENE = "/tf", "/scene/robot", "/scene/solids"
SEEN, FOOTHOLDS, FORCES, BALANCE = (
    *("/scene/seen", "/scene/footholds"),
    *("/scene/forces", "/scene/balance"),
)
FRAMES, UPDATE = "foxglove.FrameTransforms", "foxglove.SceneUpdate"
SHOWN = {TRANSFORMS: FRAMES} | dict.fromkeys(
    (ROBOT, SCENE, SEEN, FOOTHOLDS, FORCES, BALANCE), UPDATE
)
"""By topic the schema of what is shown in 3D."""


class Shown(NamedTuple):
    """A message of what is shown."""

    topic: str
    time: float
    """s."""
    message: Message


def shown_of(data: RunData) -> Iterator[Shown]:
    """Yields all that is shown of a run: once what stands, then what moves, by time.

    Raises:
        RunError: a file of the run is damaged.
    """
    overlays, scenario = read_overlays(data), data.run.scenario
    robot = scenario.robot.model()
    begin = float(data.motion.time[0])
    mesh = triangle_mesh(s for s in scenario.scene.solids() if s.role != "wall")
    scene = triangles(mesh, Look("0.8"))
    yield Shown(SCENE, begin, scene_update(begin, "solids", triangles=[scene]))
    yield from _known(overlays, robot)
    plant = robot_alone(robot)
    context = plant.CreateDefaultContext()
    for sample in samples_at(data.motion.time, RATE):
        time = float(data.motion.time[sample])
        positions = data.state[sample, : plant.num_positions()]
        poses = body_poses(plant, context, positions)
        yield Shown(TRANSFORMS, time, transforms(time, poses))
        sticks = lines(_sticks(plant, poses), STICK, Look("0.45"))
        yield Shown(ROBOT, time, scene_update(time, "sticks", lines=[sticks]))
        yield from _felt(overlays, sample, time)


def samples_at(time: Vector, rate: float) -> list[int]:
    """Picks the samples at a rate, Hz, of times, (n,), s; each once."""
    wanted = np.arange(time[0], time[-1] + 1e-9, 1.0 / rate)
    found = np.minimum(np.searchsorted(time, wanted - 1e-9), len(time) - 1)
    return [int(sample) for sample in np.unique(found)]


def body_poses(
    plant: MultibodyPlant, context: Context, positions: Vector
) -> dict[str, RigidTransform]:
    """Computes the pose in W of every body of a robot alone, by name.

    Args:
        plant: with the robot alone.
        context: of the plant, which takes the positions.
        positions: of the robot, (nq,).
    """
    plant.SetPositions(context, positions)
    bodies = [plant.get_body(BodyIndex(index)) for index in range(plant.num_bodies())]
    return {
        body.name(): plant.EvalBodyPoseInWorld(context, body)
        for body in bodies
        if body.index() != plant.world_body().index()
    }


def _sticks(plant: MultibodyPlant, poses: dict[str, RigidTransform]) -> Vector:
    """Joins the origins of bodies that a joint joins, (k, 2, 3), m."""
    joined = []
    for index in plant.GetJointIndices():
        joint = plant.get_joint(index)
        ends = (joint.parent_body().name(), joint.child_body().name())
        if all(end in poses for end in ends):
            joined.append([poses[end].translation() for end in ends])
    sticks: Vector = np.array(joined).reshape(-1, 2, 3)
    return sticks


def _known(overlays: Overlays, robot: RobotModel) -> Iterator[Shown]:
    """Yields what was seen and planned, each time that it was new."""
    for seen in overlays.seen:
        raised: Vector = seen.edges + np.array([0.0, 0.0, ABOVE])
        outlines = lines(raised, 0.01, Look(SEEN_THING))
        yield Shown(SEEN, seen.time, scene_update(seen.time, "seen", lines=[outlines]))
    sole = robot.sole
    size: Vector = np.array([sole.length, 2.0 * sole.half_width, ABOVE])
    middle: Vector = np.array([(sole.toe - sole.heel) / 2.0, 0.0, ABOVE / 2.0])
    for index, foothold in enumerate(overlays.footholds):
        place = foothold.X_WF @ RigidTransform(middle)
        plate = box(place, size, Look(SIDES[foothold.foot], 0.6))
        update = scene_update(foothold.time, f"foothold {index}", cubes=[plate])
        yield Shown(FOOTHOLDS, foothold.time, update)


def _felt(overlays: Overlays, sample: int, time: float) -> Iterator[Shown]:
    """Yields contact forces, CoM and ZMP at a sample."""
    for foot in FEET:
        if (force := overlays.forces.get(foot)) is not None:
            span: Vector = FORCE_LENGTH * force.force[sample]
            one = arrow(force.point[sample], span, 0.012, Look(SIDES[foot]))
            arrows = [] if one is None else [one]
            yield Shown(FORCES, time, scene_update(time, foot, arrows=arrows))
    balls = [sphere(overlays.com[sample], 0.035, Look(COM))]
    if overlays.zmp is not None and np.isfinite(overlays.zmp[sample]).all():
        balls.append(sphere(overlays.zmp[sample], 0.028, Look(ZMP)))
    yield Shown(BALANCE, time, scene_update(time, "CoM and ZMP", spheres=balls))
