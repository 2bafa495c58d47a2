"""What a planned motion asks of the joints while one foot carries the robot.

Then the ground's wrench follows from the motion alone (Newton and Euler at the floating
base), and with it every joint's torque: no load can be passed to another foot.
"""

import numpy as np
from pydrake.systems.framework import Context

from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.quasi_static_check import effort_limits
from footfall.systems.planning.whole_body.whole_body_plan import WholeBody, spins
from footfall.systems.tracking.whole_body_feedforward import (
    foot_torque_matrix,
    needed_forces,
)


def single_support_torque(
    body: WholeBody,
    context: Context,
    q: Vector,
    period: float,
    contacts: Vector,
    every: int = 1,
) -> tuple[float, str, int]:
    """The largest share of an effort limit in any row with one foot down.

    Args:
        body: the robot.
        context: scratch context of its plant; its state is changed.
        q: positions, (n, nq).
        period: between rows, s.
        contacts: which feet carry, (n, 2), left first.
        every: only every so many of those rows are looked at.

    Returns:
        The share, the joint and the row; (0.0, "", 0) where both feet always carry.
    """
    plant, robot = body.plant, body.robot
    rates: Vector = np.asarray(np.gradient(q, period, axis=0))
    v = np.column_stack([spins(q[:, :4], rates[:, :4]), rates[:, 4:]])
    acceleration: Vector = np.asarray(np.gradient(v, period, axis=0))
    limits = effort_limits(plant)
    columns = [plant.GetJointByName(name).velocity_start() for name in limits]
    effort = np.array(list(limits.values()))
    soles = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
    p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
    worst = (0.0, "", 0)
    for row in np.flatnonzero(contacts.sum(axis=1) == 1.0)[::every]:
        plant.SetPositions(context, q[row])
        plant.SetVelocities(context, v[row])
        forces = needed_forces(plant, context, acceleration[row])
        foot = int(contacts[row].argmax())
        matrix = foot_torque_matrix(plant, context, soles, p_BF)
        matrix = matrix[:, 6 * foot : 6 * foot + 6]
        # The base has no motor: what it needs is what the ground gives.
        wrench = np.linalg.solve(matrix[:6], forces[:6])
        shares = np.abs(forces[columns] - matrix[columns] @ wrench) / effort
        joint = int(shares.argmax())
        if shares[joint] > worst[0]:
            worst = (float(shares[joint]), list(limits)[joint], int(row))
    return worst
