"""The judge of crossings on made-up motions and boxes."""

import numpy as np
import pytest

from footfall.diagrams.judge.box_clearance import box_distance, crossed, surface_points
from footfall.diagrams.judge.crossing_judge import (
    CrossingEvidence,
    measure_crossing,
    obstacle_map_errors,
)
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.scenes.obstacle import BoxParams
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.obstacle import Obstacle, ObstacleMap
from footfall.models.values.vector import Vector

BOX = BoxParams(name="o", x=1.0, yaw=0.2, size=[0.05, 1.0, 0.15]).solid()


def test_distance_to_a_box() -> None:
    """Above, before, at a corner, inside."""
    p_B = np.array(
        [[0.0, 0.0, 0.105], [-0.065, 0.0, 0.0], [0.055, 0.54, 0.0], [0.0, 0.0, 0.07]]
    )
    p_W: Vector = np.array(BOX.X_WB.multiply(p_B.T)).T
    np.testing.assert_allclose(
        box_distance(p_W, BOX), [0.03, 0.04, 0.05, -0.005], atol=1e-9
    )


def test_surface_points_leave_no_gap() -> None:
    """Every point of a triangle has a neighbour within the spacing."""
    vertices: Vector = np.array([[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.06, 0.02]])
    points = surface_points(vertices, np.array([[0, 1, 2]]), 0.008)
    rng = np.random.default_rng(0)
    u = rng.dirichlet(np.ones(3), 200)
    distance = np.linalg.norm((u @ vertices)[:, None] - points, axis=2).min(axis=1)
    assert distance.max() < 0.008


def test_crossed_means_over_and_beyond() -> None:
    """Not around it, not up to it, not onto it."""
    x = np.linspace(0.0, 2.0, 201)
    straight = np.column_stack([x, np.zeros(201)])
    assert crossed(straight, BOX)
    assert not crossed(straight[:90], BOX)
    assert not crossed(straight[:101], BOX)
    assert not crossed(straight + np.array([0.0, 0.8]), BOX)


def test_the_eyes_errors_are_those_of_the_box_that_was_meant() -> None:
    """Width, height, front and yaw; what is far from every box counts for none."""
    middle = BOX.X_WB.translation()[:2]
    ahead = np.array([np.cos(0.2), np.sin(0.2)])
    seen = Obstacle(middle + 0.003 * ahead, 0.2, 0.06, 0.14, 1.0)
    wall = Obstacle(np.array([4.0, 0.0]), 0.0, 0.2, 1.0, 5.0)
    evidence = CrossingEvidence((BOX,), (), (ObstacleMap((seen, wall), 0.0, "ok"),), ())
    summary = obstacle_map_errors(evidence)
    assert summary["frames"] == 1
    errors = summary["errors"]
    assert isinstance(errors, dict)
    assert errors["max_width_m"] == pytest.approx(0.01)
    assert errors["max_height_m"] == pytest.approx(0.01)
    assert errors["max_front_m"] == pytest.approx(0.002)
    assert errors["max_yaw_deg"] == pytest.approx(0.0, abs=1e-6)


def _two_feet_over(loaded_late: float) -> tuple[TrueMotion, dict[Foot, Vector]]:
    """Left lifts at 1 s and lands at 2 s, right at 3 and 4 s; the load comes later."""
    time: Vector = np.arange(0.0, 6.0, 0.01)
    poses: dict[Foot, Vector] = {}
    forces: dict[Foot, Vector] = {}
    for foot, lift in zip(FEET, (1.0, 3.0), strict=True):
        X: Vector = np.tile(np.eye(4), (len(time), 1, 1))
        X[:, 0, 3] = np.interp(time, [lift, lift + 1.0], [0.8, 1.2])
        force = np.full(len(time), 300.0)
        force[(time >= lift) & (time < lift + 1.0)] = 0.0
        late = (time >= lift + 1.0) & (time < lift + 1.0 + loaded_late)
        force[late] = 50.0
        force[np.argmax(time >= lift + 1.05)] = 400.0 if loaded_late == 0.0 else 50.0
        poses[foot], forces[foot] = X, force
    nothing: Vector = np.zeros((len(time), 3))
    motion = TrueMotion(
        time=time,
        X_WF=poses,
        sole_corners={},
        com=nothing,
        com_velocity=nothing,
        base=nothing,
        torso_up=np.ones(len(time)),
    )
    return motion, forces


@pytest.mark.parametrize("loaded_late", [0.0, 1.5])
def test_phases_end_with_the_touch_down_not_with_the_load(loaded_late: float) -> None:
    """A slow robot loads a foot long after it stands."""
    motion, forces = _two_feet_over(loaded_late)
    found = measure_crossing(motion, forces, forces, 600.0, BOX)
    assert found is not None
    assert found.time == pytest.approx(3.0, abs=0.03)
    assert found.impact == pytest.approx(
        400.0 / 600.0 if loaded_late == 0.0 else 50.0 / 600.0
    )


def test_one_foot_over_is_no_crossing() -> None:
    """The other one stays before the box."""
    motion, forces = _two_feet_over(0.0)
    motion.X_WF["right"][:, 0, 3] = 0.8
    assert measure_crossing(motion, forces, forces, 600.0, BOX) is None


def test_one_foot_over_and_back_is_no_crossing() -> None:
    """Two swings over it by the same foot do not bring the robot beyond."""
    motion, forces = _two_feet_over(0.0)
    there = motion.X_WF["left"][:, 0, 3]
    motion.X_WF["left"][:, 0, 3] = np.where(
        motion.time < 3.0, there, np.interp(motion.time, [3.0, 4.0], [1.2, 0.8])
    )
    forces["left"][(motion.time >= 3.0) & (motion.time < 4.0)] = 0.0
    motion.X_WF["right"][:, 0, 3] = 0.8
    assert measure_crossing(motion, forces, forces, 600.0, BOX) is None


@pytest.mark.parametrize("beside", [0.7, -0.7])
def test_what_is_walked_past_is_not_crossed(beside: float) -> None:
    """The feet come level with it and go on, beyond its end."""
    motion, forces = _two_feet_over(0.0)
    for foot in FEET:
        motion.X_WF[foot][:, 1, 3] = beside
    assert measure_crossing(motion, forces, forces, 600.0, BOX) is None


def test_without_mean_forces_there_is_no_impact() -> None:
    """The time is measured all the same."""
    motion, forces = _two_feet_over(0.0)
    found = measure_crossing(motion, forces, None, 600.0, BOX)
    assert found is not None
    assert found.impact is None
