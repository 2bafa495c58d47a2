"""Force sensors under the feet, and the ZMP that they measure."""

from collections.abc import Sequence

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.multibody.plant import ContactResults, MultibodyPlant
from pydrake.multibody.tree import BodyIndex, ModelInstanceIndex
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from models.robot import RobotModel
from systems.ports import Vector, eval_abstract, eval_vector, set_vector
from systems.sensing.measured_zmp import measured_zmp
from systems.timing import timed
from systems.values import FEET


def sum_wrenches(
    results: ContactResults,
    feet: Sequence[BodyIndex],
    X_WF: Sequence[RigidTransform],
) -> Vector:
    """Wrench of all contacts on each foot, in its sole frame.

    Args:
        results: point contacts of one plant step.
        feet: bodies of the feet.
        X_WF: their sole frames.

    Returns:
        Force, then moment about F, in F, a row a foot, (feet, 6), N and Nm.
    """
    wrenches = np.zeros((len(feet), 6))
    forces: list[list[Vector]] = [[] for _ in feet]
    points: list[list[Vector]] = [[] for _ in feet]
    for i in range(results.num_point_pair_contacts()):
        contact = results.point_pair_contact_info(i)
        # contact_force is the force on body B.
        for body, sign in ((contact.bodyA_index(), -1.0), (contact.bodyB_index(), 1.0)):
            if body in feet:
                k = feet.index(body)
                forces[k].append(sign * np.asarray(contact.contact_force()))
                points[k].append(np.asarray(contact.contact_point()))
    for k, X in enumerate(X_WF):
        if forces[k]:
            force = np.array(forces[k])
            arm = np.array(points[k]) - X.translation()
            wrenches[k, :3] = force.sum(axis=0)
            wrenches[k, 3:] = np.cross(arm, force).sum(axis=0)
    for wrench, X in zip(wrenches, X_WF, strict=True):
        R_FW = X.rotation().matrix().T
        wrench[:3] = R_FW @ wrench[:3]
        wrench[3:] = R_FW @ wrench[3:]
    return wrenches


class FootWrenchSensor(LeafSystem):
    """A six-axis force sensor under each sole.

    .. pydrake_system::

        name: FootWrenchSensor
        input_ports:
        - contact_results
        - body_poses
        output_ports:
        - foot_wrenches
        - zmp

    - `contact_results`: of a MultibodyPlant with point contact, abstract.
    - `body_poses`: of the same plant, abstract list of X_WB.
    - `foot_wrenches`: of the ground on the left and the right foot, each force then
      moment about F, in F, (12,), N and Nm.
    - `zmp`: measured p_WZmp, (3,), m; nan while nothing is felt.
    """

    def __init__(
        self, plant: MultibodyPlant, instance: ModelInstanceIndex, robot: RobotModel
    ) -> None:
        """Declares the ports.

        Args:
            plant: robot and scene, finalised.
            instance: the robot in it.
            robot: its names.
        """
        super().__init__()
        self._feet = [
            plant.GetBodyByName(robot.foot_bodies[foot], instance).index()
            for foot in FEET
        ]
        p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
        self._X_BF = RigidTransform(p_BF)
        self._results = self.DeclareAbstractInputPort(
            "contact_results", AbstractValue.Make(ContactResults())
        )
        self._poses = self.DeclareAbstractInputPort(
            "body_poses", AbstractValue.Make([RigidTransform()])
        )
        inputs = {self._results.ticket(), self._poses.ticket()}
        wrenches = self.DeclareVectorOutputPort(
            "foot_wrenches",
            12,
            timed(self, self._calc_wrenches),
            prerequisites_of_calc=inputs,
        )
        self._wrenches = wrenches
        self.DeclareVectorOutputPort(
            "zmp", 3, timed(self, self._calc_zmp), prerequisites_of_calc=inputs
        )

    def _sole_frames(self, context: Context) -> list[RigidTransform]:
        poses = eval_abstract(self._poses, context, list)
        return [poses[int(body)].multiply(self._X_BF) for body in self._feet]

    def _calc_wrenches(self, context: Context, output: BasicVector) -> None:
        results = eval_abstract(self._results, context, ContactResults)
        wrenches = sum_wrenches(results, self._feet, self._sole_frames(context))
        set_vector(output, wrenches.ravel())

    def _calc_zmp(self, context: Context, output: BasicVector) -> None:
        wrenches = eval_vector(self._wrenches, context).reshape(2, 6)
        poses = [X.GetAsMatrix4() for X in self._sole_frames(context)]
        set_vector(output, measured_zmp(np.array(poses), wrenches))
