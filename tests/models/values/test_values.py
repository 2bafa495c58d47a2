"""Values on abstract ports: they compare, stay as they are and have a JSON form."""

import copy
import dataclasses
import inspect
import json

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.values import contact, perceived, planned
from footfall.models.values.feet import FEET, other_foot
from footfall.models.values.perceived import LaserScan, PlaneSegment, Staircase
from footfall.models.values.planned import Footstep, FootstepPlan, TaskStatus
from footfall.models.values.value import Value, pose_from_json, to_json

POSE = RigidTransform(RollPitchYaw(0.1, -0.2, 2.0), np.array([1.0, -2.0, 0.5]))


def plane(height: float = 0.2) -> PlaneSegment:
    """A tread."""
    outline = np.array([[0.0, 0.0, height], [0.3, 0.0, height], [0.0, 0.5, height]])
    return PlaneSegment(
        polygon=outline,
        X_WR=RigidTransform(np.array([0.5, 0.1, height])),
        size=np.array([0.27, 0.5]),
        normal=np.array([0.0, 0.0, 1.0]),
        area=0.135,
        support_count=42,
    )


VALUE_CLASSES = [
    member
    for module in (contact, perceived, planned)
    for _, member in inspect.getmembers(module, inspect.isclass)
    if issubclass(member, Value) and member is not Value
]


@pytest.mark.parametrize("kind", VALUE_CLASSES, ids=lambda kind: kind.__name__)
def test_values_are_frozen_and_documented(kind: type[Value]) -> None:
    """Drake clones state at every event; only the immutable may clone to itself."""
    assert kind.__dataclass_params__.frozen
    assert kind.__doc__
    assert kind.__eq__ is Value.__eq__


def test_equal_values_compare_equal_and_others_do_not() -> None:
    """Arrays, poses and nested tuples are compared element by element."""
    assert Staircase((plane(), plane(0.4))) == Staircase((plane(), plane(0.4)))
    assert Staircase((plane(),)) != Staircase((plane(0.4),))
    assert Staircase((plane(),)) != Staircase((plane(), plane(0.4)))
    assert Footstep("left", POSE, 0) != Footstep("right", POSE, 0)
    assert Footstep("left", POSE, 0) != Footstep("left", POSE.inverse(), 0)
    assert TaskStatus() != Staircase()
    scan = LaserScan(0.1, 0.2, np.array([1.0, np.nan, np.inf]))
    assert scan == dataclasses.replace(scan, ranges=scan.ranges.copy())
    with pytest.raises(TypeError, match="unhashable"):
        hash(scan)


def test_deep_copy_is_the_value_itself() -> None:
    """So that a clone of a context costs nothing."""
    plan = FootstepPlan((Footstep("left", POSE, 0),), "planned")
    assert copy.deepcopy(plan) is plan


def test_json_form_survives_a_file() -> None:
    """Poses come back; what is not finite becomes null, as JSON has no name for it."""
    plan = FootstepPlan((Footstep("left", POSE, 2),), "planned")
    data = json.loads(json.dumps(plan.to_json(), allow_nan=False))
    assert data["status"] == "planned"
    step = data["footsteps"][0]
    assert (step["foot"], step["plane"]) == ("left", 2)
    assert pose_from_json(step["X_WF"]).IsNearlyEqualTo(POSE, 1e-12)
    scan = LaserScan(0.1, 0.2, np.array([1.5, np.nan, np.inf]))
    assert scan.to_json() == {"time": 0.1, "tilt": 0.2, "ranges": [1.5, None, None]}


def test_numpy_scalars_are_plain_numbers() -> None:
    """json.dumps would refuse them."""
    data = to_json({1: (np.float64(0.5), np.int64(3), np.array([[1.0]])), "b": True})
    assert json.dumps(data) == '{"1": [0.5, 3, [[1.0]]], "b": true}'


def test_what_has_no_json_form_is_refused() -> None:
    """By the name of its type."""
    with pytest.raises(TypeError, match="object has no JSON form"):
        to_json([object()])


def test_corners_run_counter_clockwise_about_the_rectangle() -> None:
    """The area by the shoelace formula is positive and that of the rectangle."""
    turned = dataclasses.replace(plane(), X_WR=POSE)
    p_R = np.array(POSE.inverse().multiply(turned.corners().T)).T
    np.testing.assert_allclose(p_R[:, 2], 0.0, atol=1e-12)
    x, y = p_R[:, 0], p_R[:, 1]
    area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    assert area == pytest.approx(0.27 * 0.5)


def test_feet_are_two() -> None:
    """Left, then right, everywhere."""
    assert FEET == ("left", "right")
    assert [other_foot(foot) for foot in FEET] == ["right", "left"]
