"""Time of one line of the scanner among the bodies of the robot, and of its points."""

from typing import Any

import numpy as np
import pytest
from pydrake.math import RigidTransform
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import body_meshes, prepared_urdf
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.solids import triangle_mesh, upright_pose
from footfall.models.scenes.staircase import StaircaseParams
from footfall.systems.perception.scan_assembler import box_around, remove_own_points
from footfall.systems.sensing.ray_caster import BodyMesh, RayCaster
from footfall.systems.sensing.scan_geometry import (
    beam_directions,
    line_to_points,
    tilt_pose,
)
from footfall.systems.sensing.tilting_lidar import TiltingLidarParams, measure

PARAMS = TiltingLidarParams()


@pytest.fixture(scope="module")
def standing() -> tuple[list[BodyMesh], list[RigidTransform], RigidTransform]:
    """The robot's bodies but the head, the poses of all of them, the scanner's pose."""
    plant = MultibodyPlant(0.002)
    Parser(plant).AddModelsFromString(prepared_urdf(JVRC1), "urdf")
    plant.Finalize()
    context = plant.CreateDefaultContext()
    for joint, angle in JVRC1.posture.items():
        plant.GetJointByName(joint).set_angle(context, angle)
    base = plant.GetBodyByName(JVRC1.base_body)
    plant.SetFreeBodyPose(context, base, upright_pose(z=0.85))
    bodies = [
        BodyMesh(
            int(plant.GetBodyByName(mesh.body).index()),
            mesh.vertices,
            mesh.triangles.astype(np.int64),
        )
        for mesh in body_meshes(JVRC1)
        if mesh.body != JVRC1.head_body
    ]
    poses = plant.get_body_poses_output_port().Eval(context)
    head = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(JVRC1.head_body))
    return bodies, poses, head.multiply(upright_pose(*JVRC1.lidar_position))


@pytest.mark.parametrize("tilt_deg", [30.0, 60.0, 90.0])
def test_line(tilt_deg: float, standing: Any, benchmark: Any) -> None:
    """Casting 1081 beams against the scene and 34 bodies, and the noise."""
    bodies, poses, X_WM = standing
    scene = triangle_mesh(SceneParams(staircase=StaircaseParams()).solids())
    caster = RayCaster(scene, bodies)
    angles = PARAMS.angles()
    directions = beam_directions(angles)
    X_WL = X_WM.multiply(tilt_pose(np.radians(tilt_deg)))

    def line() -> np.ndarray:
        distances = caster.cast(X_WL, angles, directions, poses)
        return measure(distances, 0, PARAMS)

    assert np.isfinite(benchmark(line)).all()


def test_points_of_a_line(standing: Any, benchmark: Any) -> None:
    """To W, and the robot's own removed by 34 boxes."""
    bodies, poses, X_WM = standing
    boxes = [box_around(body.body_index, body.vertices) for body in bodies]
    angles = PARAMS.angles()
    ranges = np.full(len(angles), 2.0)
    X_WL = X_WM.multiply(tilt_pose(0.8))

    def points() -> np.ndarray:
        return remove_own_points(
            line_to_points(ranges, angles, X_WL), boxes, poses, 0.03
        )

    assert len(benchmark(points)) <= len(angles)
