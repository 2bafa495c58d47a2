"""Parameters of a crossing: its timing, shape and margins."""

from dataclasses import dataclass, field, replace

from footfall.models.values.validation import RIGHT_ANGLE, Parameters, choice, number
from footfall.systems.planning.crossing.com_trajectory_generator import (
    FILTER_FORMS,
    FORMS,
)
from footfall.systems.planning.crossing.feasibility_unit import FeasibilityParams
from footfall.systems.planning.crossing.foot_trajectory_generator import (
    FootTrajectoryParams,
)
from footfall.systems.planning.crossing.quasi_static_unit import (
    QuasiStaticCrossingParams,
)
from footfall.systems.planning.motion.motion_params import MotionPlannerParams

"""How a robot crosses: with a moving ZMP, or with the CoM always over what stands."""


@dataclass(kw_only=True)
class HighCrossingParams(Parameters):
    """What is different over an obstacle that the first way of crossing cannot do.

    The knees are the limit: smaller margins make the step shorter, a turned waist and
    arms to the front let both legs reach farther, and straighter knees carry more.
    """

    single_support: float = number(1.5, "s", least=0.05, most=60.0)
    """Phases 1 and 3, s."""
    double_support: float = number(0.14, "s", least=0.05, most=60.0)
    """Phase 2, s."""
    lean: float = number(0.1, "rad", least=0.0, below=RIGHT_ANGLE)
    """Forward pitch of the pelvis, rad."""
    waist_yaw: float = number(0.3, "rad", least=0.0, below=RIGHT_ANGLE)
    """Turn of the waist in phase 2, rad."""
    arm_swing: float = number(-0.3, "rad")
    """How far the shoulders pitch back in phase 1, rad: to the front."""
    knee_margin: float = number(0.15, "rad", least=0.0)
    """How far the knees keep off their straightest, rad."""
    inward: float = number(0.09, "m", least=0.0)
    """How far the foot over the obstacle is drawn towards the other one, m."""
    margins: list[float] = number([0.038, 0.03], "m", least=0.0)
    """s_w and s_h, m, tried in this order: the paper's own last, when the knees ask for
    the shorter step; what the eyes and the feet err comes off them."""
    waist_roll: float = number(0.10, "rad", least=0.0, below=RIGHT_ANGLE)
    """How far the pelvis rolls to raise the hip of the foot over the obstacle, rad."""
    min_gap: float = number(0.025, "m", least=0.0)
    """Least distance of the legs to the obstacle as it was seen, m."""
    lead_pitch: float = number(0.2, "rad", above=-RIGHT_ANGLE, below=RIGHT_ANGLE)
    """Pitch of the first foot over the obstacle, rad."""
    trail_pitch: float = number(0.6, "rad", above=-RIGHT_ANGLE, below=RIGHT_ANGLE)
    """Pitch of the second foot while it rises, rad."""
    over_share: float = number(0.9, least=0.0, most=1.0)
    """Share of that pitch that is left in the middle over the obstacle."""


@dataclass(kw_only=True)
class CrossingParams(Parameters):
    """How obstacles are stepped over, besides how the robot walks."""

    feasibility: FeasibilityParams = field(default_factory=FeasibilityParams)
    """Of the feasibility unit."""
    feet: FootTrajectoryParams = field(default_factory=FootTrajectoryParams)
    """Of the feet trajectory generator."""
    quasi_static: QuasiStaticCrossingParams = field(
        default_factory=QuasiStaticCrossingParams
    )
    """What is different in a quasi-static crossing."""
    high: HighCrossingParams = field(default_factory=HighCrossingParams)
    """What is different over an obstacle that the robot cannot cross otherwise."""
    single_support: float = number(1.3, "s", least=0.05, most=60.0)
    """Phases 1 and 3, s (obstacle paper, Sec. V: 1.5)."""
    double_support: float = number(0.20, "s", least=0.05, most=60.0)
    """Phase 2 and the double supports before and after, s (obstacle paper: 0.04)."""
    zmp_forward: float = number(0.04, "m", least=0.0)
    """ZMP ahead of the stance ankle in phases 1 and 3, m: nearer to the bent knee,
    which has less to carry."""
    zmp_rolling: float = number(0.05, "m")
    """How far the ZMP moves on towards the toes in phase 1, m: the waist is then
    farther ahead when the first foot lands, and the rear knee has less to carry."""
    zmp_rounding: float = number(0.045, "s", least=0.0, most=1.0)
    """Over how long the corners of the desired ZMP are rounded, s."""
    waist_share: float = number(0.6, least=0.01, most=1.0)
    """Share of phase 1, its last, in which the waist is lowered, and of phase 3, its
    first, in which it is raised; the paper takes the whole phases, but a leg that is
    folded over a high obstacle wants the waist high."""
    waist_yaw: float = number(0.2, "rad", least=0.0, below=RIGHT_ANGLE)
    """Turn of the waist in phase 2 that takes the front foot's hip ahead, rad: both
    legs reach farther, the waist stays higher, and over 25 cm the legs keep 3 cm off
    the obstacle in place of 2."""
    arm_swing: float = number(0.0, "rad")
    """How far the shoulders pitch back in phase 1, rad, negative for forward. Back
    takes the waist forward (obstacle paper, against a swing leg that over-stretches in
    phase 1); here it is the rear leg in phase 2 that is stretched most, and 0.3 rad
    stretch its knee by another 0.08 rad."""
    lean: float = number(0.0, "rad", least=0.0, below=RIGHT_ANGLE)
    """Forward pitch of the pelvis while crossing, rad."""
    inward: float = number(0.09, "m", least=0.0)
    """How far the foot over the obstacle is drawn towards the other one, m: the waist
    sways to that side, and a folded leg that hangs outwards rolls its hip too far."""
    waist_roll: float = number(0.05, "rad", least=0.0, below=RIGHT_ANGLE)
    """How far the pelvis rolls to raise the hip of the foot over the obstacle, rad; it
    spreads the folded thigh from the pelvis."""
    sampling: float = number(0.010, "s", least=1e-3, most=1.0)
    """Of the whole-body motion that is planned, s; a multiple of the plan's period.
    Looked at every 5 ms the ZMP over 25 cm errs by 10 mm at most, with 15 ms by 13."""
    cwtg1: str = choice("exact", FORMS)
    """Form of CWTG1: "preview" (Kajita), "window" (Eqs. 16 to 18), or "exact", which
    knows that the height varies."""
    cwtg2: str = choice("exact", FILTER_FORMS)
    """Form of CWTG2: "preview" is the published second preview of Eq. 19, "exact" knows
    the height of the CoM and the whole plan. Over 15 x 5 cm both leave 4 mm of the
    ZMP's error; the preview wants two previews of rest before the first step, which a
    plan does not have, and the DCM errs by 28 mm at its start instead of 4."""
    filter_stages: int = number(2, least=0, most=10)
    """How often the dynamic filter (CWTG2) is applied. The paper applies it once; the
    second time takes most of what the first leaves (20 mm become 5 mm)."""
    min_gap: float = number(0.033, "m", least=0.0)
    """Least distance of the legs to the obstacle as it was seen for a motion to be
    carried out, m: the paper's 3 cm and some millimetres of tracking error."""
    min_self_distance: float = number(0.003, "m", least=0.0)
    """Least distance of two bodies of the robot that can meet, m."""
    max_foot_shortfall: float = number(0.003, "m", least=0.0)
    """Most that an ankle of the planned motion may be out of reach, m; the IK makes
    that up in height."""
    min_limit_distance: float = number(0.02, "rad", least=0.0)
    """Least distance of the legs' joints to their limits, rad: as much as the IK that
    tracks the plan keeps itself."""
    max_zmp_error: float = number(0.05, "m", above=0.0)
    """Most that the multibody ZMP may leave its reference after CWTG2, m: the sole
    reaches about as far to either side of it."""
    max_torque: float = number(1.0, above=0.0, most=10.0)
    """Largest share of a joint's effort limit that single support may take in the plan:
    up to 1.02 the robot passed, from 1.09 on it fell."""
    knee_margin: float = number(0.25, "rad", least=0.0)
    """How far the knees keep off their straightest, rad: nearer to it they race."""
    fold_margin: float = number(0.06, "rad", least=0.0)
    """How far the knees keep off their most bent, rad."""
    max_repairs: int = number(12, least=0, most=1000)
    """Repairs of each kind that the feet adaptor tries."""


def ways_of_crossing(crossing: CrossingParams) -> tuple[CrossingParams, ...]:
    """The crossing as it is, then in the ways of `crossing.high`."""
    high = crossing.high
    ways = [
        replace(
            crossing,
            feasibility=replace(crossing.feasibility, s_w=margin, s_h=margin),
            feet=replace(
                crossing.feet,
                lead_pitch=high.lead_pitch,
                trail_pitch=high.trail_pitch,
                over_share=high.over_share,
            ),
            single_support=high.single_support,
            double_support=high.double_support,
            lean=high.lean,
            waist_yaw=high.waist_yaw,
            waist_roll=high.waist_roll,
            arm_swing=high.arm_swing,
            inward=high.inward,
            knee_margin=high.knee_margin,
            min_gap=high.min_gap,
        )
        for margin in high.margins
    ]
    return (crossing, *ways)


def slowed(
    walking: MotionPlannerParams, crossing: CrossingParams
) -> tuple[MotionPlannerParams, CrossingParams]:
    """The same walk and crossing at the pace of `crossing.quasi_static`."""
    quasi = crossing.quasi_static
    return replace(
        walking,
        single_support=quasi.walk_single_support,
        double_support=quasi.walk_double_support,
        lead_in=quasi.walk_double_support,
        lead_out=quasi.walk_double_support,
    ), replace(
        crossing,
        single_support=quasi.single_support,
        double_support=quasi.double_support,
        zmp_forward=quasi.com_end,
        zmp_rolling=quasi.com_begin - quasi.com_end,
        lean=quasi.lean,
        arm_swing=-quasi.arms,
        waist_yaw=0.0,
        waist_roll=quasi.waist_roll,
        knee_margin=quasi.knee_margin,
        sampling=quasi.sampling,
    )
