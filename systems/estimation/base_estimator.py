"""The base estimator as a System: sensors in, the robot's whole state out."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.math import RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import (
    BasicVector,
    Context,
    DiscreteStateIndex,
    DiscreteValues,
    LeafSystem,
)

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.cached import declare_cached
from footfall.systems.estimation.base_estimate import (
    BaseEstimate,
    FootPose,
    deviations,
    initial_estimate,
    pack,
    pack_known,
    unpack,
)
from footfall.systems.estimation.filter_params import (
    FilterModel,
    FilterParams,
    filter_model,
)
from footfall.systems.estimation.invariant_ekf import carried, hold_feet, propagate
from footfall.systems.estimation.known_ground import stand_on
from footfall.systems.estimation.rotations import exp_rotation, log_rotation
from footfall.systems.plant_cache import declare_scratch_context
from footfall.systems.ports import (
    declare_state,
    declare_state_output,
    eval_vector,
    read_state,
    set_state,
    set_vector,
)
from footfall.systems.timing import timed

SILENCE = 0.02
"""So long, s, an IMU may say nothing before it is taken for dead."""
BLIND_TURN = 1.0
"""How fast a base turns of which no IMU tells, rad/s per root Hz."""
BLIND_ACCELERATION = 3.0
"""How it is pulled, m/s^2 per root Hz."""
LAID = -1.0
"""Stands for the time of a foot whose ground has been taken into account."""


class _Now(NamedTuple):
    """The estimate after all that has arrived."""

    estimate: BaseEstimate
    integrals: Vector
    """Of the IMU, up to which it goes, (7,)."""
    angular_rate: Vector
    """Mean since the estimate before, in B, without bias, (3,), rad/s."""
    acceleration: Vector
    """Mean since the estimate before, of the base in W, (3,), m/s^2."""
    borne: Vector
    """For how long each foot has borne load, s, or `LAID`, (2,)."""
    silent: float = 0.0
    """For how long the IMU has said nothing, s."""
    was_silent: float = 0.0
    """For how long the filter went on without it, s."""


class BaseEstimator(LeafSystem):
    """Tells pose and velocity of the base, and with the encoders the robot's state.

    It takes in whatever has arrived when it is asked, and keeps it once a tick; asked
    between ticks it says what it knows by then.

    .. pydrake_system::

        name: BaseEstimator
        input_ports:
        - imu
        - joints
        - bearing
        - footholds
        output_ports:
        - state
        - deviation
        - biases
        - faults

    - `imu`: time of the latest sample, s, then integrals of angular rate, rad, and
      specific force, m/s, of a unit at the base's origin along its axes, (7,).
    - `joints`: measured positions, then velocities of the joints in the order of the
      state, (2 n,), rad, rad/s.
    - `bearing`: left and right foot bears load and does not move, 0 or 1, (2,).
    - `footholds`: planes known on which the left and the right sole are to lie, normal
      n in W and distance n . x of its points, (8,), -, -, -, m; zeros where none is
      known.
    - `state`: estimated positions and velocities of the robot, `lead` after the latest
      sample, (nq + nv,).
    - `deviation`: standard deviations about W's axes of the base's orientation, rad,
      velocity, m/s, and position, m, (9,), when the covariance was last carried on.
    - `biases`: of the gyroscope, rad/s, and of the accelerometer, m/s^2, (6,), of the
      last tick.
    - `faults`: how often the left and the right foot was found away from where it
      stood, no unit, and for how long in all there was no IMU, s, (3,), up to the last
      tick.

    An IMU that says nothing for `SILENCE` is taken for dead: from then on the feet
    alone carry the estimate, as those of a base that moves on as it moved, known ill.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        robot: RobotModel,
        params: FilterParams,
        positions: Vector,
        period: float,
    ) -> None:
        """Declares the ports.

        Args:
            plant: the robot alone, finalised.
            robot: its names.
            params: noise of the filter's model.
            positions: q where the robot begins, which says where W is, (nq,).
            period: between two ticks, s.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate()
        self._plant, self._params, self._period = plant, params, period
        self._base = plant.GetBodyByName(robot.base_body)
        self._feet = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
        self._p_AF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
        self._gravity = float(np.linalg.norm(plant.gravity_field().gravity_vector()))
        self._moving = filter_model(params, self._gravity)
        self._resting = filter_model(params, self._gravity, at_rest=True)
        self._blind = filter_model(
            replace(params, gyroscope=BLIND_TURN, accelerometer=BLIND_ACCELERATION),
            self._gravity,
        )
        self._joints_count = plant.num_positions() - 7
        self._level = np.concatenate([[1.0], np.zeros(6)])
        quaternion = Quaternion(positions[:4] / np.linalg.norm(positions[:4]))
        R_WB: Vector = RotationMatrix(quaternion).matrix()
        first = initial_estimate(R_WB, positions[4:7], params)
        self._memory = declare_state(self, pack(first))
        self._known = declare_state(self, pack_known(first))
        self._read = declare_state(self, np.zeros(17))
        self._imu = self.DeclareVectorInputPort("imu", 7)
        self._joints = self.DeclareVectorInputPort("joints", 2 * self._joints_count)
        self._bearing = self.DeclareVectorInputPort("bearing", 2)
        self._footholds = self.DeclareVectorInputPort("footholds", 8)
        self._scratch = declare_scratch_context(self, plant)
        inputs = {
            self._imu.ticket(),
            self._joints.ticket(),
            self._bearing.ticket(),
            self._footholds.ticket(),
            *(
                self.discrete_state_ticket(DiscreteStateIndex(group))
                for group in (self._memory, self._known, self._read)
            ),
        }
        self._now = declare_cached(self, "now", self._calc_now, inputs)
        self.DeclareVectorOutputPort(
            "state",
            plant.num_multibody_states(),
            timed(self, self._calc_state),
            prerequisites_of_calc=inputs,
        )
        self._deviation, self._biases, self._faults = (
            declare_state_output(self, name, value)
            for name, value in (
                ("deviation", deviations(first)),
                ("biases", np.zeros(6)),
                ("faults", np.zeros(3)),
            )
        )
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))

    def _calc_now(self, context: Context) -> _Now:
        read = read_state(context, self._read)
        estimate = unpack(
            read_state(context, self._memory), read_state(context, self._known)
        )
        integrals = eval_vector(self._imu, context)
        duration = integrals[0] - read[0]
        silent, was_silent = read[13:15].tolist()
        borne = read[15:]
        if duration <= 0.0:
            if silent < SILENCE:
                return _Now(
                    estimate,
                    integrals,
                    read[7:10],
                    read[10:13],
                    borne,
                    silent,
                    was_silent,
                )
            return self._without_imu(
                context, estimate, integrals, borne, silent, was_silent
            )
        rate, force = ((integrals[1:] - read[1:7]) / duration).reshape(2, 3)
        joints = eval_vector(self._joints, context)
        still = np.abs(joints[self._joints_count :]).max() < self._params.rest_speed
        model = self._resting if still else self._moving
        before = self._resting if estimate.at_rest else self._moving
        if model is not before:
            estimate = carried(estimate, before)
        estimate = propagate(estimate, rate, force, duration, model)
        estimate, borne = self._hold_feet(context, joints, estimate, borne, model)
        acceleration = estimate.R_WB @ (force - estimate.accelerometer_bias)
        acceleration[2] -= self._gravity
        rate = rate - estimate.gyroscope_bias
        return _Now(estimate, integrals, rate, acceleration, borne, 0.0, was_silent)

    def _without_imu(
        self,
        context: Context,
        estimate: BaseEstimate,
        integrals: Vector,
        borne: Vector,
        silent: float,
        was_silent: float,
    ) -> _Now:
        """Goes on for a tick by the feet alone."""
        before = estimate.R_WB
        hanging = estimate.R_WB.T @ np.array([0.0, 0.0, self._gravity])
        estimate = propagate(
            estimate,
            estimate.gyroscope_bias,
            hanging + estimate.accelerometer_bias,
            self._period,
            self._blind,
        )
        joints = eval_vector(self._joints, context)
        estimate, borne = self._hold_feet(context, joints, estimate, borne, self._blind)
        rate = log_rotation(before.T @ estimate.R_WB) / self._period
        was_silent += self._period
        return _Now(estimate, integrals, rate, np.zeros(3), borne, silent, was_silent)

    def _hold_feet(
        self,
        context: Context,
        joints: Vector,
        estimate: BaseEstimate,
        borne: Vector,
        model: FilterModel,
    ) -> tuple[BaseEstimate, Vector]:
        """Corrects by the feet that bear, and by the ground of those that came to rest.

        Args:
            context: of this System.
            joints: what the port of that name says.
            estimate: carried on to now.
            borne: for how long each foot has borne load, or `LAID`, (2,).
            model: noise of the feet.
        """
        params, slips = self._params, estimate.slips
        left, right = eval_vector(self._bearing, context).tolist()
        bearing = (left > 0.5, right > 0.5)
        estimate = hold_feet(
            estimate, self._foot_poses(context, joints), bearing, model
        )
        borne = borne.copy()
        for i in range(2):
            if not bearing[i] or estimate.slips[i] != slips[i]:
                borne[i] = 0.0
            elif borne[i] != LAID:
                borne[i] += self._period
                plane = eval_vector(self._footholds, context)[4 * i : 4 * i + 4]
                if borne[i] >= params.foothold_time and plane.any():
                    estimate = stand_on(
                        carried(estimate, model),
                        i,
                        plane[:3],
                        float(plane[3]),
                        params.foothold,
                        params.foothold_gate,
                    )
                    borne[i] = LAID
        return estimate, borne

    def _foot_poses(
        self, context: Context, joints: Vector
    ) -> tuple[FootPose, FootPose]:
        scratch = self._scratch(context)
        q: Vector = np.concatenate([self._level, joints[: self._joints_count]])
        self._plant.SetPositions(scratch, q)
        left, right = (
            _foot_pose(foot.EvalPoseInWorld(scratch), self._p_AF) for foot in self._feet
        )
        return left, right

    def _calc_state(self, context: Context, output: BasicVector) -> None:
        now = self._now(context)
        estimate, count = now.estimate, self._joints_count
        joints = eval_vector(self._joints, context)
        ahead = self._params.lead
        R_WB = estimate.R_WB @ exp_rotation(ahead * now.angular_rate)
        v_WB = estimate.v_WB + ahead * now.acceleration
        state = np.concatenate(
            [
                RotationMatrix(R_WB).ToQuaternion().wxyz(),
                estimate.p_WB + 0.5 * ahead * (estimate.v_WB + v_WB),
                joints[:count] + ahead * joints[count:],
                R_WB @ now.angular_rate,
                v_WB,
                joints[count:],
            ]
        )
        set_vector(output, state)

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        now = self._now(context)
        before = read_state(context, self._read)
        heard = now.integrals[0] > before[0]
        silent = 0.0 if heard else now.silent + self._period
        read = np.concatenate(
            [
                now.integrals,
                now.angular_rate,
                now.acceleration,
                [silent, now.was_silent],
                now.borne,
            ]
        )
        estimate = now.estimate
        set_state(discrete, self._memory, pack(estimate))
        set_state(discrete, self._read, read)
        biases = [estimate.gyroscope_bias, estimate.accelerometer_bias]
        set_state(discrete, self._biases, np.concatenate(biases))
        if estimate.ticks == 0:
            set_state(discrete, self._known, pack_known(estimate))
            set_state(discrete, self._deviation, deviations(estimate))
        faults = (*estimate.slips, now.was_silent)
        if estimate.ticks == 0 or now.was_silent > 0.0:
            set_state(discrete, self._faults, np.array(faults))


def _foot_pose(X_BA: object, p_AF: Vector) -> FootPose:
    R_BA: Vector = X_BA.rotation().matrix()  # type: ignore[attr-defined]
    return FootPose(X_BA.translation() + R_BA @ p_AF, R_BA)  # type: ignore[attr-defined]
