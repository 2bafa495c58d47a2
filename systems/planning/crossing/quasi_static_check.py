"""What standing asks of the robot along a slow motion: balance and joint torques."""

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Context

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET
from footfall.models.values.planned import ContactPhase
from footfall.models.values.vector import Vector
from footfall.systems.balance.convex_polygon import signed_margin
from footfall.systems.balance.sole_contacts import carrying_contact
from footfall.systems.balance.stability_polygon import static_polygon
from footfall.systems.balance.wrench_distribution import (
    DistributionParams,
    TorqueMap,
    distribute_wrench,
)
from footfall.systems.balance.zmp_preview import GRAVITY
from footfall.systems.planning.crossing.quasi_static_unit import (
    Balance,
    QuasiStaticCrossingParams,
)
from footfall.systems.planning.whole_body.whole_body_plan import WholeBody, body_motion
from footfall.systems.tracking.whole_body_feedforward import (
    foot_torque_matrix,
    momentum_rate,
    needed_forces,
)


def balance_of(
    body: WholeBody, context: Context, quasi: QuasiStaticCrossingParams
) -> Balance:
    """What the line model of `quasi_static_unit` needs to know of the whole body.

    Waist and CoM are compared in the robot's `crossing_stance`.

    Args:
        body: the robot.
        context: scratch context of its plant.
        quasi: where the CoM is, and the posture, as phase 2 begins and ends.
    """
    feet: Vector = np.zeros((2, 2, 6))
    for i, foot in enumerate(FEET):
        feet[:, i, 1] = body.leg.hips[foot][1]
    step, waist = body.robot.crossing_stance
    feet[:, 1, 0] = step
    com = np.array([[quasi.com_begin, 0.0], [step + quasi.com_end, 0.0]])
    rpy = np.array([[0.0, 0.0, 0.0], [0.0, quasi.lean, 0.0]])
    found = body_motion(
        body,
        com,
        np.full(2, waist),
        rpy,
        feet,
        np.array([0.0, -quasi.arms]),
        rounds=6,
    )
    knee = body.robot.knee_joints["left"]
    begin, end = found.waist[:, 0] - found.com[:, 0]
    return Balance(
        float(begin),
        float(end),
        body.plant.CalcTotalMass(context) * GRAVITY,
        effort_limits(body.plant)[knee],
    )


def effort_limits(plant: MultibodyPlant) -> dict[str, float]:
    """Effort limit of every actuated joint, Nm."""
    actuators = [plant.get_joint_actuator(i) for i in plant.GetJointActuatorIndices()]
    return {item.joint().name(): item.effort_limit() for item in actuators}


def min_margin(
    phases: tuple[ContactPhase, ...],
    com: Vector,
    feet: Vector,
    period: float,
    sole: Sole,
    friction: float,
) -> float:
    """Least signed distance of the CoM to the edge of what it stands on, m.

    Args:
        phases: of the motion; in each the feet that stand rest.
        com: p_WCom, (n, 3), m.
        feet: sole poses, (n, 2, 6).
        period: between rows, s.
        sole: of both feet.
        friction: mu that the static-stability polygons are computed with.
    """
    margins = []
    for phase in phases:
        first, last = (round(t / period) for t in (phase.start, phase.end))
        contacts = [
            carrying_contact(feet[first, FEET.index(foot)], sole.length, sole, friction)
            for foot in phase.stance
        ]
        polygon = static_polygon(contacts).vertices
        margins += [signed_margin(polygon, p[:2]) for p in com[first : last + 1 : 4]]
    return float(min(margins))


def worst_torque(
    body: WholeBody,
    context: Context,
    q: Vector,
    feet: Vector,
    contacts: Vector,
    friction: float,
) -> tuple[float, str, int]:
    """The largest share of an effort limit that resting in any of n postures takes.

    Args:
        body: the robot.
        context: scratch context of its plant; its state is changed.
        q: positions, (n, nq).
        feet: sole poses, (n, 2, 6).
        contacts: which feet carry, (n, 2).
        friction: mu of the pyramids that the wrenches are kept in.

    Returns:
        The share, the joint and the row.
    """
    plant, robot = body.plant, body.robot
    limits = effort_limits(plant)
    columns = [plant.GetJointByName(name).velocity_start() for name in limits]
    effort = np.array(list(limits.values()))
    legs = [name for foot in FEET for name in robot.leg_joints[foot]]
    in_legs = np.array([name in legs for name in limits])
    soles = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
    p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
    rest: Vector = np.zeros(plant.num_velocities())
    weight = plant.CalcTotalMass(context) * GRAVITY
    shares = np.zeros((len(q), len(limits)))
    plant.SetVelocities(context, rest)
    for row in range(len(q)):
        plant.SetPositions(context, q[row])
        forces = needed_forces(plant, context, rest)
        matrix = foot_torque_matrix(plant, context, soles, p_BF)[columns]
        net = np.concatenate(
            [[0.0, 0.0, weight], momentum_rate(plant, context, forces)]
        )
        wrenches, _ = distribute_wrench(
            net,
            plant.CalcCenterOfMassPositionInWorld(context),
            feet[row],
            contacts[row],
            np.full(2, robot.sole.length),
            robot.sole,
            DistributionParams(friction=friction),
            TorqueMap(forces[columns][in_legs], matrix[in_legs]),
        )
        shares[row] = np.abs(forces[columns] - matrix @ wrenches.ravel()) / effort
    worst, joint = np.unravel_index(int(shares.argmax()), shares.shape)
    return float(shares[worst, joint]), list(limits)[int(joint)], int(worst)
