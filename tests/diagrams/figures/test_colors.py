"""Colours that all can tell apart, the same wherever they stand for the same."""

import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from footfall.diagrams.figures import colors
from footfall.diagrams.figures.joints_figure import joint_styles

LINEAR_TO_LMS = np.array(
    [[17.8824, 43.5161, 4.11935], [3.45565, 27.1554, 3.86714], [0.0300, 0.1843, 1.4671]]
)
"""Of Vienot, Brettel and Mollon (1999)."""
BLIND = {
    "none": np.eye(3),
    "protanopia": np.array([[0, 2.02344, -2.52581], [0, 1, 0], [0, 0, 1]]),
    "deuteranopia": np.array([[1, 0, 0], [0.494207, 0, 1.24827], [0, 0, 1]]),
}


def seen(color: str, blindness: str) -> np.ndarray:
    """CIE L*a*b* of a colour as it is seen, (3,)."""
    srgb = np.array([int(color[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0
    linear = np.where(srgb > 0.04045, ((srgb + 0.055) / 1.055) ** 2.4, srgb / 12.92)
    lms = BLIND[blindness] @ LINEAR_TO_LMS @ linear
    linear = np.clip(np.linalg.solve(LINEAR_TO_LMS, lms), 0.0, 1.0)
    to_xyz = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    t = to_xyz @ linear / np.array([0.9505, 1.0, 1.089])
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16.0 / 116.0)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


TOGETHER = {
    "sides and quantities": (
        *(*colors.SIDES.values(), colors.COM, colors.DCM, colors.ZMP, colors.WAIST),
    ),
    "stages": (colors.ZMP, colors.WANTED, colors.WAIST, *colors.STAGES),
    "axes": colors.AXES,
    "joints": (*colors.SIDE_JOINTS["left"], *colors.SIDE_JOINTS["right"]),
    "room": (
        *(*colors.SIDES.values(), colors.COM, colors.ZMP, colors.SEEN_THING),
        *(colors.TRUE_THING, colors.GOAL, *colors.TREES.values()),
    ),
    "outcomes": (*colors.OUTCOMES.values(), colors.BLACK),
}
"""Colours that meet in a figure."""


@pytest.mark.parametrize("blindness", BLIND)
@pytest.mark.parametrize("group", TOGETHER)
def test_what_meets_in_a_figure_is_told_apart(group, blindness) -> None:
    """Also by those who do not see red, or green."""
    for first, second in combinations(TOGETHER[group], 2):
        apart = np.linalg.norm(seen(first, blindness) - seen(second, blindness))
        assert apart > 10.0, (first, second, apart)


def test_red_and_green_would_not_be() -> None:
    """The check above can fail."""
    red, green = (seen(color, "deuteranopia") for color in ("#c04000", "#6a7000"))
    assert np.linalg.norm(red - green) < 10.0


def test_colours_are_defined_in_one_place() -> None:
    """But for those of the block diagram, in which nothing of a run is drawn."""
    diagrams = Path(colors.__file__).parents[1]
    homes = {"colors.py", "block_diagram.py"}
    for path in diagrams.rglob("*.py"):
        if path.name not in homes:
            text = path.read_text(encoding="utf-8")
            assert re.findall(r'"#[0-9a-fA-F]{6}"', text) == [], path


def test_joints_have_the_colour_of_their_side() -> None:
    """All different, however many there are."""
    legs = {"left": ("l1", "l2", "l3", "l4"), "right": ("r1",)}
    styles = joint_styles(["l1", "r1", "l2", "arm", "l3", "l4"], legs)
    assert len(set(styles.values())) == len(styles)
    assert styles["l1"] == (colors.SIDES["left"], "-")
    assert styles["l4"] == (colors.SIDES["left"], "--")
    assert styles["r1"] == (colors.SIDES["right"], "-")
    assert styles["arm"][0] in colors.OTHER_JOINTS
