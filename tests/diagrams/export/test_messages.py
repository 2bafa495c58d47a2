"""Messages of Foxglove's schemas: what they say of times, poses and arrows."""

import jsonschema
import numpy as np
import pytest
from pydrake.common.eigen_geometry import Quaternion
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix

from footfall.diagrams.export.messages import (
    PRIMITIVES,
    SCHEMAS,
    Look,
    arrow,
    box,
    lines,
    nanoseconds,
    scene_update,
    signal_schema,
    sphere,
    stamp,
    transforms,
    triangles,
)
from footfall.models.scenes.solids import TriangleMesh

LOOK = Look("red", 0.5)


def test_a_time_is_split() -> None:
    """To the nanosecond; 0.1 s is not 99999999 ns."""
    assert stamp(12.1) == {"sec": 12, "nsec": 100_000_000}
    assert nanoseconds(0.1) == 100_000_000


def test_a_transform_is_from_the_world() -> None:
    """With the quaternion's elements by name."""
    X_WB = RigidTransform(RollPitchYaw(0.0, 0.0, np.pi / 2.0), [1.0, 2.0, 3.0])
    (one,) = transforms(0.5, {"pelvis": X_WB})["transforms"]
    assert (one["parent_frame_id"], one["child_frame_id"]) == ("world", "pelvis")
    assert one["translation"] == {"x": 1.0, "y": 2.0, "z": 3.0}
    turn = one["rotation"]
    assert (turn["w"], turn["z"]) == pytest.approx((np.sqrt(0.5), np.sqrt(0.5)))


def test_an_arrow_points_along_its_vector() -> None:
    """By x of its pose, as Foxglove draws it; none where there is no force."""
    span = np.array([0.0, 3.0, 4.0])
    found = arrow(np.array([1.0, 0.0, 0.0]), span, 0.01, LOOK)
    assert found is not None
    turn = found["pose"]["orientation"]
    R_WA = RotationMatrix(Quaternion([turn[name] for name in "wxyz"]))
    np.testing.assert_allclose(R_WA.matrix()[:, 0], span / 5.0, atol=1e-12)
    assert found["shaft_length"] + found["head_length"] == pytest.approx(5.0)
    assert found["pose"]["position"]["x"] == 1.0
    assert arrow(np.zeros(3), np.zeros(3), 0.01, LOOK) is None


def test_messages_are_of_their_schemas() -> None:
    """Of each kind of primitive that we draw."""
    mesh = TriangleMesh(np.eye(3), np.array([[0, 1, 2]]))
    update = scene_update(
        1.0,
        "all",
        arrows=[arrow(np.zeros(3), np.ones(3), 0.01, LOOK)],
        cubes=[box(RigidTransform(), np.ones(3), LOOK)],
        spheres=[sphere(np.zeros(3), 0.1, LOOK)],
        lines=[lines(np.zeros((2, 2, 3)), 0.01, LOOK)],
        triangles=[triangles(mesh, LOOK)],
    )
    jsonschema.validate(update, SCHEMAS["foxglove.SceneUpdate"])
    (entity,) = update["entities"]
    assert set(PRIMITIVES) <= set(entity)
    assert len(entity["lines"][0]["points"]) == 4
    assert entity["triangles"][0]["indices"] == [0, 1, 2]
    assert entity["cubes"][0]["color"] == {"r": 1.0, "g": 0.0, "b": 0.0, "a": 0.5}
    moved = transforms(1.0, {"pelvis": RigidTransform()})
    jsonschema.validate(moved, SCHEMAS["foxglove.FrameTransforms"])


def test_a_signals_schema_says_units_and_limits() -> None:
    """Where Foxglove and PlotJuggler show a field's description."""
    attrs = {
        "units": {"time": "s", "knee": "N m"},
        "limits": {"knee": (-100.0, 100.0)},
        "frame": "each joint's own",
    }
    schema = signal_schema("plant.net_actuation", attrs)
    assert schema["description"] == "each joint's own"
    knee = schema["properties"]["knee"]
    assert knee["description"] == "[N m], limits -100 to 100"
