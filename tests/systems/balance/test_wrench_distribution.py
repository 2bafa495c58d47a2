"""Sharing a wrench among the feet: exact where it can be, inside the cones always."""

from itertools import product

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.solvers import ClarabelSolver, MathematicalProgram
from scipy.optimize import linprog

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import contact_wrench_cone
from footfall.systems.balance.wrench_distribution import (
    DistributionParams,
    TorqueMap,
    distribute_wrench,
)

SOLE = JVRC1.sole
LEVEL = np.array([[0.0, 0.1, 0, 0, 0, 0], [0.05, -0.1, 0, 0, 0, 0]])
STAIRS = np.array([[0.0, 0.1, 0.0, 0, 0, 0.1], [0.3, -0.1, 0.2, 0, 0, -0.1]])
TOE_OFF = np.array([[0.0, 0.1, 0.1, 0, 0.5, 0.0], [0.35, -0.1, 0.2, 0, 0, 0.0]])
FLAT = np.array([SOLE.length, SOLE.length])
STRIP = np.array([0.01, SOLE.length])
WEIGHT = 62.4 * 9.81
COM = np.array([0.08, 0.0, 0.85])


def distribute(
    net: Vector,
    poses: Vector = LEVEL,
    contacts: tuple[float, float] = (1.0, 1.0),
    lengths: Vector = FLAT,
    com: Vector = COM,
    **params: float,
) -> Vector:
    """The wrenches; the programme must be solved."""
    wrenches, solved = distribute_wrench(
        net, com, poses, np.array(contacts), lengths, SOLE, DistributionParams(**params)
    )
    assert solved
    return wrenches


def net_of(wrenches: Vector, poses: Vector, com: Vector = COM) -> Vector:
    """Force, then moment about the CoM, (6,)."""
    net = np.zeros(6)
    for wrench, pose in zip(wrenches, poses, strict=True):
        net[:3] += wrench[:3]
        net[3:] += wrench[3:] + np.cross(pose[:3] - com, wrench[:3])
    return net


def ground(pose: Vector, length: float) -> tuple[Vector, Vector]:
    """R_WC of the ground under the part of a sole that carries, and its centre from F.

    The ground under lifted toes is level: the sole is tilted there, not its friction.
    """
    R_WF = RollPitchYaw(pose[3:]).ToRotationMatrix().matrix()
    if length == SOLE.length:
        return R_WF, R_WF @ [SOLE.toe - 0.5 * length, 0.0, 0.0]
    R_WC = RollPitchYaw(0.0, 0.0, pose[5]).ToRotationMatrix().matrix()
    return R_WC, R_WF @ [SOLE.toe, 0.0, 0.0] - R_WC @ [0.5 * length, 0.0, 0.0]


def corner_forces_exist(
    wrench: Vector, pose: Vector, length: float, friction: float
) -> bool:
    """Whether forces at the carrying part's corners, in pyramids, make the wrench.

    Another way to say what the contact wrench cone says, by linear programming.
    """
    R, p_FC_W = ground(pose, length)
    columns = []
    for x, y in product((-0.5 * length, 0.5 * length), (-1.0, 1.0)):
        p_W = p_FC_W + R @ [x, y * SOLE.half_width, 0.0]
        for fx, fy in product((-friction, friction), repeat=2):
            force = R @ [fx, fy, 1.0]
            columns.append(np.concatenate([force, np.cross(p_W, force)]))
    A = np.array(columns).T
    return bool(linprog(np.zeros(16), A_eq=A, b_eq=wrench).status == 0)


@pytest.mark.parametrize("poses", [LEVEL, STAIRS], ids=["level", "stairs"])
def test_a_wrench_within_reach_is_met(poses: Vector) -> None:
    """Weight, a sideways force and moments, on level ground and on stairs."""
    com = COM + np.array([0.5 * poses[1, 0] - 0.025, 0.0, poses[1, 2]])
    net = np.array([20.0, -15.0, WEIGHT, 2.0, -3.0, 1.0])
    wrenches = distribute(net, poses, com=com)
    np.testing.assert_allclose(net_of(wrenches, poses, com), net, atol=0.2)


def test_symmetric_stance_shares_equally() -> None:
    """CoM over the middle of the soles between the feet."""
    poses = np.array([[0.0, 0.1, 0, 0, 0, 0], [0.0, -0.1, 0, 0, 0, 0]])
    com = np.array([0.0375, 0.0, 0.85])
    net = np.array([0, 0, WEIGHT, 0, 0, 0])
    left, right = distribute(net, poses, com=com)
    np.testing.assert_allclose(left[:3], [0.0, 0.0, 0.5 * WEIGHT], atol=0.1)
    np.testing.assert_allclose(left * [1, -1, 1, -1, 1, -1], right, atol=0.05)


@pytest.mark.parametrize("seed", range(12))
def test_every_foot_stays_within_its_cone(seed: int) -> None:
    """Also for wrenches out of reach: corner forces within friction exist."""
    rng = np.random.default_rng(seed)
    poses, lengths = [(LEVEL, FLAT), (STAIRS, FLAT), (TOE_OFF, STRIP)][seed % 3]
    net = np.array([0, 0, WEIGHT, 0, 0, 0]) + rng.uniform(-1, 1, 6) * [
        *(400, 400, 300),
        *(100, 100, 60),
    ]
    com = COM + rng.uniform(-0.2, 0.2, 3)
    wrenches = distribute(net, poses, lengths=lengths, com=com)
    for wrench, pose, length in zip(wrenches, poses, lengths, strict=True):
        assert corner_forces_exist(wrench, pose, length, 0.6 + 1e-6)
        assert wrench[2] >= 5.0 - 1e-6


def test_sideways_force_beyond_friction_is_given_up() -> None:
    """The weight is still carried."""
    force = np.array([1.5 * WEIGHT, 0.0, WEIGHT])
    moment = np.cross([0.06, 0.0, 0.0] - COM, force)
    wrenches = distribute(np.concatenate([force, moment]), moment_weight=0.01)
    total = net_of(wrenches, LEVEL)
    assert total[0] == pytest.approx(0.6 * total[2], rel=1e-3)
    assert total[2] > 0.9 * WEIGHT


def test_an_independent_solver_finds_the_same() -> None:
    """The objective as sums of squares of world wrenches, solved by Clarabel."""
    params = DistributionParams()
    net = np.array([250.0, -100.0, 1.1 * WEIGHT, 60.0, -40.0, 20.0])
    program = MathematicalProgram()
    w = program.NewContinuousVariables(12)
    grasp = np.zeros((6, 12))
    for i, (pose, length) in enumerate(zip(TOE_OFF, STRIP, strict=True)):
        R, p_FC_W = ground(pose, length)
        # From the wrench about F in W to the one about the strip's centre in C.
        to_centre = np.zeros((6, 6))
        to_centre[:3, :3] = to_centre[3:, 3:] = R.T
        to_centre[3:, :3] = -R.T @ cross_matrix(p_FC_W)
        A = contact_wrench_cone(
            max(0.5 * length - params.edge_margin, 0.25 * length),
            SOLE.half_width - params.edge_margin,
            0.6,
        )
        block = w[6 * i : 6 * i + 6]
        program.AddLinearConstraint(
            A @ to_centre, np.full(16, -np.inf), np.zeros(16), block
        )
        program.AddLinearConstraint(to_centre[2:3], [5.0], [np.inf], block)
        costs = [1e-4, 1e-4, 0.0, *params.moment_cost]
        root = np.sqrt(costs)[:, None] * to_centre
        program.Add2NormSquaredCost(root, np.zeros(6), block)
        grasp[:, 6 * i : 6 * i + 6] = np.eye(6)
        grasp[3:, 6 * i : 6 * i + 3] = cross_matrix(pose[:3] - COM)
    root = np.sqrt([1.0, 1.0, 1.0, 10.0, 10.0, 3.0])
    program.Add2NormSquaredCost(root[:, None] * grasp, root * net, w)
    result = ClarabelSolver().Solve(program)
    assert result.is_success()
    wrenches = distribute(net, TOE_OFF, lengths=STRIP)
    np.testing.assert_allclose(
        wrenches.ravel(), result.GetSolution(w), rtol=1e-3, atol=0.05
    )


def cross_matrix(p: Vector) -> Vector:
    """[p] with [p] f = p x f."""
    return np.cross(np.eye(3), p)


def test_centre_of_pressure_keeps_off_the_edges() -> None:
    """By the margin, however far outside the ZMP is wanted."""
    for com in ([0.5, 0.0, 0.85], [-0.5, 0.0, 0.85], [0.05, 0.6, 0.85]):
        wrenches = distribute(
            np.array([0, 0, WEIGHT, 0, 0, 0]), com=np.array(com), edge_margin=0.01
        )
        for wrench in wrenches:
            x, y = -wrench[4] / wrench[2], wrench[3] / wrench[2]
            assert -SOLE.heel + 0.01 - 1e-6 <= x <= SOLE.toe - 0.01 + 1e-6
            assert abs(y) <= SOLE.half_width - 0.01 + 1e-6


def test_one_foot_carries_all() -> None:
    """And the one in the air is left alone."""
    com = np.array([0.09, -0.1, 0.85])
    net = np.array([0, 0, WEIGHT, 0, 0, 0])
    wrenches = distribute(net, contacts=(0.0, 1.0), com=com)
    assert not wrenches[0].any()
    np.testing.assert_allclose(net_of(wrenches, LEVEL, com), net, atol=0.2)


def test_a_lifted_heel_carries_at_the_toes_only() -> None:
    """Its centre of pressure on the ground lies within the strip under the toes."""
    com = np.array([0.2, 0.0, 0.95])
    wrenches = distribute(
        np.array([0, 0, WEIGHT, 0, 0, 0]), TOE_OFF, lengths=STRIP, com=com
    )
    force, moment = wrenches[0, :3], wrenches[0, 3:]
    assert force[2] >= 5.0 - 1e-6
    x, _, z = RollPitchYaw(TOE_OFF[0, 3:]).ToRotationMatrix().matrix() @ [
        SOLE.toe,
        0.0,
        0.0,
    ]
    pressure = (z * force[0] - moment[1]) / force[2]
    assert x - 0.01 - 1e-6 <= pressure <= x + 1e-6


def test_unloaded_toes_are_not_made_to_slide() -> None:
    """However steep the sole, its force stays in the level ground's pyramid."""
    for pitch in (0.3, 0.6, 0.85):
        poses = TOE_OFF.copy()
        poses[0, 4] = pitch
        com = np.array([0.38, -0.1, 0.95])
        net = np.array([60.0, 0.0, WEIGHT, 0.0, 0.0, 0.0])
        toes = distribute(net, poses, lengths=STRIP, com=com)[0]
        assert 5.0 - 1e-6 <= toes[2] < 0.4 * WEIGHT
        assert np.abs(toes[:2]).max() <= 0.6 * toes[2] + 1e-6


def test_nobody_on_the_ground_is_no_wrench() -> None:
    """In flight."""
    assert not distribute(np.ones(6), contacts=(0.0, 0.0)).any()


def test_costs_prefer_the_middle_of_the_soles() -> None:
    """Feet one behind the other: the load is shared, not the centres of pressure."""
    poses = np.array([[0.0, 0.1, 0, 0, 0, 0], [0.3, -0.1, 0, 0, 0, 0]])
    com = np.array([0.0375 + 0.1, 0.1 - 0.2 / 3.0, 0.85])
    wrenches = distribute(np.array([0, 0, WEIGHT, 0, 0, 0]), poses, com=com)
    shares = wrenches[:, 2] / WEIGHT
    np.testing.assert_allclose(shares, [2.0 / 3.0, 1.0 / 3.0], atol=0.01)
    np.testing.assert_allclose(-wrenches[:, 4] / wrenches[:, 2], 0.0375, atol=0.01)


def test_joint_torques_are_kept_small_where_the_feet_can_share() -> None:
    """A joint that the left foot's force loads gets the right foot to carry more."""
    net = np.array([0.0, 0.0, WEIGHT, 0.0, 0.0, 0.0])
    matrix = np.zeros((1, 12))
    matrix[0, 2] = 0.2
    torques = TorqueMap(np.array([10.0]), matrix)
    loads = []
    for cost in (0.0, 0.1):
        params = DistributionParams(torque_cost=cost)
        wrenches, _ = distribute_wrench(
            net, COM, STAIRS, np.ones(2), FLAT, SOLE, params, torques
        )
        np.testing.assert_allclose(net_of(wrenches, STAIRS), net, atol=2.0)
        loads.append(wrenches[0, 2])
    assert loads[1] < 0.7 * loads[0]


def test_torques_of_tilted_feet_are_those_of_wrenches_about_their_frames() -> None:
    """What is minimised is offset - matrix w of the wrenches that are returned."""
    rng = np.random.default_rng(4)
    net = np.array([10.0, -5.0, WEIGHT, 4.0, -8.0, 1.0])
    torques = TorqueMap(rng.normal(size=3) * 30.0, rng.normal(size=(3, 12)) * 0.2)
    params = DistributionParams(torque_cost=0.02)

    def cost(w: Vector) -> float:
        tau = torques.offset - torques.matrix @ w
        error = net_of(w.reshape(2, 6), TOE_OFF) - net
        weights = [params.force_weight] * 3 + [params.moment_weight] * 2
        total = error**2 @ [*weights, params.yaw_weight] + 0.02 * tau @ tau
        for wrench, pose, length in zip(
            w.reshape(2, 6), TOE_OFF, (0.01, SOLE.length), strict=True
        ):
            R, p_FC_W = ground(pose, length)
            f = R.T @ wrench[:3]
            m = R.T @ (wrench[3:] - np.cross(p_FC_W, wrench[:3]))
            total += params.tangential_cost * f[:2] @ f[:2]
            total += np.array(params.moment_cost) @ m**2
        return float(total)

    best, _ = distribute_wrench(
        net, COM, TOE_OFF, np.ones(2), STRIP, SOLE, params, torques
    )
    other, _ = distribute_wrench(net, COM, TOE_OFF, np.ones(2), STRIP, SOLE, params)
    for share in (1e-3, 0.1, 1.0):
        between = best + share * (other - best)
        assert cost(best.ravel()) < cost(between.ravel())


def test_poses_may_stand_anywhere() -> None:
    """Turning everything about z turns the answer."""
    X = RigidTransform(RollPitchYaw(0.0, 0.0, 1.1), [3.0, -2.0, 0.0])
    R = X.rotation().matrix()
    net = np.array([20.0, -15.0, WEIGHT, 2.0, -3.0, 1.0])
    turned = LEVEL.copy()
    for pose in turned:
        pose[:3] = X.multiply(pose[:3])
        pose[5] += 1.1
    there = distribute(
        np.concatenate([R @ net[:3], R @ net[3:]]), turned, com=X.multiply(COM)
    )
    here = distribute(net)
    np.testing.assert_allclose(
        there, np.hstack([here[:, :3] @ R.T, here[:, 3:] @ R.T]), atol=0.3
    )


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("friction", 0.0),
        ("force_weight", -1.0),
        ("yaw_weight", np.inf),
        ("edge_margin", -0.001),
        ("min_force", np.nan),
        ("moment_cost", [1.0, 2.0]),
        ("moment_cost", [1.0, -2.0, 3.0]),
    ],
)
def test_parameters_out_of_range_are_refused(field: str, value: object) -> None:
    """By name."""
    with pytest.raises(ValueError, match=rf"^{field}(\[\d\])?: must "):
        DistributionParams(**{field: value}).validate()
