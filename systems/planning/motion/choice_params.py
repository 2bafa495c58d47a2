"""Parameters of the choice among postures by what they are predicted to ask."""

from dataclasses import dataclass

from footfall.models.values.validation import RIGHT_ANGLE, Parameters, number


@dataclass(kw_only=True)
class ChoiceParams(Parameters):
    """Which postures of climbing are tried, and what rules one out."""

    leans: list[float] = number(
        [0.3, 0.4, 0.5], "rad", least=0.0, below=RIGHT_ANGLE, fewest=1
    )
    """Forward pitches of the pelvis that dynamic climbing tries, in order, rad."""
    toe_offs: list[float] = number(
        [0.7, 0.55], "rad", least=0.0, below=RIGHT_ANGLE, fewest=1
    )
    """Largest pitches of the rear foot that are tried with each, rad."""
    quasi_static_forwards: list[float] = number(
        [0.12, 0.10, 0.06], "m", least=0.0, fewest=1
    )
    """How far ahead of the upper ankle the CoM rests in quasi-static climbing, m."""
    quasi_static_heights: list[float] = number([0.70], "m", least=0.0, fewest=1)
    """How high above the upper tread it is when the rear foot leaves the ground, m."""
    quasi_static_leans: list[float] = number(
        [0.6, 0.45, 0.75], "rad", least=0.0, below=RIGHT_ANGLE, fewest=1
    )
    """Forward pitches of the pelvis in quasi-static climbing, rad."""
    quasi_static_toe_offs: list[float] = number(
        [0.85, 0.6], "rad", least=0.0, below=RIGHT_ANGLE, fewest=1
    )
    """Pitches of the rear foot in quasi-static climbing, rad."""
    torque_window: float = number(0.3, "s", least=0.0)
    """Predicted torques are averaged over this in dynamic climbing, s: a servo that is
    at its limit for a moment lets the body sink a little."""
    quasi_static_torque_window: float = number(0.1, "s", least=0.0)
    """The same in quasi-static climbing, s."""
    torque_share: float = number(1.0, above=0.0, most=10.0)
    """Share of the effort limits that may be asked."""
    limb_clearance: float = number(0.005, "m", least=0.0)
    """Least distance of shins, knees and all above to a nosing, m."""
    self_clearance: float = number(0.002, "m", least=0.0)
    """Least distance of two bodies of the robot that can meet, m: of a thigh that is
    folded before the pelvis little more is left by construction."""
    reach_tolerance: float = number(0.015, "m", above=0.0)
    """A sole that misses its pose by more is out of reach, m."""
    posture_tolerance: float = number(0.55, "rad", above=0.0)
    """Joints above the legs that stray further from their posture are taken for a sign
    that the legs are too short, rad."""
