"""Which part of a sole carries, and when a contact has moved."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.systems.balance.contact_wrench_cone import sole_contact
from footfall.systems.balance.sole_contacts import carrying_contact, moved_by
from footfall.systems.planning.motion.toe_off import lift_heel

SOLE = Sole(heel=0.1, toe=0.14, half_width=0.07, ankle_height=0.1)
POSE = np.array([0.3, 0.1, 0.2, 0.0, 0.0, 0.4])


def test_whole_sole_carries_as_it_lies() -> None:
    """A tilted sole that carries all over is a tilted contact."""
    pose = np.array([0.3, 0.1, 0.2, 0.1, -0.2, 0.4])
    X_WF = RigidTransform(RollPitchYaw(pose[3:]), pose[:3])
    want = sole_contact(X_WF, 0.1, 0.14, 0.07, 0.6)
    assert moved_by(carrying_contact(pose, 0.24, SOLE, 0.6), want) < 1e-12


@pytest.mark.parametrize("pitch", [0.0, 0.3, 0.8])
def test_lifted_toes_are_a_level_strip_that_stays(pitch: float) -> None:
    """Whatever the heel does, the strip lies before the toe edge of the flat foot."""
    raised = lift_heel(POSE, np.array([pitch]), SOLE)[0]
    corners = carrying_contact(raised, 0.02, SOLE, 0.6).corners()
    flat = sole_contact(
        RigidTransform(RollPitchYaw(POSE[3:]), POSE[:3]), -0.12, 0.14, 0.07, 0.6
    )
    np.testing.assert_allclose(corners, flat.corners(), atol=1e-12)


def test_moved_by_is_the_farthest_corner() -> None:
    """A turn moves corners though the centre stays; another size is another contact."""
    a = carrying_contact(POSE, 0.24, SOLE, 0.6)
    turned = POSE.copy()
    turned[0] += 0.003
    assert moved_by(a, carrying_contact(turned, 0.24, SOLE, 0.6)) == pytest.approx(
        0.003
    )
    turned[5] += 0.1
    assert moved_by(a, carrying_contact(turned, 0.24, SOLE, 0.6)) > 0.01
    assert moved_by(a, carrying_contact(POSE, 0.1, SOLE, 0.6)) == float("inf")
    assert moved_by(a, carrying_contact(POSE, 0.24, SOLE, 0.5)) == float("inf")
