"""CoM and momentum of a whole robot at many postures at once, in closed form.

The plant answers one posture a call; a plan asks for thousands. Joints that a plan
never moves are frozen, and what they join becomes one link: of a humanoid the trunk,
six links of either leg and the two arms are left.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.math import VectorToSkewSymmetric
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex

from footfall.models.values.vector import Vector
from footfall.systems.balance.dynamic_filter import MomentumTrajectory


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid piece L of the robot that turns about one axis in its parent P."""

    parent: int
    """Its parent's place in the tree; -1 for the base."""
    p_PL: Vector
    """Its origin, on its axis, in the parent's frame, (3,), m."""
    axis: Vector
    """Its axis in its own frame, (3,)."""
    turn: Vector
    """(3, 3, 3): R_PL = turn[0] + cos(q) turn[1] + sin(q) turn[2]."""
    mass: float
    """kg."""
    moment: Vector
    """Mass times CoM, in its own frame, (3,), kg m."""
    inertia: Vector
    """About its origin, in its own frame, (3, 3), kg m^2."""


@dataclass(frozen=True, eq=False)
class LinkTree:
    """A robot on a floating base with k joints that move."""

    links: tuple[Link, ...]
    """The base, then what each joint turns, parents before children, (k + 1)."""
    carried: Vector
    """Mass of each link and all that it carries, (k + 1,), kg."""
    columns: Vector
    """Of the joints in the plant's positions, (k,), whole numbers."""
    speeds: Vector
    """Of the joints in the plant's velocities, (k,), whole numbers."""
    posture: Vector
    """Positions of the plant in which all other joints are frozen, (nq,)."""

    @property
    def mass(self) -> float:
        """Of the whole robot, kg."""
        return float(self.carried[0])


def link_tree(
    plant: MultibodyPlant,
    base: str,
    moving: Sequence[str],
    posture: Mapping[str, float],
) -> LinkTree:
    """Reads a robot off its plant.

    Args:
        plant: the robot alone, finalised, floating base first.
        base: the body that floats.
        moving: names of the joints that move, parents before children.
        posture: where the others are frozen, rad; at zero where they are not named.

    Raises:
        ValueError: a joint that moves does not turn, or comes before its parent.
    """
    context = plant.CreateDefaultContext()
    q: Vector = np.zeros(plant.num_positions())
    q[0] = 1.0
    for name, angle in posture.items():
        q[plant.GetJointByName(name).position_start()] = angle
    plant.SetPositions(context, q)
    joints = [plant.GetJointByName(name) for name in moving]
    every = [plant.get_joint(index) for index in plant.GetJointIndices()]
    above = {joint.child_body().index(): joint.parent_body().index() for joint in every}
    root = plant.GetBodyByName(base)
    places = {joint.child_body().index(): i + 1 for i, joint in enumerate(joints)}
    places[root.index()] = 0

    def place(body: BodyIndex) -> int:
        """Of the link that a body is part of; -1 for the world."""
        while body not in places:
            if body not in above:
                return -1
            body = above[body]
        return places[body]

    parts: list[list[BodyIndex]] = [[] for _ in range(len(joints) + 1)]
    for index in above:
        parts[place(index)].append(index)
    frames = [root.body_frame(), *(joint.frame_on_child() for joint in joints)]
    links = []
    for i, bodies in enumerate(parts):
        parent, turn = -1, np.zeros((3, 3, 3))
        p_PL: Vector = np.zeros(3)
        axis: Vector = np.zeros(3)
        if i:
            joint = joints[i - 1]
            if joint.type_name() != "revolute":
                raise ValueError(
                    f"{joint.name()}: must be revolute, got {joint.type_name()}"
                )
            parent = place(joint.parent_body().index())
            if not 0 <= parent < i:
                raise ValueError(f"{joint.name()}: must come after its parent")
            axis = joint.revolute_axis()  # type: ignore[attr-defined]
            X_PF = joint.frame_on_parent().CalcPose(context, frames[parent])
            p_PL = X_PF.translation()
            turn = X_PF.rotation().matrix() @ _about(axis)
        inertia = plant.CalcSpatialInertia(context, frames[i], bodies)
        links.append(
            Link(
                parent,
                p_PL,
                axis,
                turn,
                inertia.get_mass(),
                inertia.get_mass() * np.asarray(inertia.get_com()),
                inertia.CalcRotationalInertia().CopyToFullMatrix3(),
            )
        )
    carried = np.array([link.mass for link in links])
    for i in range(len(links) - 1, 0, -1):
        carried[links[i].parent] += carried[i]
    return LinkTree(
        tuple(links),
        carried,
        np.array([joint.position_start() for joint in joints]),
        np.array([joint.velocity_start() for joint in joints]),
        q,
    )


def com_in_base(tree: LinkTree, angles: Vector) -> Vector:
    """The CoM of the whole robot seen from its base.

    Args:
        tree: the robot.
        angles: of the joints that move, (n, k), rad.

    Returns:
        p_BCom, (n, 3), m.
    """
    cosine, sine = np.cos(angles.T), np.sin(angles.T)
    moments = [link.moment[:, None] for link in tree.links]
    for i in range(len(tree.links) - 1, 0, -1):
        link = tree.links[i]
        turned = _turned(link.turn, cosine[i - 1], sine[i - 1], moments[i])
        turned += tree.carried[i] * link.p_PL[:, None]
        moments[link.parent] = moments[link.parent] + turned
    p_BCom: Vector = (moments[0] / tree.mass).T
    return p_BCom


def momentum(tree: LinkTree, q: Vector, v: Vector) -> MomentumTrajectory:
    """CoM and momentum at every tick of a motion.

    Velocities go from the base outwards and momenta back, each in its link's frame.

    Args:
        tree: the robot.
        q: positions of the plant, (n, nq).
        v: velocities of the plant, (n, nv).

    Raises:
        ValueError: a joint that is frozen in the tree moves.
    """
    frozen = np.ones(q.shape[1], dtype=bool)
    frozen[:7], frozen[tree.columns] = False, False
    if np.abs(q[:, frozen] - tree.posture[frozen]).max(initial=0.0) > 1e-9:
        raise ValueError("q: joints that are frozen in the tree must rest in its pose")
    n = len(q)
    angles, rates = q[:, tree.columns].T, v[:, tree.speeds].T
    cosine, sine = np.cos(angles), np.sin(angles)
    R_WB = _orientations(q[:, :4])
    # Angular velocity and velocity of each link's origin, (3, 2, n).
    twists = [np.einsum("jin,kjn->ikn", R_WB, v[:, :6].T.reshape(2, 3, n))]
    for i, link in enumerate(tree.links[1:]):
        twist = twists[link.parent].copy()
        twist[:, 1] += _cross(twist[:, 0], link.p_PL)
        back = np.swapaxes(link.turn, 1, 2)
        twist = _turned(back, cosine[i], sine[i], twist)
        twist[:, 0] += np.outer(link.axis, rates[i])
        twists.append(twist)
    # Mass times CoM, momentum, and its moment about each link's origin, (3, 3, n).
    sums = []
    for link, twist in zip(tree.links, twists, strict=True):
        spin, speed = twist[:, 0], twist[:, 1]
        sums.append(
            np.stack(
                [
                    np.broadcast_to(link.moment[:, None], (3, n)),
                    link.mass * speed + _cross(spin, link.moment),
                    link.inertia @ spin - _cross(speed, link.moment),
                ],
                axis=1,
            )
        )
    for i in range(len(tree.links) - 1, 0, -1):
        link = tree.links[i]
        turned = _turned(link.turn, cosine[i - 1], sine[i - 1], sums[i])
        turned[:, 2] -= _cross(turned[:, 1], link.p_PL)
        turned[:, 0] += tree.carried[i] * link.p_PL[:, None]
        sums[link.parent] += turned
    lever, linear, angular = np.einsum("ijn,jkn->kni", R_WB, sums[0])
    p_WB = q[:, 4:7]
    return MomentumTrajectory(
        mass=tree.mass,
        com=p_WB + lever / tree.mass,
        linear=linear,
        angular=angular + np.cross(p_WB, linear),
    )


def _about(axis: Vector) -> Vector:
    """Rodrigues' rotation about an axis as the `turn` of a link."""
    along = np.outer(axis, axis)
    return np.array([along, np.eye(3) - along, VectorToSkewSymmetric(axis)])


def _turned(turn: Vector, cosine: Vector, sine: Vector, vectors: Vector) -> Vector:
    """R_PL v for vectors in L: (3, n) or (3, m, n) as given, to n angles."""
    shape = (3, *vectors.shape)
    parts = (turn.reshape(9, 3) @ vectors.reshape(3, -1)).reshape(shape)
    turned: Vector = parts[0] + cosine * parts[1] + sine * parts[2]
    return turned


def _cross(a: Vector, b: Vector) -> Vector:
    """Cross products of vectors (3, n) and one vector (3,), (3, n)."""
    x, y, z = b
    matrix = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    return np.asarray(matrix @ a)


def _orientations(quaternion: Vector) -> Vector:
    """Rotation matrices (3, 3, n) of quaternions (w, x, y, z), (n, 4)."""
    w, x, y, z = quaternion.T / np.linalg.norm(quaternion, axis=1)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
