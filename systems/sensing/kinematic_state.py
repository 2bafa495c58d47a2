"""Where the robot is: CoM, DCM, feet and pelvis from its measured state."""

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.plant_cache import declare_state_context
from footfall.systems.ports import set_vector
from footfall.systems.timing import timed


class KinematicState(LeafSystem):
    """Forward kinematics of the measured joints and floating base.

    .. pydrake_system::

        name: KinematicState
        input_ports:
        - state
        output_ports:
        - com
        - com_velocity
        - foot_poses

    - `state`: measured positions and velocities, (nq + nv,).
    - `com`: p_WCom, (3,), m.
    - `com_velocity`: v_WCom, (3,), m/s.
    - `foot_poses`: sole frames X_WF (x, y, z, roll, pitch, yaw), left then right,
      (12,), m and rad.
    """

    def __init__(self, plant: MultibodyPlant, robot: RobotModel) -> None:
        """Declares the ports.

        Args:
            plant: the robot alone, finalised.
            robot: its names.
        """
        super().__init__()
        self._plant = plant
        self._feet = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
        p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
        self._X_BF = RigidTransform(p_BF)
        state = self.DeclareVectorInputPort(
            "state", plant.num_positions() + plant.num_velocities()
        )
        self._at_state = declare_state_context(self, plant, state)
        for name, size, calc in (
            ("com", 3, self._calc_com),
            ("com_velocity", 3, self._calc_com_velocity),
            ("foot_poses", 12, self._calc_foot_poses),
        ):
            self.DeclareVectorOutputPort(
                name, size, timed(self, calc), prerequisites_of_calc={state.ticket()}
            )

    def _calc_com(self, context: Context, output: BasicVector) -> None:
        at = self._at_state(context)
        set_vector(output, self._plant.CalcCenterOfMassPositionInWorld(at))

    def _calc_com_velocity(self, context: Context, output: BasicVector) -> None:
        at = self._at_state(context)
        set_vector(output, self._plant.CalcCenterOfMassTranslationalVelocityInWorld(at))

    def _calc_foot_poses(self, context: Context, output: BasicVector) -> None:
        at = self._at_state(context)
        poses = []
        for body in self._feet:
            X_WF = body.EvalPoseInWorld(at).multiply(self._X_BF)
            poses += [X_WF.translation(), RollPitchYaw(X_WF.rotation()).vector()]
        set_vector(output, np.concatenate(poses))
