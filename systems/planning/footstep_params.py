"""Parameters of the footstep planner."""

import math
from dataclasses import dataclass

from models.robot import Sole
from systems.values import FEET


@dataclass(kw_only=True)
class FootstepPlannerParams:
    """What the robot can step and how carefully it is to use what it has seen."""

    stance_width: float = 0.19
    """Between the two sole frames when standing side by side, m: near the hip spacing,
    so that the legs are upright."""
    max_stance_width: float = 0.28
    """Widest lateral distance between the sole frames in a step, m."""
    sole_gap: float = 0.03
    """Least lateral distance between the two soles, m, so that feet never touch."""
    max_step_length: float = 0.30
    """Farthest a foot lands ahead of the stance foot on the floor, m; a foot that
    passes the other travels up to twice as far."""
    max_back_step: float = 0.15
    """Farthest a foot lands behind the stance foot on the floor, m."""
    max_turn: float = 0.26
    """Largest yaw between a foot and the stance foot, rad (15 deg)."""
    max_approach_steps: int = 24
    """An approach that needs more footsteps is refused."""
    lead_foot: str = "right"
    """The foot that goes first up each tread, "left" or "right"; the paper moves the
    right foot first. After an approach it is the foot that did not step last."""

    stand_distance: float = 0.05
    """From the toes to the first tread's front edge where the climb starts, m: room
    for the toes to be lifted straight up despite a nosing and the estimate's error."""
    stand_tolerance: float = 0.015
    """A foot this near to its place on the stand line need not step again, m."""
    stand_turn_tolerance: float = 0.035
    """The same for its yaw, rad (2 deg)."""
    rescan_distance: float = 0.5
    """After a longer approach than this, m, the plan ends on the stand line for a new
    scan, because far treads are seen less well."""
    floor_reach: float = 0.3
    """The approach ends at most this far from floor that was seen, m: a robot does not
    see the floor under its own feet and close to the first riser."""

    steps_between_scans: int = 2
    """Treads climbed before the plan ends for a new scan: the paper's Sec. 6.4 repeats
    one pair of consecutive steps."""
    max_climb_length: float = 0.36
    """Farthest a foot lands ahead of the stance foot when going up a tread, m."""
    max_rise: float = 0.25
    """Highest tread above the ground under the feet, m; HRP-4 climbs 24 cm in the
    paper."""
    edge_margin: float = 0.015
    """From the sole to the tread's front edge and to the next riser, m. At the riser
    it always holds; at the heel it gives way where the tread is too shallow."""
    side_margin: float = 0.03
    """From the soles to the tread's sides, m."""
    max_heel_overhang: float = 0.0
    """How far the heel may reach out over the tread's estimated front edge where the
    tread is too shallow for the whole sole, m."""
    foothold_bias: float = -0.01
    """Shifts the foothold from the middle of the tread (the paper has 0), m,
    positive towards the next riser; a little back leaves the lifting toes more room."""
    max_tread_turn: float = 0.175
    """Largest yaw between a tread and the staircase, rad (10 deg); more is a spiral."""

    height_tolerance: float = 0.03
    """A foot this near in height to a plane stands on it, m; also how much the two
    feet's heights may differ. Above the error of an estimated height (1 cm)."""
    support_reach: float = 0.3
    """A foot may be this far beside the rectangle of the tread it stands on, m: the
    robot hides a part of its own tread from the sensor."""
    flat_tolerance: float = 0.052
    """Planes that tilt less are stepped on with a level sole, rad (3 deg)."""
    max_slope: float = 0.175
    """Planes and soles that tilt more are refused, rad (10 deg)."""

    def validate(self, sole: Sole | None = None) -> None:
        """Checks the fields, and, where a sole is given, that two fit side by side.

        Raises:
            ValueError: naming the field, the reason and what it got.
        """
        for name in (
            "stance_width",
            "max_stance_width",
            "max_step_length",
            "max_turn",
            "max_climb_length",
            "max_rise",
            "height_tolerance",
        ):
            if not (0.0 < getattr(self, name) < math.inf):
                raise ValueError(f"{name}: must be positive, got {getattr(self, name)}")
        for name in (
            "sole_gap",
            "max_back_step",
            "stand_distance",
            "stand_tolerance",
            "stand_turn_tolerance",
            "rescan_distance",
            "floor_reach",
            "edge_margin",
            "side_margin",
            "max_heel_overhang",
            "max_tread_turn",
            "support_reach",
            "flat_tolerance",
            "max_slope",
        ):
            if not getattr(self, name) >= 0.0:
                raise ValueError(
                    f"{name}: must not be negative, got {getattr(self, name)}"
                )
        for name in ("max_approach_steps", "steps_between_scans"):
            if not getattr(self, name) >= 1:
                raise ValueError(
                    f"{name}: must be at least 1, got {getattr(self, name)}"
                )
        if not math.isfinite(self.foothold_bias):
            raise ValueError(f"foothold_bias: must be finite, got {self.foothold_bias}")
        if self.lead_foot not in FEET:
            raise ValueError(
                f'lead_foot: must be "left" or "right", got {self.lead_foot!r}'
            )
        if sole is None:
            return
        narrowest = 2.0 * sole.half_width + self.sole_gap
        if not narrowest <= self.stance_width <= self.max_stance_width:
            raise ValueError(
                f"stance_width: must lie between {narrowest:.3f} m (two half soles and "
                f"the gap) and max_stance_width, got {self.stance_width}"
            )
