"""What to look for in each picture of a run or a sweep."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Caption:
    """What stands with a picture."""

    title: str
    text: str
    """What it shows, and what to look for in it."""


CAPTIONS = {
    "film_strip": Caption(
        "Film strip",
        "The robot at moments evenly spread over its motions, seconds from the first "
        "below each; standing scans are left out. Look for soles that are flat where "
        "they stand, knees that are bent, and a trunk that stays upright.",
    ),
    "top_view": Caption(
        "From above",
        "Treads, boxes and where the soles stood, with the paths of the centre of "
        "mass (CoM) and the zero-moment point (ZMP). Each sole should lie whole on a "
        "tread and clear of edges; the ZMP should jump from sole to sole, and the "
        "CoM swing less than it does.",
    ),
    "side_view": Caption(
        "From the side",
        "Paths of toes (solid) and heels (dotted) over the profile of the stairs; "
        "thick where a sole stood. Look at the gap between a path and the edge that "
        "it passes: the least one is `min_clearance_m`.",
    ),
    "balance": Caption(
        "Balance",
        "CoM, ZMP and divergent component of motion (DCM) along x and y; dashed is "
        "what the controller wanted, the grey band is what the soles on the ground "
        "span. The ZMP must stay inside the band, and at its edge the sole is about to "
        "tip. Below, the CoM's height, and how far the DCM was from the wanted one: "
        "where that grows and does not come back, balance is lost. Its peak is "
        "`max_dcm_error_m`.",
    ),
    "static_stability": Caption(
        "Static stability",
        "Where the CoM could rest on the soles that bear weight, one polygon after "
        "the other, and where it truly went (the stair paper's Fig. 7). A quasi- "
        "static motion stays inside the present polygon; a dynamic one cuts corners, "
        "and `min_static_margin_m` says by how much.",
    ),
    "feet": Caption(
        "Feet",
        "Height of each sole's lowest corner, with the treads as lines, and the "
        "normal force on each foot. A landing is a rise of force without a spike: a "
        "spike above one body weight is an impact. While one foot is up the other "
        "bears it all.",
    ),
    "joints": Caption(
        "Joints",
        "Torque and speed of every joint over its limit; the joints that came "
        "nearest to a limit are coloured, with their peak in the legend. A torque "
        "that stays at 1 is clipped: the robot is at the end of its strength there.",
    ),
    "estimate": Caption(
        "What the robot knew of itself",
        "Estimate less truth of the pelvis, with twice the filter's own deviation "
        "dotted. Errors within the dotted lines were expected; place and yaw drift, "
        "as nothing corrects them, and short spikes of velocity are feet that land.",
    ),
    "fig5_stick_diagram": Caption(
        "Crossing as a stick diagram",
        "The legs at even times while they step over the obstacle (the obstacle "
        "paper's Fig. 5). No line may touch the obstacle; look at the shank and the "
        "heel of the second leg, which pass it last.",
    ),
    "fig7_adaptation": Caption(
        "Adaptation of the motion",
        "Waist and second foot before and after the planner adapted them, and as "
        "they truly moved (the obstacle paper's Fig. 7). True and planned curves "
        "should lie on each other.",
    ),
    "fig8_ahead": Caption(
        "Crossing, ahead",
        "ZMP, waist, feet and pitch in the walking direction (the obstacle paper's "
        "Fig. 8), with the ZMP's error magnified. The measured ZMP should follow the "
        "desired one; peaks at phase changes are landings.",
    ),
    "fig9_sideways": Caption(
        "Crossing, sideways",
        "The same across the walking direction (the obstacle paper's Fig. 9). The "
        "ZMP should be inside the stance foot while the other is over the obstacle.",
    ),
}
"""By the picture's name without its ending."""
OVER_TIME = ("balance", "feet", "joints", "estimate")
"""Pictures with an axis of time in which standing is folded."""
FOLDED = "Where the robot stands still for long, time is folded (hatched)."
SUCCESS_CAPTION = Caption(
    "Success by {}",
    "Success rate of each group with Wilson's 95 % interval, and successes over "
    "runs. Where intervals overlap much the runs do not tell the groups apart.",
)
"""Of a sweep, over one field."""
OUTCOMES_CAPTION = Caption(
    "Outcomes over {}",
    "Every run where its two fields lie, by outcome; hollow where it has no result. "
    "Look for the border between what succeeds and what does not.",
)
"""Of a sweep, over two fields."""
