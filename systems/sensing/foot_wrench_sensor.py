"""Force sensors under the feet, and the ZMP that they measure."""

from collections.abc import Mapping, Sequence

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.geometry import GeometryId
from pydrake.math import RigidTransform
from pydrake.multibody.plant import ContactResults, MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.sensing.measured_zmp import measured_zmp
from footfall.systems.timing import timed

_NOTHING: Vector = np.zeros(3)


def sum_wrenches(
    results: ContactResults,
    foot_of: Mapping[int, int],
    X_WF: Sequence[RigidTransform],
) -> Vector:
    """Sum the wrenches of all contacts on each foot, in its sole frame.

    Args:
        results: of one plant step; point contacts and contact surfaces count alike.
        foot_of: which foot each collision geometry of a foot, by its id's value,
            belongs to.
        X_WF: the sole frames.

    Returns:
        Force, then moment about F, in F, a row a foot, (feet, 6), N and Nm.
    """
    wrenches = np.zeros((len(X_WF), 6))

    def add(id_on: GeometryId, point: Vector, force: Vector, moment: Vector) -> None:
        k = foot_of.get(id_on.get_value())
        if k is not None:
            arm = point - X_WF[k].translation()
            wrenches[k, :3] += force
            wrenches[k, 3:] += moment + np.cross(arm, force)

    for i in range(results.num_point_pair_contacts()):
        contact = results.point_pair_contact_info(i)
        pair = contact.point_pair()
        point, on_B = contact.contact_point(), contact.contact_force()
        add(pair.id_A, point, _NOTHING - on_B, _NOTHING)
        add(pair.id_B, point, on_B, _NOTHING)
    for i in range(results.num_hydroelastic_contacts()):
        info = results.hydroelastic_contact_info(i)
        surface, on_M = info.contact_surface(), info.F_Ac_W()
        force, moment = on_M.translational(), on_M.rotational()
        add(surface.id_M(), surface.centroid(), force, moment)
        add(surface.id_N(), surface.centroid(), _NOTHING - force, _NOTHING - moment)
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

    - `contact_results`: of a MultibodyPlant, abstract.
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
        feet = [plant.GetBodyByName(robot.foot_bodies[foot], instance) for foot in FEET]
        self._feet = [foot.index() for foot in feet]
        # An id itself would keep the plant, which gives it, alive.
        self._foot_of = {
            geometry.get_value(): k
            for k, foot in enumerate(feet)
            for geometry in plant.GetCollisionGeometriesForBody(foot)
        }
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
        wrenches = sum_wrenches(results, self._foot_of, self._sole_frames(context))
        set_vector(output, wrenches.ravel())

    def _calc_zmp(self, context: Context, output: BasicVector) -> None:
        wrenches = eval_vector(self._wrenches, context).reshape(2, 6)
        poses = [X.GetAsMatrix4() for X in self._sole_frames(context)]
        set_vector(output, measured_zmp(np.array(poses), wrenches))
