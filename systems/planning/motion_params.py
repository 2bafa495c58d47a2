"""Parameters of a motion: how long its phases last and how the feet and CoM move."""

import math
from dataclasses import dataclass, field

from systems.planning.choice_params import ChoiceParams
from systems.planning.quasi_static_params import QuasiStaticParams
from systems.planning.swing_trajectory import SwingParams


@dataclass(kw_only=True)
class MotionPlannerParams:
    """Timing and shape of walking and climbing.

    A step whose foot changes height by more than `climb_threshold` is a climbing step.
    """

    period: float = 0.005
    """Sampling of the plan, s; the controllers' period."""
    single_support: float = 0.70
    """One foot in the air, level steps, s."""
    double_support: float = 0.25
    """Both feet down between level steps, s."""
    climb_single_support: float = 0.80
    """One foot in the air, climbing steps, s."""
    climb_double_support: float = 0.50
    """Both feet down after a climbing step, s: the rear foot pushes off."""
    climb_threshold: float = 0.04
    """A height difference above this makes a step a climbing step, m."""
    lead_in: float = 0.8
    """Standing before the first step while the weight shifts, s."""
    lead_out: float = 0.9
    """Standing after the last step while the weight comes to the middle, s."""
    com_height: float = 0.85
    """CoM above the ground at mid-stance, m. Higher stretches the knees, lower loads
    them: at 0.80 m level walking needs 100 Nm at the knee, at 0.85 m 60 Nm."""
    swing: SwingParams = field(
        default_factory=lambda: SwingParams(
            apex_clearance=0.05, edge_clearance=0.03, retraction=0.01
        )
    )
    """Clearances of the foot in the air."""
    zmp_forward: float = 0.035
    """ZMP in single support ahead of the ankle, m: near the middle of the sole."""
    climb_zmp_forward: float = 0.05
    """The same while climbing, m: nearer to the knee, which has less to carry."""
    zmp_inward: float = 0.008
    """ZMP in single support towards the other foot, m: a shorter way to sway."""
    lean: float = 0.30
    """Forward pitch of the pelvis while climbing, rad; brings the CoM over the bent
    knee and takes torque off it."""
    climb_inward: float = 0.06
    """How far a climbing foot swings inwards on its way, m: a folded thigh that reaches
    down and outwards under the swaying pelvis would meet it."""
    climb_roll: float = 0.08
    """How far the pelvis rolls to raise the hip of a climbing foot, rad; it spreads the
    thigh from the pelvis and leans the trunk over the foot that stands."""
    rise_end: float = 0.85
    """Share of a climbing step's single support after which the CoM is up: the earlier,
    the straighter is the knee that carries it and the more must the rear leg push."""
    toe_off_start: float = 0.45
    """Share of the double support after which the rear heel lifts: by then the ZMP has
    passed the toe line."""
    toe_strip: float = 0.01
    """Length of the strip at the toes that carries once the heel is lifted, m."""
    max_toe_off: float = 0.7
    """Largest pitch of the rear foot in toe-off, rad."""
    quasi_static: QuasiStaticParams = field(default_factory=QuasiStaticParams)
    """What is different in quasi-static motion."""
    choice: ChoiceParams = field(default_factory=ChoiceParams)
    """Which `lean` and `max_toe_off` are tried where the motion is predicted."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        for name in (
            "period",
            "single_support",
            "double_support",
            "climb_single_support",
            "climb_double_support",
            "climb_threshold",
            "lead_in",
            "lead_out",
            "com_height",
            "toe_strip",
        ):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name}: must be positive, got {getattr(self, name)}")
        for name in (
            "zmp_forward",
            "climb_zmp_forward",
            "zmp_inward",
            "lean",
            "climb_inward",
            "climb_roll",
            "max_toe_off",
        ):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise ValueError(
                    f"{name}: must not be negative, got {getattr(self, name)}"
                )
        if not 0.0 < self.rise_end <= 1.0:
            raise ValueError(f"rise_end: must lie in (0, 1], got {self.rise_end}")
        if not 0.0 <= self.toe_off_start < 1.0:
            raise ValueError(
                f"toe_off_start: must lie in [0, 1), got {self.toe_off_start}"
            )
        self.swing.validate()
        self.quasi_static.validate()
        self.choice.validate()
