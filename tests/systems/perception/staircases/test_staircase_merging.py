"""Merging scans of one staircase, part by part."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.perceived import PlaneSegment, PlaneSegmentation, Staircase
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.staircases.staircase_merging import (
    StaircaseMapParams,
    merge_staircase,
)

PARAMS = StaircaseMapParams()
RUN, RISE, WIDTH = 0.28, 0.18, 0.8


def plane(
    x: tuple[float, float],
    z: float,
    *,
    y: tuple[float, float] = (-WIDTH / 2, WIDTH / 2),
    yaw: float = 0.0,
    support: int = 1000,
) -> PlaneSegment:
    """A level rectangle, given in a frame turned by `yaw`."""
    middle = np.array([sum(x) / 2, sum(y) / 2, z])
    rotation = RollPitchYaw(0, 0, yaw).ToRotationMatrix()
    p_WR: Vector = rotation.matrix() @ middle
    size = np.array([x[1] - x[0], y[1] - y[0]])
    made = PlaneSegment(
        polygon=np.zeros((0, 3)),
        X_WR=RigidTransform(rotation, p_WR),
        size=size,
        normal=np.array([0.0, 0.0, 1.0]),
        area=float(np.prod(size)),
        support_count=support,
    )
    return replace(made, polygon=made.corners())


def tread(index: int, **changes: Any) -> PlaneSegment:
    """A tread of a regular flight, perhaps seen in part."""
    x = changes.pop("x", (index * RUN, (index + 1) * RUN))
    z = changes.pop("z", (index + 1) * RISE)
    return plane(x, z, **changes)


def seen(
    *treads: PlaneSegment,
    floor: PlaneSegment | None = None,
    others: tuple[PlaneSegment, ...] = (),
) -> PlaneSegmentation:
    """A segmentation with these treads."""
    floors = () if floor is None else (floor,)
    return PlaneSegmentation(
        planes=(*floors, *treads, *others), staircase=Staircase(treads, floor)
    )


FLOOR = plane((-2.0, 0.0), 0.0, y=(-2.0, 2.0), support=9000)


def test_first_scan_is_taken_as_it_is() -> None:
    """Nothing known: the staircase of the scan; nothing seen: nothing."""
    scan = seen(tread(0), tread(1), floor=FLOOR)
    assert merge_staircase(Staircase(), scan, PARAMS) == scan.staircase
    assert merge_staircase(Staircase(), seen(), PARAMS) == Staircase()


def test_same_scan_again_changes_nothing() -> None:
    """Merging is idempotent."""
    scan = seen(tread(0, yaw=0.1), tread(1, yaw=0.1), floor=FLOOR)
    known = merge_staircase(scan.staircase, scan, PARAMS)
    assert len(known.treads) == 2
    for a, b in zip(known.treads, scan.staircase.treads, strict=True):
        np.testing.assert_allclose(a.corners(), b.corners(), atol=1e-12)
        assert a.support_count == b.support_count


def test_higher_treads_are_added_and_lower_ones_stay() -> None:
    """From the second tread only the third is seen: then all are known."""
    known = Staircase((tread(0), tread(1)), FLOOR)
    merged = merge_staircase(known, seen(tread(2), tread(3)), PARAMS)
    assert merged == Staircase((tread(0), tread(1), tread(2), tread(3)), FLOOR)


def test_two_views_are_averaged_by_support() -> None:
    """Heights and near edges: three times the support counts three times."""
    known = Staircase((tread(0, support=1000),), FLOOR)
    again = tread(0, x=(0.008, RUN + 0.004), z=RISE + 0.004, support=3000)
    (merged,) = merge_staircase(known, seen(again), PARAMS).treads
    corners = merged.corners()
    assert corners[:, 2] == pytest.approx(RISE + 0.003)
    assert corners[[0, 3], 0] == pytest.approx(0.006)
    assert corners[[1, 2], 0] == pytest.approx(RUN + 0.003)
    assert merged.support_count == 3000


def test_hidden_part_does_not_shrink_a_tread() -> None:
    """A view of a part keeps the edges it did not see, averages those it did."""
    known = Staircase((tread(0),), FLOOR)
    part = tread(0, x=(0.12, RUN + 0.002), y=(-0.1, WIDTH / 2), support=1000)
    (merged,) = merge_staircase(known, seen(part), PARAMS).treads
    corners = merged.corners()
    assert corners[[0, 3], 0] == pytest.approx(0.0)
    assert corners[[1, 2], 0] == pytest.approx(RUN + 0.001)
    assert corners[:2, 1] == pytest.approx(-WIDTH / 2)


def test_a_tread_seen_in_part_grows() -> None:
    """The first view was cut off; the next one shows all of it."""
    known = Staircase((tread(0), tread(1, x=(RUN, RUN + 0.1), support=100)), FLOOR)
    merged = merge_staircase(known, seen(tread(1)), PARAMS)
    assert merged.treads[1].corners()[[1, 2], 0] == pytest.approx(2 * RUN)
    outline = merged.treads[1].polygon
    assert np.ptp(outline[:, 0]) == pytest.approx(RUN)


def test_own_tread_as_a_plane_confirms_its_height() -> None:
    """What is seen of the tread underfoot moves its height, not its edges."""
    known = Staircase((tread(0), tread(1)), FLOOR)
    rest = plane((0.2, RUN), RISE + 0.004, support=1000)
    merged = merge_staircase(known, seen(tread(1), floor=rest), PARAMS)
    assert merged.floor == FLOOR
    assert len(merged.treads) == 2
    assert merged.treads[0].corners()[:, 2] == pytest.approx(RISE + 0.002)
    np.testing.assert_allclose(merged.treads[0].size, known.treads[0].size)


@pytest.mark.parametrize(
    "stray",
    [
        tread(2, y=(0.5, 1.3)),
        tread(2, yaw=0.5),
        plane((-0.6, -0.3), 0.54),
        plane((0.6, 0.9), 0.10),
    ],
    ids=["beside", "turned", "before and above", "behind and below"],
)
def test_what_is_not_on_the_flight_is_not_added(stray: PlaneSegment) -> None:
    """A step of another flight stays out."""
    known = Staircase((tread(0), tread(1)), FLOOR)
    assert merge_staircase(known, seen(stray), PARAMS) == known


@pytest.mark.parametrize("depth", [0.42, 0.9, 2.6])
def test_a_landing_or_a_floor_above_is_added(depth: float) -> None:
    """However deep it is: the flight leads up to it."""
    known = Staircase((tread(0), tread(1)), FLOOR)
    top = tread(2, x=(2 * RUN, 2 * RUN + depth))
    assert merge_staircase(known, seen(top), PARAMS).treads == (*known.treads, top)


def test_floor_is_found_later() -> None:
    """A floor that was hidden at first is added; a tread never becomes the floor."""
    known = Staircase((tread(0), tread(1)))
    assert merge_staircase(known, seen(floor=FLOOR), PARAMS).floor == FLOOR
    own = plane((0.2, RUN), RISE)
    assert merge_staircase(known, seen(tread(1), floor=own), PARAMS).floor is None


def test_climbing_a_staircase(scan: Callable[..., Vector], stair_scene: Any) -> None:
    """From the floor and from tread to tread: all treads, all the time right."""
    scene = stair_scene(steps=5, rise=0.17, run=0.28, width=0.9, yaw=0.1)
    segmenter = PlaneSegmenterParams(threads=1)
    known = Staircase()
    gravity = np.array([0.0, 0.0, -9.81])
    for stands_on in range(-1, 4):
        eye = scene.sensor(stands_on)
        cloud = scan(scene, eye, seed=stands_on + 2)
        found, _ = segment_planes(cloud, gravity, segmenter, JVRC1.sole, eye)
        known = merge_staircase(known, found, PARAMS)
        assert len(known.treads) >= min(stands_on + 2, 5)
        for index, step in enumerate(known.treads):
            error = (step.corners() - scene.tread_corners(index)) @ scene.rotation()
            assert np.abs(error[:, 2]).max() < 0.003
            assert np.abs(error[:, :2]).max() < 0.01
    assert len(known.treads) == 5
    assert known.floor is not None
    assert abs(known.floor.X_WR.translation()[2]) < 0.003


@pytest.mark.parametrize("field", ["height_tolerance", "max_turn", "period"])
def test_bad_parameters_are_named(field: str) -> None:
    """The error names the field."""
    params = StaircaseMapParams()
    setattr(params, field, -1.0)
    with pytest.raises(ValueError, match=rf"^{field}: must be .*, got -1 "):
        params.validate()
