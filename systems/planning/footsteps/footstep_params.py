"""Parameters of the footstep planner."""

from dataclasses import dataclass

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET
from footfall.models.values.validation import RIGHT_ANGLE, Parameters, choice, number


@dataclass(kw_only=True)
class FootstepPlannerParams(Parameters):
    """What the robot can step and how carefully it is to use what it has seen."""

    stance_width: float = number(0.19, "m", above=0.0)
    """Between the two sole frames when standing side by side, m: near the hip spacing,
    so that the legs are upright; by default the robot's `stance_width`."""
    max_stance_width: float = number(0.28, "m", above=0.0)
    """Widest lateral distance between the sole frames in a step, m."""
    sole_gap: float = number(0.03, "m", least=0.0)
    """Least lateral distance between the two soles, m, so that feet never touch."""
    max_step_length: float = number(0.30, "m", above=0.0)
    """Farthest a foot lands ahead of the stance foot on the floor, m; a foot that
    passes the other travels up to twice as far."""
    max_back_step: float = number(0.15, "m", least=0.0)
    """Farthest a foot lands behind the stance foot on the floor, m."""
    max_turn: float = number(0.26, "rad", above=0.0)
    """Largest yaw between a foot and the stance foot, rad (15 deg)."""
    max_approach_steps: int = number(24, least=1, most=1000)
    """An approach that needs more footsteps is refused."""
    lead_foot: str = choice("right", FEET)
    """The foot that goes first up each tread, "left" or "right"; the paper moves the
    right foot first. After an approach it is the foot that did not step last."""

    stand_distance: float = number(0.05, "m", least=0.0)
    """From the toes to the first tread's front edge where the climb starts, m: room
    for the toes to be lifted straight up despite a nosing and the estimate's error."""
    stand_tolerance: float = number(0.015, "m", least=0.0)
    """A foot this near to its place on the stand line need not step again, m."""
    stand_turn_tolerance: float = number(0.035, "rad", least=0.0)
    """The same for its yaw, rad (2 deg)."""
    rescan_distance: float = number(0.5, "m", least=0.0)
    """After a longer approach than this, m, the plan ends on the stand line for a new
    scan, because far treads are seen less well."""
    floor_reach: float = number(0.3, "m", least=0.0)
    """The approach ends at most this far from floor that was seen, m: a robot does not
    see the floor under its own feet and close to the first riser."""

    steps_between_scans: int = number(
        2, least=1, most=1000, shared="task.steps_between_scans"
    )
    """Treads climbed before the plan ends for a new scan: the paper's Sec. 6.4 repeats
    one pair of consecutive steps."""
    max_climb_length: float = number(0.36, "m", above=0.0)
    """Farthest a foot lands ahead of the stance foot when going up a tread, m."""
    max_rise: float = number(0.25, "m", above=0.0)
    """Highest tread above the ground under the feet, m; HRP-4 climbs 24 cm in the
    paper."""
    edge_margin: float = number(0.015, "m", least=0.0)
    """From the sole to the tread's front edge and to the next riser, m. At the riser
    it always holds; at the heel it gives way where the tread is too shallow."""
    side_margin: float = number(0.03, "m", least=0.0)
    """From the soles to the tread's sides, m."""
    landing_depth: float = number(0.45, "m", above=0.0)
    """A tread deeper than this is a landing, m: feet are put near its front edge, and
    walk across it to the next riser."""
    landing_foothold: float = number(0.15, "m", above=0.0)
    """From a landing's front edge to the middle of the sole, m."""
    max_heel_overhang: float = number(0.0, "m", least=0.0)
    """How far the heel may reach out over the tread's estimated front edge where the
    tread is too shallow for the whole sole, m."""
    foothold_bias: float = number(-0.01, "m")
    """Shifts the foothold from the middle of the tread (the paper has 0), m,
    positive towards the next riser; a little back leaves the lifting toes more room."""
    max_tread_turn: float = number(0.175, "rad", least=0.0)
    """Largest yaw between a tread and the staircase, rad (10 deg); more is a spiral."""

    height_tolerance: float = number(0.03, "m", above=0.0)
    """A foot this near in height to a plane stands on it, m; also how much the two
    feet's heights may differ. Above the error of an estimated height (1 cm)."""
    support_reach: float = number(0.3, "m", least=0.0)
    """A foot may be this far beside the rectangle of the tread it stands on, m: the
    robot hides a part of its own tread from the sensor."""
    flat_tolerance: float = number(0.052, "rad", least=0.0, below=RIGHT_ANGLE)
    """Planes that tilt less are stepped on with a level sole, rad (3 deg)."""
    max_slope: float = number(0.175, "rad", least=0.0, below=RIGHT_ANGLE)
    """Planes and soles that tilt more are refused, rad (10 deg)."""

    def validate(self, sole: Sole | None = None) -> None:
        """Checks the fields, and, where a sole is given, that two fit side by side.

        Raises:
            ValueError: naming the field, the reason and what it got.
        """
        super().validate()
        if sole is None:
            return
        narrowest = 2.0 * sole.half_width + self.sole_gap
        if not narrowest <= self.stance_width <= self.max_stance_width:
            raise ValueError(
                f"stance_width: must lie between {narrowest:.3f} m (two half soles and "
                f"the gap) and max_stance_width, got {self.stance_width:g} m"
            )
