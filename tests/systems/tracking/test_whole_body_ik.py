"""The IK's velocities: against finite differences, an independent QP, and limits."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
from pydrake.solvers import ClarabelSolver, MathematicalProgram

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.tracking.whole_body_ik import (
    IkParams,
    IkTarget,
    WholeBodyIk,
    default_posture,
    integrate,
    rotation_error,
    spin_of,
)

STEP = 1e-6
MOVING = {
    "com_velocity": np.array([0.05, -0.03, 0.04]),
    "waist_rate": np.array([0.1, -0.05, 0.08]),
}


def poses(standing, q: Vector) -> dict[str, RigidTransform]:
    """World poses of both soles and the pelvis; the CoM as a pose without rotation."""
    plant, context = standing.plant, standing.context(q)
    X_AF = RigidTransform(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
    result = {
        foot: plant.EvalBodyPoseInWorld(
            context, plant.GetBodyByName(JVRC1.foot_bodies[foot])
        ).multiply(X_AF)
        for foot in FEET
    }
    pelvis = plant.GetBodyByName(JVRC1.base_body)
    result["pelvis"] = plant.EvalBodyPoseInWorld(context, pelvis)
    com = plant.CalcCenterOfMassPositionInWorld(context)
    return result | {"com": RigidTransform(com)}


def rates(standing, v: Vector) -> dict[str, Vector]:
    """Spin and velocity of each of `poses` at v, (6,), by central differences."""
    plant, context = standing.plant, standing.context()
    qdot = plant.MapVelocityToQDot(context, v)
    ends = []
    for sign in (-1.0, 1.0):
        q = standing.q + sign * STEP * qdot
        q[:4] /= np.linalg.norm(q[:4])
        ends.append(poses(standing, q))
    result = {}
    for name, before in ends[0].items():
        after = ends[1][name]
        turn = after.rotation().multiply(before.rotation().inverse()).ToAngleAxis()
        moved = after.translation() - before.translation()
        result[name] = np.concatenate([turn.angle() * turn.axis(), moved]) / (2 * STEP)
    return result


def wanted_sole(rpy_rate: Vector, rate: Vector, rpy: Vector) -> Vector:
    """Spin and velocity of a frame at rpy, by differences of its rotation matrix."""
    R = [
        RollPitchYaw(rpy + sign * STEP * rpy_rate).ToRotationMatrix()
        for sign in (-1.0, 1.0)
    ]
    turn = R[1].multiply(R[0].inverse()).ToAngleAxis()
    return np.concatenate([turn.angle() * turn.axis() / (2.0 * STEP), rate])


def solve(standing, target: IkTarget, q: Vector | None = None, **params) -> Vector:
    """The IK's velocity; the feet must be held."""
    ik = WholeBodyIk(standing.plant, JVRC1, IkParams(**params))
    v, held = ik.solve(standing.context(q), target)
    assert held
    return v


def test_the_robot_rests_on_its_target(standing) -> None:
    """`solve_posture` brings CoM, feet and pelvis there from the default posture."""
    at = poses(standing, standing.q)
    for foot, pose in zip(FEET, standing.target.foot_poses, strict=True):
        want = RigidTransform(RollPitchYaw(pose[3:]), pose[:3])
        assert at[foot].IsNearlyEqualTo(want, 1e-6)
    np.testing.assert_allclose(
        at["com"].translation()[:2], standing.target.com[:2], atol=1e-3
    )
    assert at["com"].translation()[2] == pytest.approx(0.93, abs=2e-3)
    rpy = RollPitchYaw(at["pelvis"].rotation()).vector()
    np.testing.assert_allclose(rpy, standing.target.waist, atol=0.01)
    v = solve(standing, standing.target)
    assert np.abs(v).max() < 0.02


def test_held_feet_stay_while_com_and_waist_move(standing) -> None:
    """By finite differences: the feet exactly, the rest to what the weights allow."""
    target = replace(standing.target, **MOVING)
    moved = rates(standing, solve(standing, target))
    for foot in FEET:
        np.testing.assert_allclose(moved[foot], np.zeros(6), atol=1e-5)
    np.testing.assert_allclose(
        moved["com"][3:], target.com_velocity, rtol=0.02, atol=2e-3
    )
    spin = wanted_sole(target.waist_rate, np.zeros(3), target.waist)[:3]
    np.testing.assert_allclose(moved["pelvis"][:3], spin, atol=0.02)


@pytest.mark.parametrize("swing", [0, 1])
def test_the_free_foot_follows_its_rates(standing, swing: int) -> None:
    """Translation and all three angles, while the other is held."""
    rate = np.array([0.2, -0.05, 0.1, 0.1, 0.4, -0.2])
    stance = np.ones(2)
    stance[swing] = 0.0
    foot_rates = np.zeros((2, 6))
    foot_rates[swing] = rate
    target = replace(
        standing.target, stance=stance, foot_rates=foot_rates, com_velocity=np.zeros(3)
    )
    moved = rates(standing, solve(standing, target))
    rpy = target.foot_poses[swing, 3:]
    np.testing.assert_allclose(
        moved[FEET[swing]], wanted_sole(rate[3:], rate[:3], rpy), atol=0.01
    )
    np.testing.assert_allclose(moved[FEET[1 - swing]], np.zeros(6), atol=1e-5)


def test_errors_decay_at_the_gain(standing) -> None:
    """Position and rotation of a held foot, and the CoM's position."""
    offset = np.array([1e-3, -2e-3, 1.5e-3])
    feet = standing.target.foot_poses.copy()
    feet[0, :3] += offset
    turn = np.array([0.004, -0.003, 0.005])
    R = RotationMatrix(RollPitchYaw(feet[0, 3:]))
    R_new = RollPitchYaw(turn).ToRotationMatrix().multiply(R)
    feet[0, 3:] = RollPitchYaw(R_new).vector()
    moved = rates(standing, solve(standing, replace(standing.target, foot_poses=feet)))
    np.testing.assert_allclose(moved["left"][3:], 20.0 * offset, atol=1e-4)
    np.testing.assert_allclose(moved["left"][:3], 20.0 * turn, atol=1e-3)
    com = replace(standing.target, com=standing.target.com + 0.01)
    base = rates(standing, solve(standing, standing.target))["com"][3:]
    moved = rates(standing, solve(standing, com))
    np.testing.assert_allclose(moved["com"][3:] - base, 0.2, rtol=0.03)


def test_rotation_error_turns_the_frame_home() -> None:
    """R_WD = exp([e]) R_WB, also for turns that are not small."""
    rng = np.random.default_rng(3)
    for _ in range(5):
        wanted, present = rng.uniform(-1.0, 1.0, (2, 3))
        R_WB = RollPitchYaw(present).ToRotationMatrix()
        error = rotation_error(wanted, R_WB)
        angle = float(np.linalg.norm(error))
        K = np.cross(np.eye(3), error / angle)
        turn = np.eye(3) + np.sin(angle) * K + (1.0 - np.cos(angle)) * K @ K
        np.testing.assert_allclose(
            turn @ R_WB.matrix(),
            RollPitchYaw(wanted).ToRotationMatrix().matrix(),
            atol=1e-9,
        )


def test_spin_is_the_rate_of_roll_pitch_yaw() -> None:
    """In W, by differences of the rotation matrix."""
    rpy, rate = np.array([0.3, -0.5, 1.2]), np.array([0.4, 0.7, -0.9])
    want = wanted_sole(rate, np.zeros(3), rpy)[:3]
    np.testing.assert_allclose(spin_of(rpy, rate), want, atol=1e-8)


@pytest.mark.parametrize("stance", [(1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)])
def test_an_independent_qp_finds_the_same_velocity(standing, stance) -> None:
    """Jacobians by differences, the objective as sums of squares, another solver."""
    params = IkParams()
    target = replace(
        standing.target,
        **MOVING,
        com=standing.target.com + np.array([0.004, -0.003, 0.002]),
        waist=standing.target.waist + np.array([0.01, -0.02, 0.03]),
        foot_rates=np.array([[0.1, 0.0, 0.2, 0, 0.1, 0], [0, 0.1, -0.1, 0.2, 0, 0.1]])
        * (1.0 - np.array(stance))[:, None],
        stance=np.array(stance),
    )
    nv = standing.plant.num_velocities()
    columns = [rates(standing, basis) for basis in np.eye(nv)]
    J = {name: np.array([column[name] for column in columns]).T for name in columns[0]}
    at = poses(standing, standing.q)
    program = MathematicalProgram()
    v = program.NewContinuousVariables(nv)

    def track(J: Vector, rate: Vector, weights: Vector | list[float]) -> None:
        root = np.sqrt(np.array(weights))[:, None]
        program.Add2NormSquaredCost(root * J, root[:, 0] * rate, v)

    com_rate = target.com_velocity + params.gain * (
        target.com - at["com"].translation()
    )
    track(
        J["com"][3:],
        com_rate,
        [params.com_weight, params.com_weight, params.height_weight],
    )
    waist_rate = wanted_sole(target.waist_rate, np.zeros(3), target.waist)[:3]
    waist_rate = waist_rate + 0.5 * params.gain * rotation_error(
        target.waist, at["pelvis"].rotation()
    )
    track(
        J["pelvis"][:3],
        waist_rate,
        [params.waist_weight, params.waist_weight, params.waist_yaw_weight],
    )
    for i, foot in enumerate(FEET):
        pose, rate = target.foot_poses[i], target.foot_rates[i]
        wanted = wanted_sole(rate[3:], rate[:3], pose[3:])
        wanted[:3] += params.gain * rotation_error(pose[3:], at[foot].rotation())
        wanted[3:] += params.gain * (pose[:3] - at[foot].translation())
        if stance[i]:
            program.AddLinearEqualityConstraint(J[foot], wanted, v)
        else:
            track(J[foot], wanted, [params.free_weight] * 6)
    posture = default_posture(standing.plant, JVRC1)
    legs = {name for leg in JVRC1.leg_joints.values() for name in leg}
    for index, name in enumerate(standing.plant.GetVelocityNames(False, False)[6:]):
        row = np.eye(nv)[6 + index : 7 + index]
        weight = params.leg_weight if name in legs else params.posture_weight
        pull = params.posture_gain * (posture[7 + index] - standing.q[7 + index])
        track(row, np.array([pull]), [weight])
    track(np.eye(nv), np.zeros(nv), [params.damping] * nv)
    result = ClarabelSolver().Solve(program)
    assert result.is_success()
    np.testing.assert_allclose(
        solve(standing, target), result.GetSolution(v), atol=2e-4
    )


def test_weights_of_the_paper() -> None:
    """Stair paper, Sec. 6.1: CoM 1, free foot 0.2, posture of the upper body 0.001."""
    params = IkParams()
    assert (params.com_weight, params.free_weight) == (1.0, 0.2)
    assert params.posture_weight == 0.001
    assert params.leg_weight < 0.01 * params.posture_weight


def test_speeds_stay_within_their_share_of_the_limits(standing) -> None:
    """However far away the targets are."""
    target = replace(
        standing.target,
        stance=np.array([1.0, 0.0]),
        com=standing.target.com + np.array([0.3, 0.2, -0.3]),
        foot_rates=np.array([np.zeros(6), [20.0, 5.0, 20.0, 0.0, 30.0, 0.0]]),
    )
    v = solve(standing, target, speed_share=0.5)
    share = np.abs(v[6:]) / standing.plant.GetVelocityUpperLimits()[6:]
    assert share.max() == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize(
    ("joint", "least", "most"),
    [("L_KNEE", 0.2, 2.4), ("R_KNEE", 0.2, 2.4)],
)
def test_working_range_is_kept(standing, joint: str, least: float, most: float) -> None:
    """A CoM that is sent up stretches no knee beyond it; one sent down bends none."""
    assert JVRC1.working_range[joint] == (least, most)
    row = standing.plant.GetJointByName(joint).position_start()
    for height, bound in ((1.6, least), (0.3, most)):
        target = replace(
            standing.target, com=np.array([0.55, -0.28, height]), waist=np.zeros(3)
        )
        ik = WholeBodyIk(standing.plant, JVRC1, IkParams())
        context, q = standing.context(), standing.q
        reached = []
        for _ in range(150):
            standing.plant.SetPositions(context, q)
            v, _ = ik.solve(context, target)
            q = integrate(standing.plant, context, v, 0.02)
            reached.append(q[row])
        assert least - 1e-6 <= min(reached)
        assert max(reached) <= most + 1e-6
        if bound == least:
            assert min(reached) < least + 0.3


def test_every_joint_keeps_off_its_limits(standing) -> None:
    """First order: the speed towards a limit is at most K times the distance."""
    plant, params = standing.plant, IkParams()
    upper = plant.GetPositionUpperLimits()[7:] - params.position_margin
    q = standing.q.copy()
    arm = plant.GetJointByName("L_ELBOW_P").position_start()
    lower = plant.GetPositionLowerLimits()[arm] + params.position_margin
    q[arm] = lower + 0.001
    ik = WholeBodyIk(plant, JVRC1, IkParams(posture_gain=1000.0))
    ik.posture[arm] = lower - 1.0
    v, held = ik.solve(standing.context(q), standing.target)
    assert held
    assert v[arm - 1] == pytest.approx(-params.gain * 0.001, abs=1e-6)
    ik.posture[7:] = 100.0
    v, held = ik.solve(standing.context(q), standing.target)
    assert held
    assert (v[6:] <= params.gain * (upper - q[7:]) + 1e-6).all()


def test_a_joint_beyond_its_limit_comes_back(standing) -> None:
    """No faster than it may go."""
    plant, params = standing.plant, IkParams()
    q = standing.q.copy()
    for name, sign in (("L_ELBOW_P", 1.0), ("R_WRIST_R", -1.0)):
        row = plant.GetJointByName(name).position_start()
        limits = plant.GetPositionUpperLimits(), plant.GetPositionLowerLimits()
        q[row] = limits[0 if sign > 0.0 else 1][row] + sign * 0.5
        v, held = WholeBodyIk(plant, JVRC1, params).solve(
            standing.context(q), standing.target
        )
        assert held
        speed = params.speed_share * plant.GetVelocityUpperLimits()[row - 1]
        assert v[row - 1] == pytest.approx(-sign * speed)


def test_feet_that_cannot_be_held_are_told(standing) -> None:
    """Pulled apart beyond the speeds of the legs; the answer respects those."""
    feet = standing.target.foot_poses.copy()
    feet[0, 0] += 5.0
    ik = WholeBodyIk(standing.plant, JVRC1, IkParams())
    v, held = ik.solve(standing.context(), replace(standing.target, foot_poses=feet))
    assert not held
    limits = standing.plant.GetVelocityUpperLimits()[6:]
    assert (np.abs(v[6:]) <= 0.9 * limits + 1e-6).all()
    assert rates(standing, v)["left"][3] > 1.0


def test_default_posture_is_the_robot_s(standing) -> None:
    """Base upright, named joints at their angles, the rest at zero."""
    q = default_posture(standing.plant, JVRC1)
    assert q[0] == 1.0
    names = standing.plant.GetPositionNames(False, False)
    angles = {
        name.removesuffix("_q"): angle
        for name, angle in zip(names[7:], q[7:], strict=True)
        if angle
    }
    assert angles == {name: angle for name, angle in JVRC1.posture.items() if angle}


def test_integrate_follows_the_velocity(standing) -> None:
    """Joints by v dt; the quaternion stays a unit one and turns with the spin."""
    plant, context = standing.plant, standing.context()
    v = np.random.default_rng(1).uniform(-1.0, 1.0, plant.num_velocities())
    q = integrate(plant, context, v, 0.005)
    np.testing.assert_allclose(q[7:], standing.q[7:] + 0.005 * v[6:], atol=1e-12)
    np.testing.assert_allclose(q[4:7], standing.q[4:7] + 0.005 * v[3:6], atol=1e-12)
    assert np.linalg.norm(q[:4]) == pytest.approx(1.0, abs=1e-15)
    turn = poses(standing, q)["pelvis"].rotation()
    turn = turn.multiply(poses(standing, standing.q)["pelvis"].rotation().inverse())
    spin = turn.ToAngleAxis().angle() * turn.ToAngleAxis().axis() / 0.005
    np.testing.assert_allclose(spin, v[:3], atol=1e-4)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("period", 0.0),
        ("com_weight", -1.0),
        ("gain", np.inf),
        ("free_weight", -0.1),
        ("position_margin", np.nan),
        ("speed_share", 1.1),
        ("speed_share", 0.0),
    ],
)
def test_parameters_out_of_range_are_refused(standing, field: str, value) -> None:
    """By name, when the IK is made."""
    with pytest.raises(ValueError, match=f"^{field}: .*{value:g}"):
        WholeBodyIk(standing.plant, JVRC1, IkParams(**{field: value}))
