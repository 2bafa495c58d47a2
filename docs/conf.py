"""How Sphinx builds the documentation: `sphinx-build -W docs build/docs`."""

import math
from pathlib import Path

from sphinx.application import Sphinx

from footfall.diagrams.judge import falls, ground, rest, rules
from footfall.diagrams.reference.write_reference import write_reference
from footfall.diagrams.sweep.table import SUCCESS

project = "footfall"
author = "The footfall authors"
extensions = ["myst_nb"]
html_theme = "alabaster"
html_theme_options = {"page_width": "1100px", "sidebar_width": "240px"}
exclude_patterns = [
    *("_build", "systems/meanings.md", "systems/scenarios.md", "sweeps", "robots"),
]
# The notebooks are shown with the outputs that they have; the tests run them.
nb_execution_mode = "off"
myst_enable_extensions = ["dollarmath", "substitution"]
myst_heading_anchors = 2
myst_substitutions = {
    "success": f"`{SUCCESS}`",
    "fallen_height": f"{100 * falls.FALLEN_HEIGHT:.0f} %",
    "fallen_tilt": f"{math.degrees(falls.FALLEN_TILT):.0f}°",
    "bears_weight": f"{100 * falls.BEARS_WEIGHT:.0f} %",
    "rest_time": f"{rest.REST_TIME:g} s",
    "rest_bears": f"{100 * rest.BEARS:.0f} %",
    "upright": f"{math.degrees(rest.UPRIGHT):.0f}°",
    "dcm_margin": f"{100 * rest.DCM_MARGIN:g} cm",
    "still": f"{100 * rest.STILL:g} cm/s",
    "above": f"{1e3 * ground.ABOVE:g} mm",
    "deep": f"{1e3 * ground.DEEP:g} mm",
    "sole_on_ground": f"{100 * ground.SOLE_ON_GROUND:.0f} %",
    "goal_distance": f"{100 * rules.GOAL_DISTANCE:g} cm",
    "goal_turn": f"{math.degrees(rules.GOAL_TURN):.0f}°",
    "slip_allowed": f"{100 * rules.SLIP_ALLOWED:g} cm",
}


def setup(app: Sphinx) -> None:
    """Has the pages written that are made from the code."""
    app.connect("builder-inited", _write)


def _write(app: Sphinx) -> None:
    write_reference(Path(app.srcdir) / "systems")
