"""The limits of a robot's joints, by the columns of the signals that are about them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex

ColumnLimits: TypeAlias = Mapping[str, tuple[float, float]]
"""Least and most by column, in the column's unit."""
STATE_SUFFIXES = ("_q", "_w")
"""What Drake appends to a joint's name to name its position and its velocity."""


@dataclass(frozen=True)
class JointLimits:
    """The limits of the joints that have motors, by the joints' names."""

    position: ColumnLimits
    """rad; of a joint without a range it is missing."""
    speed: ColumnLimits
    """rad/s."""
    torque: ColumnLimits
    """Nm."""

    def of_columns(self, columns: Sequence[str], units: Sequence[str]) -> ColumnLimits:
        """Finds the limits of a signal's columns; those of no joint have none.

        Args:
            columns: their names, "JOINT", or "JOINT_q" and "JOINT_w" of a state.
            units: of each, which say whether it is an angle, a speed or a torque.
        """
        by_unit = {"rad": self.position, "rad/s": self.speed, "N m": self.torque}
        found = {}
        for column, unit in zip(columns, units, strict=True):
            joint = column[:-2] if column.endswith(STATE_SUFFIXES) else column
            limits = by_unit.get(unit, {}).get(joint)
            if limits is not None:
                found[column] = limits
        return found


def joint_limits(plant: MultibodyPlant, instance: ModelInstanceIndex) -> JointLimits:
    """Reads the limits of a robot's joints.

    Args:
        plant: the finalised plant.
        instance: the robot in it.
    """
    position, speed, torque = {}, {}, {}
    for index in plant.GetJointActuatorIndices(instance):
        actuator = plant.get_joint_actuator(index)
        joint, name = actuator.joint(), actuator.joint().name()
        low, high = joint.position_lower_limits()[0], joint.position_upper_limits()[0]
        if math.isfinite(low) and math.isfinite(high):
            position[name] = (float(low), float(high))
        speed[name] = (
            float(joint.velocity_lower_limits()[0]),
            float(joint.velocity_upper_limits()[0]),
        )
        torque[name] = (-actuator.effort_limit(), actuator.effort_limit())
    return JointLimits(position, speed, torque)
