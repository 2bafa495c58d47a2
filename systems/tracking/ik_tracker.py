"""Whole-body tracking as a System: task references in, joint references out."""

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Context, DiscreteValues, LeafSystem

from footfall.models.robots.robot import RobotModel
from footfall.models.values.vector import Vector
from footfall.systems.plant_cache import declare_scratch_context
from footfall.systems.ports import declare_state_output, eval_vector, set_state
from footfall.systems.timing import timed
from footfall.systems.tracking.whole_body_ik import (
    IkParams,
    IkTarget,
    WholeBodyIk,
    integrate,
)

_Q, _V, _VDOT, _JOINTS = range(4)
"""The groups of the discrete state."""


class IkTracker(LeafSystem):
    """Integrates the whole-body IK: a reference motion of every joint and the base.

    .. pydrake_system::

        name: IkTracker
        input_ports:
        - com_reference
        - foot_references
        - contacts
        - waist
        - arms
        output_ports:
        - positions
        - velocities
        - accelerations
        - joint_references

    - `com_reference`: p_WCom, v_WCom and a_WCom wanted, (9,), m, m/s, m/s^2.
    - `foot_references`: sole frames X_WF (x, y, z, roll, pitch, yaw), left then right,
      then their rates, (24,), m, rad, m/s, rad/s.
    - `contacts`: feet on the ground, left and right, 0 or 1, then two numbers that are
      not used, (4,).
    - `waist`: pelvis (roll, pitch, yaw) in W and their rates, (6,), rad, rad/s.
    - `arms`: how far both shoulders are to pitch to the rear of their posture and the
      rate, (2,), rad, rad/s; at the posture where nothing is connected.
    - `positions`: q of the reference motion, (nq,).
    - `velocities`: v, (nv,).
    - `accelerations`: how v changed over the last tick, (nv,).
    - `joint_references`: q of the actuated joints, then v, (2 na,), rad, rad/s: what a
      MultibodyPlant's `desired_state` port takes.

    The discrete state is q, v, the acceleration and the joints' references.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        robot: RobotModel,
        params: IkParams,
        positions: Vector,
    ) -> None:
        """Declares the ports.

        Args:
            plant: the robot alone, finalised.
            robot: its names.
            params: weights.
            positions: q in the default context, (nq,).

        Raises:
            ValueError: a parameter is out of range, or positions has another size.
        """
        super().__init__()
        nq, nv = plant.num_positions(), plant.num_velocities()
        if positions.shape != (nq,):
            raise ValueError(f"positions must be ({nq},), got {positions.shape}")
        self._plant, self._params = plant, params
        self._ik = WholeBodyIk(plant, robot, params)
        self._nq, self._nv = nq, nv
        joints = [
            plant.get_joint_actuator(index).joint()
            for index in plant.GetJointActuatorIndices()
        ]
        self._q_rows = np.array([joint.position_start() for joint in joints])
        self._v_rows = np.array([joint.velocity_start() for joint in joints])
        for name, value in (
            ("positions", positions),
            ("velocities", np.zeros(nv)),
            ("accelerations", np.zeros(nv)),
            ("joint_references", self._joint_references(positions, np.zeros(nv))),
        ):
            declare_state_output(self, name, value)
        self._com = self.DeclareVectorInputPort("com_reference", 9)
        self._feet = self.DeclareVectorInputPort("foot_references", 24)
        self._contacts = self.DeclareVectorInputPort("contacts", 4)
        self._waist = self.DeclareVectorInputPort("waist", 6)
        self._arms = self.DeclareVectorInputPort("arms", 2)
        self._scratch = declare_scratch_context(self, plant)
        self.DeclarePeriodicDiscreteUpdateEvent(
            period_sec=params.period, offset_sec=0.0, update=timed(self, self._update)
        )

    def _joint_references(self, q: Vector, v: Vector) -> Vector:
        return np.concatenate([q[self._q_rows], v[self._v_rows]])

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        q, v_before = (context.get_discrete_state(i).value() for i in (_Q, _V))
        com = eval_vector(self._com, context)
        feet = eval_vector(self._feet, context).reshape(2, 2, 6)
        waist = eval_vector(self._waist, context)
        swing = np.zeros(2)
        if self._arms.HasValue(context):
            swing = eval_vector(self._arms, context)
        target = IkTarget(
            com=com[:3],
            com_velocity=com[3:6],
            foot_poses=feet[0],
            foot_rates=feet[1],
            stance=eval_vector(self._contacts, context)[:2],
            waist=waist[:3],
            waist_rate=waist[3:],
            arms=float(swing[0]),
            arms_rate=float(swing[1]),
        )
        plant_context = self._scratch(context)
        self._plant.SetPositions(plant_context, q)
        v, _ = self._ik.solve(plant_context, target)
        q = integrate(self._plant, plant_context, v, self._params.period)
        set_state(discrete, _Q, q)
        set_state(discrete, _V, v)
        set_state(discrete, _VDOT, (v - v_before) / self._params.period)
        set_state(discrete, _JOINTS, self._joint_references(q, v))
