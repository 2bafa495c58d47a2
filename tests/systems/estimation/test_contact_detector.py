"""Contacts from noisy forces: early, late, partial, none."""

import math

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator

from footfall.systems.estimation.contact_detector import (
    ContactDetector,
    ContactParams,
    FootContact,
    SoleSize,
    bears,
    detect_contact,
    standing_contact,
)
from footfall.systems.ports import eval_vector

PARAMS = ContactParams()
SOLE = SoleSize(0.075, 0.15, 0.042)
STANDS = standing_contact(PARAMS)
AIR = FootContact(False, 0, 0.0, PARAMS.noise**2, 0.0)


def after(contact: FootContact, *forces: float) -> FootContact:
    """Takes in samples one after the other."""
    for force in forces:
        contact = detect_contact(contact, force, PARAMS)
    return contact


def test_a_touch_is_felt_at_once() -> None:
    """At the first sample; before it there was none."""
    assert not after(AIR, *[0.0] * 50, PARAMS.touch_force - 1.0).touching
    assert after(AIR, *[0.0] * 50, PARAMS.touch_force + 1.0).touching


def test_the_ground_is_lost_with_patience() -> None:
    """A gap of one sample is none; between the thresholds nothing changes."""
    threshold = max(PARAMS.touch_force, PARAMS.touch_sigmas * PARAMS.noise)
    between = threshold * (PARAMS.release_share + 1.0) / 2.0
    assert after(STANDS, 0.0, 200.0, 0.0, 200.0).touching
    assert not after(STANDS, 0.0, 0.0).touching
    assert after(STANDS, *[between] * 10).touching
    assert not after(AIR, *[between] * 3).touching


def test_an_offset_is_found_in_the_air() -> None:
    """The threshold is over it, up to what may be an offset."""
    offset = after(AIR, *[8.0] * 200)
    assert offset.mean == pytest.approx(8.0, abs=0.01)
    assert not after(offset, 8.0 + PARAMS.touch_force - 1.0).touching
    assert after(offset, 8.0 + PARAMS.touch_force + 1.0).touching
    assert after(AIR, *[14.0] * 200).mean <= PARAMS.largest_tare


def test_noise_is_told_from_the_pull_of_inertia() -> None:
    """A swing that pulls by 40 N and back leaves the threshold where it was."""
    swing = -40.0 * np.sin(np.linspace(0.0, np.pi, 60))
    assert after(AIR, *swing).variance < 2.0 * PARAMS.noise**2


def test_ten_newtons_of_noise_touch_nothing() -> None:
    """In 100 s in the air, once their size is known; and lose nothing in 100 s."""
    noise = 10.0 * np.random.default_rng(0).standard_normal(20_000)
    contact = AIR._replace(variance=100.0)
    touched = 0
    for force in noise:
        contact = detect_contact(contact, force, PARAMS)
        touched += contact.touching
    assert touched <= 20
    assert 6.0 < math.sqrt(contact.variance) <= PARAMS.largest_noise
    contact = STANDS
    for force in noise + 300.0:
        contact = detect_contact(contact, force, PARAMS)
        assert contact.touching


@pytest.mark.parametrize(
    ("x", "y", "force", "expected"),
    [
        (0.03, 0.0, 300.0, True),
        (0.03, 0.0, 50.0, False),
        (0.145, 0.0, 300.0, False),
        (-0.07, 0.0, 300.0, False),
        (0.03, 0.035, 300.0, False),
        (0.03, -0.035, 300.0, False),
    ],
)
def test_a_foot_on_its_edge_bears_nothing(
    x: float, y: float, force: float, expected: bool
) -> None:
    """The centre of pressure is (-m_y, m_x) / f_z."""
    wrench = np.array([0.0, 0.0, force, y * force, -x * force, 0.0])
    assert bears(wrench, SOLE, PARAMS) is expected


def test_system() -> None:
    """Both feet touch at first; the right one leaves after the count, two ticks."""
    system = ContactDetector(PARAMS, SOLE)
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    wrenches = np.zeros(12)
    wrenches[2] = 300.0
    system.GetInputPort("foot_wrenches").FixValue(context, wrenches)

    def read(name: str) -> list[float]:
        return eval_vector(system.GetOutputPort(name), context).tolist()

    assert read("touching") == [1.0, 1.0]
    assert read("bearing") == [1.0, 0.0]
    simulator.AdvanceTo(0.006)
    assert read("touching") == [1.0, 0.0]
