"""Fig. 5 shows the true legs against the true obstacle."""

import numpy as np
import pytest
from matplotlib.patches import Polygon, Rectangle

from footfall.diagrams.figures.crossing_data import read_crossings
from footfall.diagrams.figures.stick_diagram import STICKS, leg_sticks, stick_diagram
from footfall.diagrams.run_data import read_run_data
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.systems.planning.whole_body.whole_body_plan import planning_body


@pytest.fixture(scope="module")
def crossing(crossed_folder):
    """The crossing of the run over 15 cm."""
    return read_crossings(read_run_data(crossed_folder))


@pytest.fixture(scope="module")
def axes(crossing):
    """Phase 1, key configuration, phase 3."""
    return stick_diagram(crossing).axes


def test_the_obstacle_is_drawn_as_it_is_and_as_seen_with_its_margins(
    crossing, axes
) -> None:
    """In every panel."""
    (obstacle,) = crossing.plans[0].obstacles
    margins = crossing.data.run.scenario.parameters.crossing.feasibility
    for ax in axes:
        true, seen, inflated = (p for p in ax.patches if isinstance(p, Rectangle))
        assert (true.get_width(), true.get_height()) == pytest.approx((0.05, 0.15))
        assert seen.get_width() == pytest.approx(obstacle.width)
        assert inflated.get_height() == pytest.approx(obstacle.height + margins.s_h)
        assert inflated.get_width() == pytest.approx(obstacle.width + 2 * margins.s_w)
        middle = seen.get_x() + seen.get_width() / 2.0
        assert middle == pytest.approx(obstacle.center[0] - 1.2, abs=1e-6)


def test_sticks_are_the_true_leg(crossing) -> None:
    """Ankle over the sole, the lengths of thigh and shank, heel and toe on the sole."""
    plant = robot_alone(JVRC1)
    leg = planning_body(JVRC1, plant).leg
    rows = [0, len(crossing.data.state) // 2]
    sticks = leg_sticks(crossing.data, plant, leg.outline, "left", rows)
    hip, knee, ankle = (sticks.chain[:, i] for i in range(3))
    np.testing.assert_allclose(
        np.linalg.norm(knee - hip, axis=1), np.linalg.norm(leg.thigh), atol=1e-9
    )
    np.testing.assert_allclose(
        np.linalg.norm(ankle - knee, axis=1), np.linalg.norm(leg.shank), atol=1e-9
    )
    X_WF = crossing.data.motion.X_WF["left"][rows]
    height = JVRC1.sole.ankle_height * X_WF[:, :3, 2]
    np.testing.assert_allclose(ankle, X_WF[:, :3, 3] + height, atol=1e-9)
    assert np.abs(sticks.chain[0, 3:, 2]).max() < 0.01
    assert sticks.outline.shape == (2, 8, 3)


def test_the_nearest_outline_agrees_with_the_judge(crossing, axes) -> None:
    """The least of both legs is about the clearance of the meshes."""
    least = min(
        float(axes[k].get_title().split("stays ")[1].split(" mm")[0]) for k in (0, 2)
    )
    said = 1e3 * crossing.data.run.summary["min_clearance_m"]
    assert least == pytest.approx(said, abs=3.0)
    for k in (0, 2):
        (outline,) = (p for p in axes[k].patches if isinstance(p, Polygon))
        corners = outline.get_xy()
        away = np.maximum(np.abs(corners) - [0.025, 0.15], 0.0)
        assert np.linalg.norm(away, axis=1).min() > 0.03


def test_phases_1_and_3_have_their_sticks(axes) -> None:
    """From before the obstacle to beyond it."""
    for k in (0, 2):
        sticks = [line for line in axes[k].get_lines() if line.get_marker() == "."]
        chains = [np.array(line.get_data()) for line in sticks if len(line.get_xdata())]
        assert len(chains) == STICKS
        ankles = [chain[0, 2] for chain in chains]
        assert ankles[0] < -0.1
        assert ankles[-1] > 0.1


def test_the_key_configuration_is_measured_from_the_rear_ankle(crossing, axes) -> None:
    """X_ads as planned is the true distance of the ankles."""
    chains = [
        np.array(line.get_data())
        for line in axes[1].get_lines()
        if line.get_marker() == "."
    ]
    ankles = sorted(chain[0, 2] for chain in chains)
    key = crossing.plans[0].keys[0]
    assert ankles[1] - ankles[0] == pytest.approx(key.X_ads, abs=0.01)
    (circle,) = (line for line in axes[1].get_lines() if line.get_marker() == "o")
    (x,), (z,) = circle.get_data()
    assert x - ankles[0] == pytest.approx(key.X_hds)
    assert z == pytest.approx(key.Z_hds)
