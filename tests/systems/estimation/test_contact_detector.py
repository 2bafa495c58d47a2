"""Contacts from noisy forces: early, late, partial, none."""

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
)
from footfall.systems.ports import eval_vector

PARAMS = ContactParams()
SOLE = SoleSize(0.075, 0.15, 0.042)
AIR = FootContact(False, 0)


def after(contact: FootContact, *forces: float) -> FootContact:
    """Takes in samples one after the other."""
    for force in forces:
        contact = detect_contact(contact, force, PARAMS)
    return contact


def test_one_sample_is_no_touch() -> None:
    """A spike between quiet samples says nothing; two in a row do."""
    assert not after(AIR, 60.0, 0.0, 60.0, 0.0).touching
    assert after(AIR, 60.0, 60.0).touching


def test_a_strong_sample_is_enough() -> None:
    """Beyond all noise."""
    assert after(AIR, PARAMS.sure_force + 1.0).touching
    assert after(FootContact(True, 1), PARAMS.sure_force + 1.0) == FootContact(True, 0)


def test_between_the_thresholds_nothing_changes() -> None:
    """Hysteresis."""
    between = 0.5 * (PARAMS.touch_force + PARAMS.release_force)
    assert not after(AIR, *[between] * 10).touching
    assert after(FootContact(True, 0), *[between] * 10).touching
    assert not after(FootContact(True, 0), 0.0, 0.0).touching
    assert after(FootContact(True, 0), 0.0, 200.0, 0.0).touching


def test_ten_newtons_of_noise_touch_nothing() -> None:
    """In 100 s in the air, and lose nothing in 100 s on the ground."""
    noise = 10.0 * np.random.default_rng(0).standard_normal(20_000)
    contact = AIR
    for force in noise:
        contact = detect_contact(contact, force, PARAMS)
        assert not contact.touching
    contact = FootContact(True, 0)
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
    """Both feet touch at first; the right one leaves after the count."""
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
    simulator.AdvanceTo(0.001)
    assert read("touching") == [1.0, 0.0]


def test_thresholds_in_the_wrong_order_are_refused() -> None:
    """By name."""
    with pytest.raises(ValueError, match=r"^release_force: must be less"):
        ContactParams(release_force=40.0).validate()
    with pytest.raises(ValueError, match=r"^sure_force: must be at least"):
        ContactParams(sure_force=20.0).validate()
