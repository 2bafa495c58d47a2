"""Parameters of the choice among postures by what they are predicted to ask."""

import math
from dataclasses import dataclass, field


@dataclass(kw_only=True)
class ChoiceParams:
    """Which postures of climbing are tried, and what rules one out."""

    leans: list[float] = field(default_factory=lambda: [0.3, 0.4, 0.5])
    """Forward pitches of the pelvis that dynamic climbing tries, in order, rad."""
    toe_offs: list[float] = field(default_factory=lambda: [0.7, 0.55])
    """Largest pitches of the rear foot that are tried with each, rad."""
    quasi_static_forwards: list[float] = field(
        default_factory=lambda: [0.12, 0.10, 0.06]
    )
    """How far ahead of the upper ankle the CoM rests in quasi-static climbing, m."""
    quasi_static_heights: list[float] = field(default_factory=lambda: [0.70])
    """How high above the upper tread it is when the rear foot leaves the ground, m."""
    quasi_static_leans: list[float] = field(default_factory=lambda: [0.6, 0.45, 0.75])
    """Forward pitches of the pelvis in quasi-static climbing, rad."""
    quasi_static_toe_offs: list[float] = field(default_factory=lambda: [0.85, 0.6])
    """Pitches of the rear foot in quasi-static climbing, rad."""
    torque_window: float = 0.3
    """Predicted torques are averaged over this in dynamic climbing, s: a servo that is
    at its limit for a moment lets the body sink a little."""
    quasi_static_torque_window: float = 0.1
    """The same in quasi-static climbing, s."""
    torque_share: float = 1.0
    """Share of the effort limits that may be asked."""
    limb_clearance: float = 0.005
    """Least distance of shins, knees and all above to a nosing, m."""
    self_clearance: float = 0.003
    """Least distance of two bodies of the robot that can meet, m: of a thigh that is
    folded before the pelvis little more is left by construction."""
    reach_tolerance: float = 0.015
    """A sole that misses its pose by more is out of reach, m."""
    posture_tolerance: float = 0.55
    """Joints above the legs that stray further from their posture are taken for a sign
    that the legs are too short, rad."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        for name in (
            "leans",
            "toe_offs",
            "quasi_static_forwards",
            "quasi_static_heights",
            "quasi_static_leans",
            "quasi_static_toe_offs",
        ):
            values = getattr(self, name)
            if not values or not all(0.0 <= value < math.inf for value in values):
                raise ValueError(
                    f"{name}: must hold at least one number, none negative, "
                    f"got {values}"
                )
        for name in ("torque_share", "reach_tolerance", "posture_tolerance"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name}: must be positive, got {getattr(self, name)}")
        for name in (
            "torque_window",
            "quasi_static_torque_window",
            "limb_clearance",
            "self_clearance",
        ):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise ValueError(
                    f"{name}: must not be negative, got {getattr(self, name)}"
                )
