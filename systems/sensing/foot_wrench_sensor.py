"""Force sensors under the feet, and the ZMP that they measure."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RollPitchYaw
from pydrake.multibody.plant import ContactResults, MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.cached import declare_cached
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.sensing.measured_zmp import zmp_now
from footfall.systems.timing import timed

_NO_MOMENT: Vector = np.zeros(3)


class _Sum:
    """Force and moment about a point of all contacts on a foot, in W, N and Nm."""

    def __init__(self, about: Vector) -> None:
        self._about: list[float] = about.tolist()
        self.wrench = [0.0] * 6

    def add(self, sign: float, point: Vector, force: Vector, moment: Vector) -> None:
        """Adds a contact; plain numbers take a tenth of the time of arrays of three."""
        (x, y, z), (f_x, f_y, f_z) = point.tolist(), force.tolist()
        m_x, m_y, m_z = moment.tolist()
        x, y, z = x - self._about[0], y - self._about[1], z - self._about[2]
        total = self.wrench
        total[0] += sign * f_x
        total[1] += sign * f_y
        total[2] += sign * f_z
        total[3] += sign * (m_x + y * f_z - z * f_y)
        total[4] += sign * (m_y + z * f_x - x * f_z)
        total[5] += sign * (m_z + x * f_y - y * f_x)


class SoleFrame(NamedTuple):
    """A sole frame F in W."""

    R_WF: Vector
    """(3, 3)."""
    p_WF: Vector
    """(3,), m."""


def sum_wrenches(
    results: ContactResults, foot_of: Mapping[int, int], frames: Sequence[SoleFrame]
) -> Vector:
    """Sum the wrenches of all contacts on each foot, in its sole frame.

    Args:
        results: of one plant step; point contacts and contact surfaces count alike.
        foot_of: which foot each collision geometry of a foot, by its id's value,
            belongs to.
        frames: the sole frames.

    Returns:
        Force, then moment about F, in F, a row a foot, (feet, 6), N and Nm.
    """
    sums = [_Sum(frame.p_WF) for frame in frames]
    for i in range(results.num_point_pair_contacts()):
        contact = results.point_pair_contact_info(i)
        pair = contact.point_pair()
        # The force is that on the second of the pair.
        for geometry, sign in ((pair.id_A, -1.0), (pair.id_B, 1.0)):
            if (k := foot_of.get(geometry.get_value())) is not None:
                force = contact.contact_force()
                sums[k].add(sign, contact.contact_point(), force, _NO_MOMENT)
    for i in range(results.num_hydroelastic_contacts()):
        info = results.hydroelastic_contact_info(i)
        surface = info.contact_surface()
        for geometry, sign in ((surface.id_M(), 1.0), (surface.id_N(), -1.0)):
            if (k := foot_of.get(geometry.get_value())) is not None:
                on_M = info.F_Ac_W()
                force, moment = on_M.translational(), on_M.rotational()
                sums[k].add(sign, surface.centroid(), force, moment)
    wrenches = np.empty((len(frames), 2, 3))
    for wrench, total, frame in zip(wrenches, sums, frames, strict=True):
        np.matmul(np.reshape(total.wrench, (2, 3)), frame.R_WF, out=wrench)
    return wrenches.reshape(-1, 6)


class FootWrenchSensor(LeafSystem):
    """A six-axis force sensor under each sole.

    .. pydrake_system::

        name: FootWrenchSensor
        input_ports:
        - contact_results
        - foot_poses
        output_ports:
        - foot_wrenches
        - zmp

    - `contact_results`: of a MultibodyPlant, abstract.
    - `foot_poses`: sole frames X_WF (x, y, z, roll, pitch, yaw) of the same moment,
      left then right, (12,), m and rad.
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
        # An id itself would keep the plant, which gives it, alive.
        self._foot_of = {
            geometry.get_value(): k
            for k, foot in enumerate(feet)
            for geometry in plant.GetCollisionGeometriesForBody(foot)
        }
        self._results = self.DeclareAbstractInputPort(
            "contact_results", AbstractValue.Make(ContactResults())
        )
        self._poses = self.DeclareVectorInputPort("foot_poses", 12)
        inputs = {self._results.ticket(), self._poses.ticket()}
        self._felt = declare_cached(self, "wrenches", self._calc_felt, inputs)
        for name, size, calc in (
            ("foot_wrenches", 12, self._calc_wrenches),
            ("zmp", 3, self._calc_zmp),
        ):
            self.DeclareVectorOutputPort(
                name, size, timed(self, calc), prerequisites_of_calc=inputs
            )

    def _calc_felt(self, context: Context) -> tuple[list[SoleFrame], Vector]:
        results = eval_abstract(self._results, context, ContactResults)
        poses: list[Vector] = [*eval_vector(self._poses, context).reshape(4, 3)]
        frames = [
            SoleFrame(RollPitchYaw(rpy).ToRotationMatrix().matrix(), p_WF)
            for p_WF, rpy in zip(poses[::2], poses[1::2], strict=True)
        ]
        return frames, sum_wrenches(results, self._foot_of, frames)

    def _calc_wrenches(self, context: Context, output: BasicVector) -> None:
        set_vector(output, self._felt(context)[1].ravel())

    def _calc_zmp(self, context: Context, output: BasicVector) -> None:
        frames, wrenches = self._felt(context)
        set_vector(output, zmp_now(frames, wrenches))
