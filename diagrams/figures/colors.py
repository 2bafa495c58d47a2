"""The colours of all figures: one a side, one a quantity, told apart by all.

Those of Okabe and Ito (2008), whom also the colour-blind tell apart, and, where eight
are too few, of Tol's muted set, which is made for the same. What stands for a side, or
for CoM, DCM, ZMP or waist, stands for nothing else; the others do not meet in a figure.
"""

from collections.abc import Mapping
from types import MappingProxyType

from footfall.models.values.feet import Foot

BLACK, WHITE = "#000000", "#ffffff"
ORANGE, SKY, GREEN, YELLOW = "#e69f00", "#56b4e9", "#009e73", "#f0e442"
BLUE, VERMILLION, PURPLE = "#0072b2", "#d55e00", "#cc79a7"
"""Okabe and Ito's."""
INDIGO, TEAL, WINE = "#332288", "#44aa99", "#882255"
"""Tol's."""
DARK_GREY, GREY, LIGHT_GREY, PALE_GREY = "#495057", "#868e96", "#adb5bd", "#dee2e6"

SIDES: Mapping[Foot, str] = MappingProxyType({"left": BLUE, "right": VERMILLION})
SIDE_JOINTS: Mapping[Foot, tuple[str, ...]] = MappingProxyType(
    {"left": (BLUE, SKY, INDIGO), "right": (VERMILLION, ORANGE, WINE)}
)
"""Of several joints of a side, cold left and warm right, each of another lightness."""
OTHER_JOINTS = (GREEN, BLACK, PURPLE)
"""Of joints that are in neither leg."""

COM, DCM, ZMP, WAIST = BLACK, GREEN, PURPLE, SKY
WANTED = BLACK
"""Of what a planner wants, dashed."""
BEFORE = GREY
"""Of what was planned before it was mended."""
STAGES = (ORANGE, INDIGO)
"""Of the ZMP after both stages of the CoM's trajectory generator."""
AXES = (WINE, TEAL, INDIGO)
"""Of x, y and z of W."""
SUPPORT, SUPPORT_EDGE = PALE_GREY, LIGHT_GREY
"""Of what the soles on the ground span."""
STATIC_SUPPORT = SKY
"""Of where the CoM may rest."""
LIMIT = BLACK
"""Of a limit, dashed."""
UNIMPORTANT = "#ced4da"
"""Of what is only there to be seen beside the rest."""

TREAD, TREAD_EDGE = "#c2a06e", "#7a5c2e"
TRUE_THING, SEEN_THING = LIGHT_GREY, WINE
"""Of boxes and obstacles as they stand, and as the robot saw them."""
THING_AS_SEEN = DARK_GREY
"""Of an obstacle beside curves."""
FLOOR = DARK_GREY
WALL = LIGHT_GREY
PATH, GOAL = DARK_GREY, GREEN
TREES: Mapping[str, str] = MappingProxyType({"start_tree": SKY, "goal_tree": ORANGE})
"""Of the two trees that search a room."""
INFEASIBLE, FEASIBLE = BLUE, VERMILLION
"""The paper's blue and red, of maps in which there is no side."""
PLANE_KINDS: Mapping[str, str] = MappingProxyType(
    {"tread": VERMILLION, "other tread": ORANGE, "plane": BLUE, "ground": GREY}
)
"""Of what is found in a cloud, where there is no side either."""

ACTIVITIES: Mapping[str, str] = MappingProxyType(
    {
        "scan": "#e7f5ff",
        "look": "#e7f5ff",
        "plan": "#fff3bf",
        "replan": "#fff3bf",
        "rest": "#e9ecef",
        "stop": "#e9ecef",
    }
)
"""Behind curves, of what the robot does while it does not move."""
PHASES = ("#e7f5ff", "#fff3bf", "#ebfbee")
"""Behind curves, of the phases 1 to 3 of a crossing."""
OUTCOMES: Mapping[str, str] = MappingProxyType(
    {
        "completed": BLUE,
        "infeasible": SKY,
        "failed": ORANGE,
        "fell": VERMILLION,
        "timed_out": PURPLE,
    }
)
"""By what became of a run; others are black."""
