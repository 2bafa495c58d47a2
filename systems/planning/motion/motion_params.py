"""Parameters of a motion: how long its phases last and how the feet and CoM move."""

from dataclasses import dataclass, field

from footfall.models.values.validation import RIGHT_ANGLE, Parameters, number
from footfall.systems.planning.motion.choice_params import ChoiceParams
from footfall.systems.planning.motion.quasi_static_params import QuasiStaticParams
from footfall.systems.planning.motion.swing_trajectory import SwingParams


@dataclass(kw_only=True)
class MotionPlannerParams(Parameters):
    """Timing and shape of walking and climbing.

    A step whose foot changes height by more than `climb_threshold` is a climbing step.
    """

    period: float = number(
        0.005, "s", least=1e-4, most=0.1, shared="parameters.control_period"
    )
    """Sampling of the plan, s; the controllers' period."""
    single_support: float = number(0.70, "s", least=0.05, most=60.0)
    """One foot in the air, level steps, s."""
    double_support: float = number(0.25, "s", least=0.05, most=60.0)
    """Both feet down between level steps, s."""
    climb_single_support: float = number(0.80, "s", least=0.05, most=60.0)
    """One foot in the air, climbing steps, s."""
    climb_double_support: float = number(0.50, "s", least=0.05, most=60.0)
    """Both feet down after a climbing step, s: the rear foot pushes off."""
    climb_threshold: float = number(0.04, "m", above=0.0)
    """A height difference above this makes a step a climbing step, m."""
    lead_in: float = number(0.8, "s", least=0.05, most=60.0)
    """Standing before the first step while the weight shifts, s."""
    lead_out: float = number(0.9, "s", least=0.05, most=60.0)
    """Standing after the last step while the weight comes to the middle, s."""
    com_height: float = number(
        0.85, "m", least=0.3, most=1.5, shared="parameters.com_height"
    )
    """CoM above the ground at mid-stance, m. Higher stretches the knees, lower loads
    them: at 0.80 m level walking needs 100 Nm at the knee, at 0.85 m 60 Nm."""
    knee_margin: float = number(0.15, "rad", least=0.0, most=1.0)
    """How much more than its limit every knee stays bent, rad; the CoM goes as much
    lower as that takes."""
    swing: SwingParams = field(
        default_factory=lambda: SwingParams(
            apex_clearance=0.05, edge_clearance=0.03, retraction=0.01
        )
    )
    """Clearances of the foot in the air."""
    zmp_forward: float = number(0.035, "m")
    """ZMP in single support ahead of the ankle, m: near the middle of the sole, by
    default the robot's `standing_com`."""
    climb_zmp_forward: float = number(0.05, "m")
    """The same while climbing, m: nearer to the knee, which has less to carry."""
    zmp_inward: float = number(0.008, "m", least=0.0)
    """ZMP in single support towards the other foot, m: a shorter way to sway."""
    lean: float = number(0.30, "rad", least=0.0, below=RIGHT_ANGLE)
    """Forward pitch of the pelvis while climbing, rad; brings the CoM over the bent
    knee and takes torque off it."""
    climb_inward: float = number(0.07, "m", least=0.0)
    """How far a climbing foot swings inwards on its way, m: a folded thigh that reaches
    down and outwards under the swaying pelvis would meet it."""
    climb_roll: float = number(0.08, "rad", least=0.0, below=RIGHT_ANGLE)
    """How far the pelvis rolls to raise the hip of a climbing foot, rad; it spreads the
    thigh from the pelvis and leans the trunk over the foot that stands."""
    rise_end: float = number(0.85, least=0.01, most=1.0)
    """Share of a climbing step's single support after which the CoM is up: the earlier,
    the straighter is the knee that carries it and the more must the rear leg push."""
    toe_off_start: float = number(0.45, least=0.0, below=1.0)
    """Share of the double support after which the rear heel lifts: by then the ZMP has
    passed the toe line."""
    toe_strip: float = number(0.01, "m", above=0.0)
    """Length of the strip at the toes that carries once the heel is lifted, m."""
    max_toe_off: float = number(0.7, "rad", least=0.0, below=RIGHT_ANGLE)
    """Largest pitch of the rear foot in toe-off, rad."""
    quasi_static: QuasiStaticParams = field(default_factory=QuasiStaticParams)
    """What is different in quasi-static motion."""
    choice: ChoiceParams = field(default_factory=ChoiceParams)
    """Which `lean` and `max_toe_off` are tried where the motion is predicted."""
