"""What a motion plan will ask of the robot: torques, reach and room for its limbs.

The plan is carried out in thought: the whole-body IK follows it at a coarse tick,
inverse dynamics under distributed foot wrenches give the joint torques, and the limbs'
collision hulls are held against the edges of the treads. Nothing here knows of
contact physics, servos or feedback.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Context

from footfall.models.robots.collision_hulls import CollisionHull
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.self_distance import SelfDistance, SelfDistanceMeter
from footfall.models.values.feet import FEET
from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.wrench_distribution import (
    DistributionParams,
    TorqueMap,
    distribute_wrench,
)
from footfall.systems.balance.zmp_preview import GRAVITY
from footfall.systems.planning.motion.toe_off import heading
from footfall.systems.tracking.whole_body_feedforward import (
    foot_torque_matrix,
    momentum_rate,
    needed_forces,
)
from footfall.systems.tracking.whole_body_ik import IkTarget, WholeBodyIk, integrate

TICK = 0.02
"""Between the postures that are looked at, s."""
SETTLING_TICKS = 150
"""Ticks in which the IK comes to rest on the plan's first row."""
SELF_RANGE = 0.02
"""Bodies of the robot farther from each other than this are not looked at, m."""
NORMALS = np.linspace(0.0, 0.5 * np.pi, 31)
"""Directions in which a limb is told from a step, from level to straight up, rad."""


@dataclass(frozen=True)
class MotionPrediction:
    """What a plan asks for, at n moments."""

    time: Vector
    """Since the plan's start, (n,), s."""
    torques: Vector
    """Of the actuated joints, not limited, (n, na), Nm."""
    joints: tuple[str, ...]
    """Their names."""
    effort_limits: Vector
    """(na,), Nm."""
    foot_error: Vector
    """Distance by which the worse sole misses its pose, (n,), m."""
    com_error: Vector
    """Horizontal distance by which the CoM misses its place, (n,), m."""
    posture_error: Vector
    """How far the joint above the legs that strays most is from its posture, (n,),
    rad: arms that are flung up make up for legs that are too short."""
    gaps: Vector
    """Least distance of each limb to the edges, (n, b), m; negative where it runs
    into a step; inf without edges."""
    limbs: tuple[str, ...]
    """Names of those bodies."""
    self_distances: tuple[SelfDistance, ...]
    """The two bodies of the robot that are nearest to each other, at each moment."""

    def worst_torque(self, window: float = 0.0) -> tuple[float, str, float]:
        """The largest share of an effort limit, which joint's, and when, s.

        Args:
            window: over how long torques are averaged, s: a servo that is at its limit
                for a moment lets the body sink by a little, it does not drop it.
        """
        signed = self.torques / self.effort_limits
        step = self.time[1] - self.time[0] if len(self.time) > 1 else 1.0
        span = min(max(1, round(window / step)), len(signed))
        total = np.vstack([np.zeros(signed.shape[1]), np.cumsum(signed, axis=0)])
        shares = np.abs(total[span:] - total[:-span]) / span
        row, column = np.unravel_index(int(shares.argmax()), shares.shape)
        joint = self.joints[int(column)]
        return float(shares[row, column]), joint, float(self.time[row])

    def worst_self_distance(self) -> tuple[SelfDistance, float]:
        """The least distance between two bodies of the robot, and when, s."""
        worst = min(
            range(len(self.time)), key=lambda k: self.self_distances[k].distance
        )
        return self.self_distances[worst], float(self.time[worst])

    def worst_gap(self) -> tuple[float, str, float]:
        """The least gap, m, which limb's, and when, s."""
        row, column = np.unravel_index(int(self.gaps.argmin()), self.gaps.shape)
        return (
            float(self.gaps[row, column]),
            self.limbs[int(column)],
            float(self.time[row]),
        )


class MotionPredictor:
    """Predicts for one robot; it keeps no state between predictions."""

    def __init__(
        self,
        plant: MultibodyPlant,
        robot: RobotModel,
        ik: WholeBodyIk,
        distribution: DistributionParams,
        hulls: Sequence[CollisionHull],
        meter: SelfDistanceMeter,
    ) -> None:
        """Gathers frames, limits and limbs.

        Args:
            plant: the robot alone, finalised.
            robot: its names.
            ik: the whole-body IK that will track the plan.
            distribution: how the feet will share the load.
            hulls: of the bodies; the feet's are not looked at, as the swing keeps
                them off the edges.
            meter: of the robot's own collision geometry.
        """
        self._plant, self._robot, self._ik = plant, robot, ik
        self._distribution, self._meter = distribution, meter
        self._feet = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
        self._p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
        actuators = [
            plant.get_joint_actuator(index) for index in plant.GetJointActuatorIndices()
        ]
        self._joints = tuple(item.joint().name() for item in actuators)
        self._rows = np.array([item.joint().velocity_start() for item in actuators])
        legs = {name for leg in robot.leg_joints.values() for name in leg}
        self._legs = np.array([name in legs for name in self._joints])
        self._upper = np.array(
            [
                item.joint().position_start()
                for item in actuators
                if item.joint().name() not in legs
            ]
        )
        self._effort = np.array([item.effort_limit() for item in actuators])
        self._mass = plant.CalcTotalMass(plant.CreateDefaultContext())
        feet = set(robot.foot_bodies.values())
        limbs = [hull for hull in hulls if hull.body not in feet]
        self._limbs = [plant.GetBodyByName(hull.body) for hull in limbs]
        sizes = [len(hull.vertices) for hull in limbs]
        self._first_vertex = np.cumsum([0, *sizes[:-1]]).tolist()
        self._limb_of_vertex = np.repeat(np.arange(len(limbs)), sizes)
        self._vertices = np.vstack([np.zeros((0, 3)), *(h.vertices for h in limbs)])

    def predict(
        self,
        plan: MotionPlan,
        edges: Vector,
        yaw: float,
        tick: float = TICK,
        first: float = 0.0,
        refuses: Callable[[float, float, float, float], bool] | None = None,
    ) -> MotionPrediction:
        """Carries out a plan in thought.

        Args:
            plan: the plan.
            edges: a point of the front edge of each tread, (m, 3), m; the step fills
                all that is ahead of it and below it.
            yaw: direction in which the stairs go up, rad.
            tick: between the postures that are looked at, s.
            first: when the prediction begins, s after the plan's start; the plan is
                at rest then.
            refuses: is told the foot error, the posture error, the least gap and the
                least distance of two bodies in each posture; where it refuses them, the
                prediction ends there.

        Returns:
            The prediction.
        """
        plant, context = self._plant, self._plant.CreateDefaultContext()
        stride = max(1, round(tick / plan.period))
        begin = round(first / plan.period)
        rows = list(range(begin, len(plan.zmp), stride))
        time: Vector = np.array(rows) * plan.period
        step = stride * plan.period
        q = self._ik.posture.copy()
        q[4:7] = plan.com[begin]
        at_rest = self._target(plan, begin, 0)
        for _ in range(SETTLING_TICKS):
            plant.SetPositions(context, q)
            settling, _ = self._ik.solve(context, at_rest)
            q = integrate(plant, context, settling, step)
        v: Vector = np.zeros(plant.num_velocities())
        torques = np.zeros((len(rows), len(self._joints)))
        foot_error, com_error = np.zeros(len(rows)), np.zeros(len(rows))
        posture_error = np.zeros(len(rows))
        gaps = np.full((len(rows), len(self._limbs)), np.inf)
        self_distances: list[SelfDistance] = []
        for k, row in enumerate(rows):
            plant.SetPositions(context, q)
            plant.SetVelocities(context, v)
            before = v
            foot_error[k], com_error[k] = self._errors(context, plan, row)
            posture_error[k] = np.abs(q - self._ik.posture)[self._upper].max()
            self_distances.append(self._meter.nearest(q, SELF_RANGE))
            if len(edges):
                gaps[k] = self._gaps(context, edges, yaw)
            if refuses and refuses(
                foot_error[k],
                posture_error[k],
                float(gaps[k].min()),
                self_distances[-1].distance,
            ):
                rows = rows[: k + 1]
                break
            v, _ = self._ik.solve(context, self._target(plan, row, stride))
            torques[k] = self._torques(context, plan, row, (v - before) / step)
            q = integrate(plant, context, v, step)
        seen = len(rows)
        return MotionPrediction(
            time=time[:seen],
            torques=torques[:seen],
            joints=self._joints,
            effort_limits=self._effort,
            foot_error=foot_error[:seen],
            com_error=com_error[:seen],
            posture_error=posture_error[:seen],
            gaps=gaps[:seen],
            limbs=tuple(body.name() for body in self._limbs),
            self_distances=tuple(self_distances),
        )

    def _target(self, plan: MotionPlan, row: int, stride: int) -> IkTarget:
        """What the IK tracks at a row; at rest with a stride of 0."""
        after = min(row + stride, len(plan.zmp) - 1)
        scale = 1.0 / (stride * plan.period) if stride else 0.0
        return IkTarget(
            com=plan.com[row],
            com_velocity=(plan.com[after] - plan.com[row]) * scale,
            foot_poses=plan.foot_poses[row],
            foot_rates=(plan.foot_poses[after] - plan.foot_poses[row]) * scale,
            stance=plan.contacts[row],
            waist=plan.waist[row],
            waist_rate=(plan.waist[after] - plan.waist[row]) * scale,
        )

    def _errors(
        self, context: Context, plan: MotionPlan, row: int
    ) -> tuple[float, float]:
        p_WCom = self._plant.CalcCenterOfMassPositionInWorld(context)
        missed = [
            np.linalg.norm(body.EvalPoseInWorld(context).multiply(self._p_BF) - p[:3])
            for body, p in zip(self._feet, plan.foot_poses[row], strict=True)
        ]
        apart = np.linalg.norm(p_WCom[:2] - plan.com[row, :2])
        return float(max(missed)), float(apart)

    def _torques(
        self, context: Context, plan: MotionPlan, row: int, acceleration: Vector
    ) -> Vector:
        plant = self._plant
        forces = needed_forces(plant, context, acceleration)
        lift: Vector = plan.com_acceleration[row] + np.array([0.0, 0.0, GRAVITY])
        wrench_map = foot_torque_matrix(plant, context, self._feet, self._p_BF)
        torques = TorqueMap(forces[self._rows], wrench_map[self._rows])
        wrenches, _ = distribute_wrench(
            np.concatenate([self._mass * lift, momentum_rate(plant, context, forces)]),
            plant.CalcCenterOfMassPositionInWorld(context),
            plan.foot_poses[row],
            plan.contacts[row],
            plan.contact_lengths[row],
            self._robot.sole,
            self._distribution,
            TorqueMap(torques.offset[self._legs], torques.matrix[self._legs]),
        )
        needed: Vector = torques.offset - torques.matrix @ wrenches.ravel()
        return needed

    def _gaps(self, context: Context, edges: Vector, yaw: float) -> Vector:
        poses = [body.EvalPoseInWorld(context) for body in self._limbs]
        R_WB = np.array([X_WB.rotation().matrix() for X_WB in poses])
        p_WB = np.array([X_WB.translation() for X_WB in poses])
        limb = self._limb_of_vertex
        p_W = np.einsum("nij,nj->ni", R_WB[limb], self._vertices) + p_WB[limb]
        return edge_gaps(p_W, self._first_vertex, edges, heading(yaw))


def edge_gaps(points: Vector, first: list[int], edges: Vector, ahead: Vector) -> Vector:
    """How far convex bodies are from steps that fill all ahead of and below an edge.

    Both are convex in the plane along the stairs, so that a line tells them apart
    where they do not meet; what is beside the steps counts as before them.

    Args:
        points: the bodies' vertices, one body after the other, (n, 3), m.
        first: index of each body's first vertex, (b,).
        edges: a point of each step's front edge, (m, 3), m.
        ahead: horizontal unit vector up the stairs, (2,).

    Returns:
        The least distance of each body, (b,), m; negative by how far it would have to
        move where it runs into a step.
    """
    normals = np.array([-np.cos(NORMALS), np.sin(NORMALS)])
    along = np.column_stack([points[:, :2] @ ahead, points[:, 2]]) @ normals
    bodies = np.minimum.reduceat(along, first, axis=0)
    steps = np.column_stack([edges[:, :2] @ ahead, edges[:, 2]]) @ normals
    between = bodies[:, None] - steps
    return np.asarray(between.max(axis=2).min(axis=1))
