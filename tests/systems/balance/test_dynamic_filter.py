"""The dynamic filter: the multibody ZMP in physics, and the second stage of preview."""

import numpy as np
import pytest
from pydrake.math import RigidTransform
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PrismaticJoint,
    RevoluteJoint,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.framework import DiagramBuilder

from footfall.systems.balance.dynamic_filter import (
    MomentumTrajectory,
    filter_motion,
    filter_motion_varying_height,
    multibody_zmp,
    zmp_of_rates,
)
from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ZmpPreviewParams,
    generate,
    preview_gains,
)
from footfall.systems.balance.zmp_tracking import generate_varying_height

T = 0.005
TIMES = np.arange(1200) * T
PARAMS = ZmpPreviewParams()
GAINS = preview_gains(PARAMS)


def inertia(mass: float, p: list[float], size: float) -> SpatialInertia:
    """Of a box of that size about p."""
    return SpatialInertia.MakeFromCentralInertia(
        mass, p, mass * UnitInertia.SolidBox(size, 2 * size, 3 * size)
    )


def robot() -> MultibodyPlant:
    """A column on two slides with an arm that swings about an oblique axis."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    instance = plant.AddModelInstance("robot")
    previous = plant.world_body()
    for name, axis in (("x", [1, 0, 0]), ("y", [0, 1, 0])):
        body = plant.AddRigidBody(name, instance, inertia(5.0, [0, 0, 0.4], 0.1))
        plant.AddJoint(
            PrismaticJoint(name, previous.body_frame(), body.body_frame(), axis)
        )
        previous = body
    arm = plant.AddRigidBody("arm", instance, inertia(8.0, [0.1, 0.05, -0.3], 0.2))
    shoulder = plant.AddFrame(
        FixedOffsetFrame(
            "shoulder", previous.body_frame(), RigidTransform([0.0, 0.0, 1.2])
        )
    )
    plant.AddJoint(
        RevoluteJoint("swing", shoulder, arm.body_frame(), [0.6, 0.64, 0.48])
    )
    plant.Finalize()
    return plant


def swing() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, velocities and accelerations of the three joints."""
    rate, phase = np.array([1.3, 2.1, 3.0]), np.array([0.0, 0.4, 1.0])
    size = np.array([0.1, 0.05, 0.7])
    angle = np.outer(TIMES, rate) + phase
    return (
        size * np.sin(angle),
        size * rate * np.cos(angle),
        -size * rate**2 * np.sin(angle),
    )


def momentum_along(
    plant: MultibodyPlant, q: np.ndarray, v: np.ndarray
) -> MomentumTrajectory:
    """CoM and momentum of everything in a plant at every tick."""
    context = plant.CreateDefaultContext()
    com, linear, angular = [], [], []
    for position, velocity in zip(q, v, strict=True):
        plant.SetPositions(context, position)
        plant.SetVelocities(context, velocity)
        com.append(plant.CalcCenterOfMassPositionInWorld(context))
        found = plant.CalcSpatialMomentumInWorldAboutPoint(context, np.zeros(3))
        linear.append(found.translational())
        angular.append(found.rotational())
    mass = plant.CalcTotalMass(context)
    return MomentumTrajectory(mass, np.array(com), np.array(linear), np.array(angular))


@pytest.mark.parametrize("height", [0.0, 0.3])
def test_multibody_zmp_is_where_the_ground_s_moment_is_vertical(height: float) -> None:
    """Against inverse dynamics: what the first slide's base must bear, moved to p."""
    plant = robot()
    context = plant.CreateDefaultContext()
    instance = plant.GetModelInstanceByName("robot")
    q, v, vdot = swing()
    trajectory = momentum_along(plant, q, v)
    zmp = multibody_zmp(trajectory, height, T)
    for tick in range(50, 750, 100):
        plant.SetPositions(context, q[tick])
        plant.SetVelocities(context, v[tick])
        force, moment = np.zeros(3), np.zeros(3)
        # Newton and Euler of each body by themselves.
        for index in plant.GetBodyIndices(instance):
            body = plant.get_body(index)
            X = plant.EvalBodyPoseInWorld(context, body)
            mass = body.default_mass()
            p_com = X.multiply(body.CalcCenterOfMassInBodyFrame(context))
            velocity = plant.EvalBodySpatialVelocityInWorld(context, body)
            acceleration = plant.CalcSpatialAccelerationsFromVdot(context, vdot[tick])[
                int(index)
            ]
            w, alpha = velocity.rotational(), acceleration.rotational()
            lever = p_com - X.translation()
            a_com = (
                acceleration.translational()
                + np.cross(alpha, lever)
                + np.cross(w, np.cross(w, lever))
            )
            R = X.rotation().matrix()
            central = (
                body.CalcSpatialInertiaInBodyFrame(context)
                .Shift(body.CalcCenterOfMassInBodyFrame(context))
                .CalcRotationalInertia()
                .CopyToFullMatrix3()
            )
            inertia_W = R @ central @ R.T
            f = mass * (a_com + np.array([0.0, 0.0, GRAVITY]))
            force += f
            moment += inertia_W @ alpha + np.cross(w, inertia_W @ w)
            moment += np.cross(p_com, f)
        p = np.array([*zmp[tick], height])
        about_zmp = moment - np.cross(p, force)
        np.testing.assert_allclose(about_zmp[:2] / force[2], 0.0, atol=2e-5)
    assert np.ptp(zmp, axis=0).min() > 0.05


def test_a_single_mass_has_the_cart_s_zmp() -> None:
    """Eq. 20 reduces to Eq. 14, with a height that varies."""
    rng = np.random.default_rng(0)
    com, acceleration = rng.normal(size=(20, 3)), rng.normal(size=(20, 3))
    mass, height = 40.0, 0.1
    zmp = zmp_of_rates(
        mass, com, mass * acceleration, mass * np.cross(com, acceleration), height
    )
    c = (com[:, 2] - height) / (GRAVITY + acceleration[:, 2])
    np.testing.assert_allclose(zmp, com[:, :2] - c[:, None] * acceleration[:, :2])


def disturbance() -> np.ndarray:
    """What legs that the cart does not know add to the ZMP, m."""
    window = np.clip((TIMES - 3.3) / 0.2, 0, 1) * np.clip((4.6 - TIMES) / 0.2, 0, 1)
    return np.column_stack(
        [0.03 * np.sin(9.0 * TIMES) * window, 0.02 * np.cos(7.0 * TIMES) * window]
    )


def test_the_second_stage_takes_the_error_away() -> None:
    """With a disturbance that does not depend on the CoM one pass is enough."""
    reference = np.zeros((1200, 2))
    reference[720:] = 0.2, 0.05
    motion = generate(GAINS, reference)
    away = np.abs(TIMES - 3.6) > 0.1
    before = np.abs(motion.zmp + disturbance() - reference)[away].max()
    filtered = filter_motion(motion, reference, motion.zmp + disturbance(), GAINS)
    after = np.abs(filtered.zmp + disturbance() - reference)[away].max()
    assert before > 0.025
    assert after < 0.1 * before
    np.testing.assert_allclose(filtered.com[0], motion.com[0], atol=1e-12)
    recomputed = filtered.com - PARAMS.com_height / GRAVITY * filtered.acceleration
    np.testing.assert_allclose(filtered.zmp, recomputed, atol=1e-12)


def test_the_second_stage_with_varying_height() -> None:
    """The same on the tracking of a climb."""
    reference = np.zeros((1200, 2))
    reference[720:] = 0.2, 0.05
    c = 0.083 + 0.01 * np.sin(TIMES)
    motion = generate_varying_height(reference, c, PARAMS)
    filtered = filter_motion_varying_height(
        motion, reference, motion.zmp + disturbance(), c, PARAMS
    )
    error = np.abs(filtered.zmp + disturbance() - reference)
    assert error[np.abs(TIMES - 3.6) > 0.1].max() < 2e-3
    np.testing.assert_allclose(filtered.com[0], motion.com[0], atol=1e-9)
    np.testing.assert_allclose(filtered.velocity[-1], 0.0, atol=1e-9)
