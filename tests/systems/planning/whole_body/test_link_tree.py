"""CoM and momentum of a lumped robot against its plant."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    Frame,
    PrismaticJoint,
    RevoluteJoint,
    SpatialInertia,
    UnitInertia,
)

from footfall.models.values.vector import Vector
from footfall.systems.planning.whole_body.link_tree import (
    LinkTree,
    com_in_base,
    link_tree,
    momentum,
)
from footfall.systems.planning.whole_body.whole_body_plan import quaternions
from tests.systems.planning.crossing.crossing_cases import body

N = 20
POSTURE = {"neck": 0.4, "elbow": 0.2}
MOVING = ("shoulder", "elbow", "second")


def _oblique() -> MultibodyPlant:
    """An arm, a neck and a head that wears a hat; every axis and frame is oblique."""
    plant = MultibodyPlant(0.0)
    rng = np.random.default_rng(5)

    def pose() -> RigidTransform:
        rpy = RollPitchYaw(rng.uniform(-1.0, 1.0, 3))
        return RigidTransform(rpy, rng.uniform(-0.3, 0.3, 3))

    def offset(name: str, on: str) -> Frame:
        frame = plant.GetBodyByName(on).body_frame()
        return plant.AddFrame(FixedOffsetFrame(name, frame, pose()))

    for i, name in enumerate(("base", "upper", "lower", "other", "head", "hat")):
        mass = 1.0 + i
        size = UnitInertia.SolidBox(0.1, 0.2, 0.3 + 0.1 * i)
        centre: Vector = np.array([0.1, -0.05 * i, 0.2])
        plant.AddRigidBody(
            name, SpatialInertia.MakeFromCentralInertia(mass, centre, mass * size)
        )
    # The elbow before its shoulder: the plant's order need not be the tree's.
    for name, parent, child in (
        ("elbow", "upper", "lower"),
        ("shoulder", "base", "upper"),
        ("neck", "base", "head"),
        ("second", "head", "other"),
    ):
        axis: Vector = rng.normal(size=3)
        F, M = offset(f"{name}_F", parent), offset(f"{name}_M", child)
        plant.AddJoint(RevoluteJoint(name, F, M, axis / np.linalg.norm(axis)))
    plant.WeldFrames(plant.GetFrameByName("head"), plant.GetFrameByName("hat"), pose())
    plant.Finalize()
    return plant


def _jvrc1() -> tuple[MultibodyPlant, str, LinkTree]:
    return body().plant, body().robot.base_body, body().tree


def _made() -> tuple[MultibodyPlant, str, LinkTree]:
    plant = _oblique()
    return plant, "base", link_tree(plant, "base", MOVING, POSTURE)


def _motion(plant: MultibodyPlant, tree: LinkTree) -> tuple[Vector, Vector]:
    """Random positions and velocities of what moves in the tree."""
    rng = np.random.default_rng(2)
    q = np.tile(tree.posture, (N, 1))
    q[:, :4] = quaternions(rng.uniform(-1.5, 1.5, (N, 3)))
    q[:, 4:7] = rng.uniform(-1.0, 1.0, (N, 3))
    q[:, tree.columns] = rng.uniform(-2.0, 2.0, (N, len(tree.columns)))
    v: Vector = np.zeros((N, plant.num_velocities()))
    v[:, :6] = rng.normal(size=(N, 6))
    v[:, tree.speeds] = rng.normal(size=(N, len(tree.speeds)))
    return q, v


@pytest.mark.parametrize("robot", [_jvrc1, _made])
def test_com_and_momentum_are_those_of_the_plant(robot) -> None:
    """Random postures, orientations and velocities."""
    plant, base, tree = robot()
    context = plant.CreateDefaultContext()
    q, v = _motion(plant, tree)
    moved = momentum(tree, q, v)
    p_BCom = com_in_base(tree, q[:, tree.columns])
    origin: Vector = np.zeros(3)
    assert moved.mass == pytest.approx(plant.CalcTotalMass(context))
    for row in range(N):
        plant.SetPositions(context, q[row])
        plant.SetVelocities(context, v[row])
        p_WCom = plant.CalcCenterOfMassPositionInWorld(context)
        X_WB = plant.GetBodyByName(base).EvalPoseInWorld(context)
        want = plant.CalcSpatialMomentumInWorldAboutPoint(context, origin)
        np.testing.assert_allclose(X_WB.multiply(p_BCom[row]), p_WCom, atol=1e-9)
        np.testing.assert_allclose(moved.com[row], p_WCom, atol=1e-9)
        np.testing.assert_allclose(moved.linear[row], want.translational(), atol=1e-9)
        np.testing.assert_allclose(moved.angular[row], want.rotational(), atol=1e-9)


def test_joints_that_are_frozen_must_not_move() -> None:
    """Their motion would be left out."""
    plant, _, tree = _made()
    q, v = _motion(plant, tree)
    q[3, plant.GetJointByName("neck").position_start()] += 0.1
    with pytest.raises(ValueError, match="q: joints that are frozen"):
        momentum(tree, q, v)


def test_joints_come_after_their_parents() -> None:
    """The tree is gone through from its end."""
    with pytest.raises(ValueError, match="elbow: must come after its parent"):
        link_tree(_oblique(), "base", ("elbow", "shoulder"), POSTURE)


def test_joints_that_move_turn() -> None:
    """A slide has no angle."""
    plant = MultibodyPlant(0.0)
    inertia = SpatialInertia.SolidBoxWithMass(1.0, 0.1, 0.1, 0.1)
    base, cart = (plant.AddRigidBody(name, inertia) for name in ("base", "cart"))
    x: Vector = np.array([1.0, 0.0, 0.0])
    plant.AddJoint(PrismaticJoint("slide", base.body_frame(), cart.body_frame(), x))
    plant.Finalize()
    with pytest.raises(ValueError, match="slide: must be revolute, got prismatic"):
        link_tree(plant, "base", ("slide",), {})
