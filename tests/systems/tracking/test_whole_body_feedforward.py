"""Feed-forward torques: static equilibrium, free fall, and the power they do."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.tree import JacobianWrtVariable
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.tracking.whole_body_feedforward import (
    WholeBodyFeedforward,
    momentum_rate,
    needed_forces,
)

WEIGHT = 62.4 * 9.81


def make(
    standing,
    q: Vector,
    v: Vector | None = None,
    vdot: Vector | None = None,
    wrenches: Vector | None = None,
    largest: float = 1e3,
) -> tuple[WholeBodyFeedforward, Context]:
    """The system on fixed inputs; what is not given is zero."""
    system = WholeBodyFeedforward(standing.plant, JVRC1, largest)
    context = system.CreateDefaultContext()
    nothing = np.zeros(standing.plant.num_velocities())
    for name, value in (
        ("positions", q),
        ("velocities", nothing if v is None else v),
        ("accelerations", nothing if vdot is None else vdot),
        ("foot_wrenches", np.zeros(12) if wrenches is None else wrenches),
    ):
        system.GetInputPort(name).FixValue(context, value)
    return system, context


def torques(standing, q: Vector, **inputs) -> dict[str, float]:
    """The torque of every joint by name."""
    system, context = make(standing, q, **inputs)
    plant = standing.plant
    names = [
        plant.get_joint_actuator(index).joint().name()
        for index in plant.GetJointActuatorIndices()
    ]
    values = eval_vector(system.GetOutputPort("torque"), context)
    return dict(zip(names, values, strict=True))


def random_motion(standing, seed: int) -> tuple[Vector, Vector, Vector]:
    """Positions near standing, velocities and accelerations."""
    rng = np.random.default_rng(seed)
    nv = standing.plant.num_velocities()
    q = standing.q.copy()
    q[7:] += rng.uniform(-0.2, 0.2, nv - 6)
    return q, rng.uniform(-1.0, 1.0, nv), rng.uniform(-3.0, 3.0, nv)


@pytest.mark.parametrize("joint", ["L_KNEE", "L_HIP_P", "R_ANKLE_P", "R_ANKLE_R"])
def test_standing_torques_balance_what_hangs_below(standing, joint: str) -> None:
    """Moments about the joint's axis: the foot's force and the leg's weight below it.

    Counted by hand from the foot up: no Jacobian, no inverse dynamics.
    """
    plant, at = standing.plant, standing.context()
    share = {"left": 0.6, "right": 0.4}
    wrenches = np.zeros((2, 6))
    for i, foot in enumerate(FEET):
        wrenches[i] = [15.0, -10.0, share[foot] * WEIGHT, 4.0, 9.0, -2.0]
    item = plant.GetJointByName(joint)
    foot = "left" if joint.startswith("L") else "right"
    X_WM = item.frame_on_child().CalcPoseInWorld(at)
    axis = X_WM.rotation().multiply(item.revolute_axis())
    X_WA = plant.EvalBodyPoseInWorld(at, plant.GetBodyByName(JVRC1.foot_bodies[foot]))
    p_WF = X_WA.multiply(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
    wrench = wrenches[FEET.index(foot)]
    moment = wrench[3:] + np.cross(p_WF - X_WM.translation(), wrench[:3])
    leg = JVRC1.leg_joints[foot]
    for name in leg[leg.index(joint) :]:
        body = plant.GetJointByName(name).child_body()
        p_WBcm = plant.EvalBodyPoseInWorld(at, body).multiply(body.default_com())
        gravity = np.array([0.0, 0.0, -9.81 * body.default_mass()])
        moment += np.cross(p_WBcm - X_WM.translation(), gravity)
    torque = torques(standing, standing.q, wrenches=wrenches.ravel())[joint]
    assert torque == pytest.approx(-axis @ moment, abs=1e-6)
    assert abs(torque) > 1.0


def test_free_fall_needs_no_torque(standing) -> None:
    """A robot that falls stiffly, its parts at rest to each other."""
    vdot = np.zeros(standing.plant.num_velocities())
    vdot[5] = -9.81
    found = torques(standing, standing.q, vdot=vdot)
    assert max(map(abs, found.values())) < 1e-9


def test_upper_body_hangs_from_its_joints(standing) -> None:
    """Whatever the feet feel: arms and neck bear their own weight."""
    wrenches = np.random.default_rng(2).uniform(-50.0, 50.0, 12)
    unloaded = torques(standing, standing.q)
    loaded = torques(standing, standing.q, wrenches=wrenches)
    legs = {name for leg in JVRC1.leg_joints.values() for name in leg}
    for name, torque in unloaded.items():
        assert (loaded[name] == pytest.approx(torque, abs=1e-9)) == (name not in legs)


def test_power_is_the_rate_of_energy(standing) -> None:
    """Torques and foot wrenches do the work that the motion gains, for any motion.

    The base's equations are left to the wrenches, so the wrenches are chosen to meet
    them; then sum(tau v) + sum(w V) is the rate of kinetic plus potential energy.
    """
    plant = standing.plant
    q, v, vdot = random_motion(standing, 4)
    at = standing.context(q)
    plant.SetVelocities(at, v)
    world = plant.world_frame()
    jacobians = []
    for foot in FEET:
        frame = plant.GetBodyByName(JVRC1.foot_bodies[foot]).body_frame()
        J = plant.CalcJacobianSpatialVelocity(
            at,
            JacobianWrtVariable.kV,
            frame,
            np.array([0.0, 0.0, -JVRC1.sole.ankle_height]),
            world,
            world,
        )
        jacobians.append(np.vstack([J[3:], J[:3]]))
    J = np.vstack(jacobians)
    base = needed_forces(plant, at, vdot)[:6]
    wrenches = np.linalg.lstsq(J[:, :6].T, base, rcond=None)[0]
    # Light enough that no torque is clamped.
    system, context = make(standing, q, v, vdot, wrenches)
    tau = eval_vector(system.GetOutputPort("torque"), context)
    assert np.abs(tau).max() < 99.0
    actuation = plant.MakeActuationMatrix() @ tau
    step, energies = 1e-6, []
    for sign in (-1.0, 1.0):
        moved = standing.context(q)
        shifted = q + sign * step * plant.MapVelocityToQDot(at, v)
        shifted[:4] /= np.linalg.norm(shifted[:4])
        plant.SetPositions(moved, shifted)
        plant.SetVelocities(moved, v + sign * step * vdot)
        energies.append(
            plant.CalcKineticEnergy(moved) + plant.CalcPotentialEnergy(moved)
        )
    rate = (energies[1] - energies[0]) / (2.0 * step)
    # Rotors have inertia of their own, which the plant's kinetic energy knows.
    assert actuation @ v + wrenches @ (J @ v) == pytest.approx(rate, rel=1e-4, abs=0.1)


@pytest.mark.parametrize("seed", range(3))
def test_momentum_rate_is_the_change_of_momentum(standing, seed: int) -> None:
    """About the CoM, by differences of the plant's own momentum; not in free fall."""
    plant = standing.plant
    q, v, vdot = random_motion(standing, seed)
    at = standing.context(q)
    plant.SetVelocities(at, v)
    step, momenta = 1e-6, []
    for sign in (-1.0, 1.0):
        moved = standing.context()
        shifted = q + sign * step * plant.MapVelocityToQDot(at, v)
        shifted[:4] /= np.linalg.norm(shifted[:4])
        plant.SetPositions(moved, shifted)
        plant.SetVelocities(moved, v + sign * step * vdot)
        p_WCom = plant.CalcCenterOfMassPositionInWorld(moved)
        momentum = plant.CalcSpatialMomentumInWorldAboutPoint(moved, p_WCom)
        momenta.append(momentum.rotational())
    want = (momenta[1] - momenta[0]) / (2.0 * step)
    rate = momentum_rate(plant, at, needed_forces(plant, at, vdot))
    np.testing.assert_allclose(rate, want, rtol=1e-4, atol=1e-3)
    system, context = make(standing, q, v, vdot)
    port = system.GetOutputPort("momentum_rate")
    np.testing.assert_allclose(eval_vector(port, context), rate, atol=1e-9)


def test_torques_stay_within_the_effort_limits(standing) -> None:
    """Where the feet would need more."""
    wrenches = np.zeros(12)
    wrenches[2] = 20.0 * WEIGHT
    found = torques(standing, standing.q, wrenches=wrenches)
    assert max(map(abs, found.values())) == 100.0


def test_accelerations_are_clamped(standing) -> None:
    """A jump of the reference velocity is one of a given acceleration at most."""
    vdot = np.zeros(standing.plant.num_velocities())
    row = standing.plant.GetJointByName("L_ELBOW_P").velocity_start()
    vdot[row] = 1e4
    jump = torques(standing, standing.q, vdot=vdot, largest=7.0)
    vdot[row] = 7.0
    assert jump == torques(standing, standing.q, vdot=vdot)
    vdot[row] = -1e4
    fall = torques(standing, standing.q, vdot=vdot, largest=7.0)
    vdot[row] = -7.0
    assert fall == torques(standing, standing.q, vdot=vdot)


def test_a_lifted_heel_is_pushed_at_the_sole_frame(standing) -> None:
    """The wrench's moment is about F, below the ankle along the tilted foot."""
    plant, q = standing.plant, standing.q.copy()
    row = plant.GetJointByName("R_ANKLE_P").position_start()
    q[row] += 0.5
    at = standing.context(q)
    foot = plant.GetBodyByName(JVRC1.foot_bodies["right"])
    X_WA = plant.EvalBodyPoseInWorld(at, foot)
    assert RollPitchYaw(X_WA.rotation()).pitch_angle() > 0.4
    sole = RigidTransform(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
    p_AF_W = X_WA.multiply(sole).translation() - X_WA.translation()
    wrenches = np.zeros(12)
    wrenches[6:9] = [40.0, 5.0, 300.0]
    found = torques(standing, q, wrenches=wrenches)
    rest = torques(standing, q)
    joint = plant.GetJointByName("R_ANKLE_P")
    axis = X_WA.rotation().multiply(joint.revolute_axis())
    moment = axis @ np.cross(p_AF_W, wrenches[6:9])
    assert found["R_ANKLE_P"] - rest["R_ANKLE_P"] == pytest.approx(-moment)


def test_leg_torque_map_gives_the_leg_torques(standing) -> None:
    """Offset minus matrix times wrenches, in the order of the actuators."""
    system = WholeBodyFeedforward(standing.plant, JVRC1, 150.0)
    context = system.CreateDefaultContext()
    nv = standing.plant.num_velocities()
    rng = np.random.default_rng(5)
    wrenches = rng.normal(size=12) * np.tile([5, 5, 50, 2, 2, 2], 2)
    system.GetInputPort("positions").FixValue(context, standing.q)
    system.GetInputPort("velocities").FixValue(context, 0.1 * rng.normal(size=nv))
    system.GetInputPort("accelerations").FixValue(context, rng.normal(size=nv))
    system.GetInputPort("foot_wrenches").FixValue(context, wrenches)
    values = system.GetOutputPort("leg_torque_map").Eval(context)
    legs = {name for leg in JVRC1.leg_joints.values() for name in leg}
    joints = [
        standing.plant.get_joint_actuator(index).joint().name()
        for index in standing.plant.GetJointActuatorIndices()
    ]
    torque = system.GetOutputPort("torque").Eval(context)
    want = [torque[i] for i, name in enumerate(joints) if name in legs]
    found = values[:12] - values[12:].reshape(12, 12) @ wrenches
    np.testing.assert_allclose(found, want, atol=1e-9)
