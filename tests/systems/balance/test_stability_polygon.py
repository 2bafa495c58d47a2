"""Stability polygons: reference stances, two methods, closed forms, odd stances."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
from scipy.optimize import linprog
from shapely import MultiPoint

from footfall.systems.balance import (
    gravito_inertial_cone as gravito_inertial_cone_module,
)
from footfall.systems.balance import stability_polygon
from footfall.systems.balance.contact_wrench_cone import (
    Contact,
    point_contact,
    stance_generators,
)
from footfall.systems.balance.convex_polygon import (
    area,
    hausdorff_distance,
    signed_margin,
)
from footfall.systems.balance.gravito_inertial_cone import gravito_inertial_cone
from footfall.systems.balance.stability_polygon import (
    HALF_SIDE,
    Method,
    required_friction,
    robust_polygon,
    static_polygon,
    zmp_support_area,
)
from footfall.systems.balance.zmp_preview import GRAVITY

RandomStance = Callable[[np.random.Generator], list[Contact]]
DATA = Path(
    os.environ.get("FOOTFALL_DATA", Path(__file__).parents[3].parent / "shared/data")
)
METHODS: tuple[Method, ...] = ("section", "double_description", "projection")


def foot(
    x: float, y: float, z: float, *rpy: float, mu: float = 0.7, yaw: float = 0.0
) -> Contact:
    """A sole of 24 x 14 cm."""
    angles = RollPitchYaw(*rpy) if rpy else RollPitchYaw(0.0, 0.0, yaw)
    return Contact(RigidTransform(angles, [x, y, z]), 0.12, 0.07, mu)


def hull(contacts: list[Contact]) -> np.ndarray:
    """The soles' convex hull in the plane, counter-clockwise."""
    corners = np.vstack([contact.corners()[:, :2] for contact in contacts])
    polygon = np.array(MultiPoint(corners).convex_hull.exterior.coords)[:-1]
    return polygon if area(polygon) > 0.0 else polygon[::-1]


LEVEL = [foot(0.0, 0.1, 0.0, yaw=0.3), foot(0.25, -0.1, 0.0, yaw=-0.2)]
TILTED = [foot(0.0, 0.1, 0.0, 0.1, -0.2, 0.3), foot(0.25, -0.1, 0.2, -0.2, 0.3, 0.0)]


def reachable(contacts: list[Contact], com: np.ndarray, acceleration: list) -> bool:
    """Whether contact forces give a CoM this acceleration: one linear programme."""
    G = stance_generators(contacts)
    force = np.array([0.0, 0.0, GRAVITY]) + acceleration
    wrench = np.concatenate([force, np.cross(com, force)]) / GRAVITY
    scale = np.linalg.norm(G, axis=0)
    result = linprog(np.ones(G.shape[1]), A_eq=G / scale, b_eq=wrench)
    return bool(result.status == 0)


@pytest.mark.parametrize("method", METHODS)
def test_reference_stances(method: Method) -> None:
    """The project's six reference polygons, within 1e-6 m, by every method."""
    path = DATA / "static_polygons.json"
    if not path.exists():
        pytest.skip(f"no {path.name} in FOOTFALL_DATA")
    stances = json.loads(path.read_text())["stances"]
    assert len(stances) == 6
    for stance in stances:
        contacts = [
            Contact(
                RigidTransform(
                    RotationMatrix(np.array(c["rotation"])), np.array(c["position"])
                ),
                c["X"],
                c["Y"],
                c["mu"],
            )
            for c in stance["contacts"]
        ]
        expected = np.array(stance["polygon_xy_ccw"]).reshape(-1, 2)
        polygon = static_polygon(contacts, method)
        assert polygon.method == method
        assert not polygon.caught
        assert (polygon.status == "ok") == stance["feasible"], stance["name"]
        assert hausdorff_distance(polygon.vertices, expected) < 1e-6, stance["name"]
        assert len(polygon.vertices) == len(expected)


def test_the_methods_agree_on_random_stances(random_stance: RandomStance) -> None:
    """Feet, fists and points at up to 40 deg, within 1e-4 m on every one."""
    rng = np.random.default_rng(11)
    standing = 0
    for _ in range(60):
        contacts = random_stance(rng)
        walked, by_cone, by_lp = (static_polygon(contacts, m) for m in METHODS)
        assert walked.status == by_cone.status == by_lp.status
        assert hausdorff_distance(walked.vertices, by_lp.vertices) < 1e-4
        assert hausdorff_distance(by_cone.vertices, by_lp.vertices) < 1e-4
        standing += walked.status == "ok"
        # Nothing but a polygon without an interior needs another method.
        assert walked.method == "section" or walked.status != "ok"
    assert standing > 40


def too_few(rows: np.ndarray) -> np.ndarray:
    """Rows without those that bound the polygon on one side."""
    return rows[rows[:, 4] > -0.5 * np.abs(rows[:, 4]).max()]


def too_tight(rows: np.ndarray) -> np.ndarray:
    """Rows of which one cuts off what contacts can do."""
    turned = rows.copy()
    turned[0, 2] += 1e-4
    return turned / np.linalg.norm(turned, axis=1)[:, None]


@pytest.mark.parametrize("spoil", [too_few, too_tight])
def test_an_answer_that_is_wrong_is_caught(
    monkeypatch: pytest.MonkeyPatch, spoil: Callable[[np.ndarray], np.ndarray]
) -> None:
    """Polygons too large or too small are refused, and the next method is asked."""
    right = static_polygon(TILTED)
    assert right.method == "section"
    assert not right.caught
    true_rows, true_cdd = (
        stability_polygon.section_rows,
        gravito_inertial_cone_module._double_description,
    )
    monkeypatch.setattr(
        stability_polygon, "section_rows", lambda G, part: spoil(true_rows(G, part))
    )
    mended = static_polygon(TILTED)
    assert mended.caught
    assert mended.method == "double_description"
    assert hausdorff_distance(mended.vertices, right.vertices) < 1e-7

    def spoilt(rays: np.ndarray) -> np.ndarray:
        rows = true_cdd(rays)
        facing = rows @ [0.0, 0.0, 0.0, 0.0, -1.0, 0.0]
        return spoil(rows[np.argsort(-facing)])

    monkeypatch.setattr(gravito_inertial_cone_module, "_double_description", spoilt)
    methods: tuple[Method, ...] = ("section", "double_description")
    for method in methods:
        mended = static_polygon(TILTED, method)
        assert mended.caught
        assert mended.method == "projection"
        assert hausdorff_distance(mended.vertices, right.vertices) < 1e-7


def test_the_cone_is_that_of_the_generators() -> None:
    """Its rows hold for what contacts exert, and no other wrench passes all."""
    cone = gravito_inertial_cone(TILTED)
    rows = cone.about(np.zeros(3))
    G = stance_generators(TILTED)
    assert (rows @ G).max() < 1e-9
    rng = np.random.default_rng(5)
    inside = 0
    for _ in range(200):
        com = rng.uniform([-0.1, -0.2, 0.5], [0.4, 0.2, 1.0])
        acceleration = rng.uniform(-3.0, 3.0, 3)
        force = np.array([0.0, 0.0, GRAVITY]) + acceleration
        violation = (rows @ [*force, *np.cross(com, force)]).max()
        if abs(violation) > 1e-6:
            inside += violation < 0.0
            assert reachable(TILTED, com, list(acceleration)) == (violation < 0.0)
    assert 10 < inside < 190


def test_on_level_ground_it_is_the_hull_of_the_soles() -> None:
    """Whatever the friction, none included."""
    for mu in (0.7, 0.0):
        contacts = [Contact(c.X_WC, 0.12, 0.07, mu) for c in LEVEL]
        for method in METHODS[:2]:
            polygon = static_polygon(contacts, method)
            assert polygon.status == "ok"
            assert polygon.method != "projection"
            assert not polygon.caught
            assert hausdorff_distance(polygon.vertices, hull(contacts)) < 1e-9


def test_every_yawed_stance_on_stairs_has_its_cone() -> None:
    """Where cdd meets an inconsistency in one order of rows another is tried."""
    rng = np.random.default_rng(0)
    for _ in range(40):
        rise, depth = rng.uniform(0.15, 0.25), rng.uniform(0.25, 0.32)
        yaw = rng.uniform(-0.2, 0.2, 2)
        side = rng.choice([-0.1, 0.1])
        contacts = [
            foot(0.0, side, 0.0, yaw=yaw[0]),
            foot(depth, -side, rise, yaw=yaw[1]),
        ]
        polygon = static_polygon(contacts, "double_description")
        assert polygon.method == "double_description"
        assert not polygon.caught


def test_wide_is_not_unbounded() -> None:
    """Feet four metres apart, on the level."""
    polygon = static_polygon([foot(-2.0, 0.1, 0.0), foot(2.0, -0.1, 0.0)])
    assert polygon.status == "ok"
    assert np.abs(polygon.vertices[:, 0]).max() == pytest.approx(2.12)


def test_the_polygon_moves_with_the_stance() -> None:
    """Carried along and turned, far from the world's origin too."""
    X = RigidTransform(RollPitchYaw(0.0, 0.0, 0.8), [40.0, -25.0, 3.0])
    moved = [
        Contact(X.multiply(c.X_WC), c.half_length, c.half_width, c.friction)
        for c in TILTED
    ]
    here, there = static_polygon(TILTED).vertices, static_polygon(moved).vertices
    carried = np.column_stack([here, np.zeros(len(here))]) @ X.rotation().matrix().T
    expected = carried[:, :2] + X.translation()[:2]
    assert hausdorff_distance(there, expected) < 1e-8


def test_a_hand_on_a_wall_widens_the_polygon() -> None:
    """The wall's normal points at the robot; the hand is a point."""
    wall = RigidTransform(RollPitchYaw(0.0, -np.pi / 2, 0.0), [0.7, 0.0, 1.0])
    hand = point_contact(wall, 0.5)
    feet, with_hand = static_polygon(LEVEL), static_polygon([*LEVEL, hand])
    assert with_hand.method == "section"
    by_lp = static_polygon([*LEVEL, hand], "projection")
    assert hausdorff_distance(with_hand.vertices, by_lp.vertices) < 1e-6
    assert area(with_hand.vertices) > 1.2 * area(feet.vertices)
    for vertex in feet.vertices:
        assert signed_margin(with_hand.vertices, vertex) > -1e-9


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("contacts", "status"),
    [
        ([], "no_contact"),
        ([foot(0.0, 0.0, 0.0, 0.0, 0.7, 0.0)], "infeasible"),
        ([foot(0.0, 0.0, 0.0, np.pi, 0.0, 0.0)], "infeasible"),
        ([foot(0.0, 0.0, 0.0, 0.0, 0.1, 0.0, mu=0.0)], "infeasible"),
        ([point_contact(RigidTransform([0.3, 0.1, 0.2]), 0.5)], "degenerate"),
        (
            [
                point_contact(RigidTransform([0.3, 0.1, 0.2]), 0.5),
                point_contact(RigidTransform([-0.1, 0.2, 0.0]), 0.5),
            ],
            "degenerate",
        ),
        (
            [foot(0.0, 0.0, 0.0), foot(0.0, 0.0, 1.5, np.pi, 0.0, 0.0)],
            "unbounded",
        ),
    ],
)
def test_odd_stances_have_a_status(
    contacts: list[Contact], status: str, method: Method
) -> None:
    """No contact, too steep, upside down, ice, points, floor and ceiling."""
    polygon = static_polygon(contacts, method)
    assert polygon.status == status
    assert (len(polygon.vertices) == 0) == (status in ("no_contact", "infeasible"))
    assert not polygon.caught


def test_points_carry_the_com_above_and_between_them() -> None:
    """One point: the point. Two on level ground: their segment. Three: a triangle."""
    points = np.array([[0.3, 0.1], [-0.1, 0.2], [0.0, -0.3]])
    contacts = [point_contact(RigidTransform([*p, 0.0]), 0.4) for p in points]
    for count in (1, 2, 3):
        polygon = static_polygon(contacts[:count])
        assert len(polygon.vertices) == count
        for point in points[:count]:
            assert np.abs(polygon.vertices - point).sum(axis=1).min() < 1e-6


def test_contacts_that_repeat_or_stack_change_nothing() -> None:
    """The same foot twice; a foot straight above another on level treads."""
    one = static_polygon([foot(0.1, 0.2, 0.0)])
    twice = static_polygon([foot(0.1, 0.2, 0.0), foot(0.1, 0.2, 0.0)])
    assert hausdorff_distance(one.vertices, twice.vertices) < 1e-9
    stacked = [foot(0.1, 0.2, 0.0), foot(0.1, 0.2, 0.4)]
    ours, by_cone, by_lp = (static_polygon(stacked, method) for method in METHODS)
    assert ours.status == by_cone.status == "ok"
    assert hausdorff_distance(ours.vertices, by_lp.vertices) < 1e-6
    assert hausdorff_distance(by_cone.vertices, by_lp.vertices) < 1e-6
    # Feet above one another push apart: each tips the other's corner outward.
    assert area(ours.vertices) > area(one.vertices)


def test_an_unbounded_polygon_is_clipped() -> None:
    """Braced between floor and ceiling the CoM may be anywhere."""
    contacts = [foot(1.0, 2.0, 0.0), foot(1.0, 2.0, 1.5, np.pi, 0.0, 0.0)]
    polygon = static_polygon(contacts)
    assert area(polygon.vertices) == pytest.approx(4.0 * HALF_SIDE**2)
    np.testing.assert_allclose(polygon.vertices.mean(axis=0), [1.0, 2.0], atol=1e-9)


def test_robust_polygon_survives_every_acceleration_in_its_bounds() -> None:
    """Just inside each vertex all corner accelerations are possible, outside not."""
    bound = np.array([0.8, 0.5, 0.3])
    polygon = robust_polygon(TILTED, 0.9, bound)
    assert polygon.status == "ok"
    assert polygon.method == "double_description"
    by_lp = robust_polygon(TILTED, 0.9, bound, "projection")
    assert hausdorff_distance(polygon.vertices, by_lp.vertices) < 1e-6
    walked = robust_polygon(TILTED, 0.9, bound, "section")
    assert walked.method == "section"
    assert hausdorff_distance(walked.vertices, by_lp.vertices) < 1e-6
    corners = [
        [sx * 0.8, sy * 0.5, sz * 0.3]
        for sx in (-1, 1)
        for sy in (-1, 1)
        for sz in (-1, 1)
    ]
    centre = polygon.vertices.mean(axis=0)
    for vertex in polygon.vertices:
        for factor, survives in ((0.999, True), (1.001, False)):
            com = np.array([*(centre + factor * (vertex - centre)), 0.9])
            assert all(reachable(TILTED, com, a) for a in corners) == survives
    still = robust_polygon(TILTED, 0.9, np.zeros(3))
    expected = static_polygon(TILTED)
    assert hausdorff_distance(still.vertices, expected.vertices) < 1e-9


def test_robust_polygon_on_level_ground_shrinks_by_the_cart_table() -> None:
    """An acceleration a moves the ZMP by z a / g; friction is not the limit here."""
    contacts = [foot(0.0, 0.0, 0.0)]
    polygon = robust_polygon(contacts, 0.8, np.array([0.5, 0.2, 0.0]))
    dx, dy = 0.12 - 0.8 * 0.5 / GRAVITY, 0.07 - 0.8 * 0.2 / GRAVITY
    expected = np.array([[-dx, -dy], [dx, -dy], [dx, dy], [-dx, dy]])
    assert hausdorff_distance(polygon.vertices, expected) < 1e-9
    assert robust_polygon(contacts, 0.8, np.array([9.0, 0, 0])).status == "infeasible"
    with pytest.raises(ValueError, match="acceleration_bound"):
        robust_polygon(contacts, 0.8, np.array([-1.0, 0.0, 0.0]))


def test_zmp_support_area_on_level_ground_is_the_hull() -> None:
    """With the CoM above it and friction enough; scarce friction pulls it in."""
    com = np.array([0.12, 0.0, 0.8])
    support = zmp_support_area(LEVEL, com, 0.0)
    assert hausdorff_distance(support.vertices, hull(LEVEL)) < 1e-8
    slippery = [Contact(c.X_WC, 0.12, 0.07, 0.1) for c in LEVEL]
    pulled = zmp_support_area(slippery, com, 0.0)
    assert area(pulled.vertices) < 0.9 * area(support.vertices)


def test_zmp_support_area_on_tilted_soles_is_what_forces_can_do() -> None:
    """Just inside a vertex forces through the ZMP exist, just outside none."""
    com, plane = np.array([0.15, 0.02, 0.9]), 0.1
    support, by_cone, by_lp = (zmp_support_area(TILTED, com, plane, m) for m in METHODS)
    assert (support.method, by_cone.method) == ("section", "double_description")
    assert hausdorff_distance(support.vertices, by_lp.vertices) < 1e-6
    assert hausdorff_distance(by_cone.vertices, by_lp.vertices) < 1e-6
    centre = support.vertices.mean(axis=0)
    for vertex in support.vertices:
        for factor, possible in ((0.999, True), (1.001, False)):
            zmp = centre + factor * (vertex - centre)
            acceleration = GRAVITY / (com[2] - plane) * (com[:2] - zmp)
            assert reachable(TILTED, com, [*acceleration, 0.0]) == possible
    with pytest.raises(ValueError, match="plane_height"):
        zmp_support_area(TILTED, com, 0.9)


def test_required_friction_is_the_slope_s() -> None:
    """The tangent of a pitch, nothing on the level, infinite upside down."""
    slope = [foot(0.0, 0.0, 0.0, 0.0, 0.35, 0.0)]
    assert required_friction(slope) == pytest.approx(np.tan(0.35), abs=1e-6)
    above = required_friction(slope, np.array([0.02, 0.01]))
    assert above == pytest.approx(np.tan(0.35), abs=1e-6)
    assert required_friction(LEVEL) == 0.0
    assert required_friction(LEVEL, np.array([2.0, 0.0])) == np.inf
    assert required_friction([foot(0.0, 0.0, 0.0, np.pi, 0.0, 0.0)]) == np.inf
    assert required_friction([]) == np.inf


def test_required_friction_is_where_the_com_enters_the_polygon() -> None:
    """With a little less the CoM is outside, with a little more inside."""
    com = static_polygon(TILTED).vertices.mean(axis=0)
    least = required_friction(TILTED, com)
    assert 0.01 < least < 0.7
    for mu, stands in ((least - 1e-4, False), (least + 1e-4, True)):
        contacts = [Contact(c.X_WC, 0.12, 0.07, mu) for c in TILTED]
        margin = signed_margin(static_polygon(contacts).vertices, com)
        assert (margin > 0.0) == stands
