"""What a replay shows beside the robot is where it was."""

import numpy as np
import pytest
from pydrake.math import RigidTransform

from footfall.diagrams.figures.live_view import meshcat_at
from footfall.diagrams.figures.replay_overlays import (
    FORCE_LENGTH,
    ContactForce,
    Overlays,
    PlannedFoothold,
    Seen,
    add_overlays,
    contact_forces,
    read_overlays,
    rod,
    zmp_of,
)
from footfall.diagrams.judge.evidence_measures import zmp_of_feet
from footfall.diagrams.run_data import read_run_data
from footfall.diagrams.simulation import run_task
from footfall.models.robots.jvrc1 import JVRC1


@pytest.fixture
def data(tmp_path, standing):
    """A run of a moment in front of a staircase."""
    scenario = standing.scenario()
    run_task(standing.task(end=0.01, scene=scenario.scene), scenario, tmp_path / "run")
    return read_run_data(tmp_path / "run")


def test_forces_bear_the_robot_inside_its_soles(data) -> None:
    """Upward, its weight in all, and the ZMP is the judge's."""
    forces = contact_forces(data)
    total = sum(one.force for one in forces.values())
    assert total[-1] == pytest.approx([0.0, 0.0, 1.0], abs=0.02)
    for foot, one in forces.items():
        low = data.motion.sole_corners[foot][-1].min(axis=0)
        high = data.motion.sole_corners[foot][-1].max(axis=0)
        assert (low[:2] < one.point[-1, :2]).all()
        assert (one.point[-1, :2] < high[:2]).all()
        assert one.point[-1, 2] == pytest.approx(0.0, abs=0.005)
    zmp = zmp_of(forces)
    wanted = zmp_of_feet(data.motion, data.wrenches, data.limits.weight)
    np.testing.assert_allclose(zmp[-1, :2], wanted[-1], atol=2e-3)
    overlays = read_overlays(data)
    assert overlays.com is data.motion.com
    assert (overlays.footholds, overlays.seen) == ((), ())


def test_the_zmp_is_between_the_feet_by_their_load() -> None:
    """In height too; there is none in the air."""
    left = ContactForce(
        np.array([[0.0, 0.1, 0.0]] * 2), np.array([[0, 0, 0.25], [0] * 3])
    )
    right = ContactForce(
        np.array([[0.4, -0.1, 0.2]] * 2), np.array([[0, 0, 0.75], [0] * 3])
    )
    zmp = zmp_of({"left": left, "right": right})
    np.testing.assert_allclose(zmp[0], [0.3, -0.05, 0.15])
    assert np.isnan(zmp[1]).all()


def test_a_rod_lies_between_its_ends() -> None:
    """Whatever way it points; none has no length."""
    for span in ([0.0, 0.0, 2.0], [0.0, 0.0, -2.0], [1.0, -2.0, 0.5]):
        begin = np.array([1.0, 2.0, 3.0])
        X_WR, length = rod(begin, np.array(span))
        assert length == pytest.approx(np.linalg.norm(span))
        ends = X_WR.multiply(np.array([[0, 0, -length / 2], [0, 0, length / 2]]).T).T
        np.testing.assert_allclose(ends, [begin, begin + span], atol=1e-12)
    assert rod(begin, np.zeros(3))[1] == 0.0


class Recording:
    """Notes what is set, at ten frames a second."""

    def __init__(self):
        self.properties, self.transforms = {}, {}

    def frame(self, time):
        """The frame at a time, s."""
        return int(10.0 * time + 1e-6)

    def SetProperty(self, frame, path, name, value):
        """Notes a property."""
        self.properties.setdefault((path, name), []).append((frame, value))

    def SetTransform(self, frame, path, X):
        """Notes a place."""
        self.transforms.setdefault(path, {})[frame] = X.translation()


def test_each_is_shown_from_its_time_on() -> None:
    """What was seen until it was seen anew; the CoM all the time."""
    meshcat, recording = meshcat_at(), Recording()
    edges = np.array([[[0.0, 0, 0], [1, 0, 0]]])
    overlays = Overlays(
        com=np.linspace([0.0, 0.0, 1.0], [2.0, 0.0, 1.0], 21),
        zmp=np.full((21, 3), np.nan),
        forces={"left": ContactForce(np.zeros((21, 3)), np.tile([0, 0, 1.0], (21, 1)))},
        footholds=(PlannedFoothold(1.0, "left", RigidTransform()),),
        seen=(Seen(0.0, edges), Seen(0.5, edges[:0]), Seen(1.5, edges)),
    )
    moments = [(0.1 * frame, frame) for frame in range(21)]
    add_overlays(meshcat, recording, overlays, JVRC1.sole, moments)
    visible = {
        p: v for (p, name), v in recording.properties.items() if name == "visible"
    }
    assert visible == {
        "/shown/seen/0": [(0, True), (5, False)],
        "/shown/seen/2": [(0, False), (15, True)],
        "/shown/footholds/0": [(0, False), (10, True)],
    }
    assert recording.transforms["/shown/CoM"][20] == pytest.approx([2.0, 0.0, 1.0])
    assert "/shown/ZMP" not in recording.transforms
    arrow = "/shown/forces/left"
    assert recording.transforms[arrow][3] == pytest.approx([0, 0, FORCE_LENGTH / 2])
    assert recording.properties[arrow, "scale"][3] == (3, [1.0, 1.0, FORCE_LENGTH])
    for path in visible:
        assert meshcat.HasPath(path)
