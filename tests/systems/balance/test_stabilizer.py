"""DCM feedback: its closed loop, its signs, and the wrenches that carry it out."""

import numpy as np
import pytest
from pydrake.systems.framework import Context
from scipy.integrate import solve_ivp

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.vector import Vector
from footfall.systems.balance import stabilizer
from footfall.systems.balance.stabilizer import (
    BalanceCommand,
    Stabilizer,
    StabilizerParams,
    dcm_feedback,
)
from footfall.systems.ports import eval_vector

MASS = 62.4
COM = np.array([0.05, 0.02, 0.85])
REST = np.zeros(3)
FEET = np.array([[0.0, 0.1, 0, 0, 0, 0], [0.0, -0.1, 0, 0, 0, 0]])


def feedback(
    com: Vector,
    velocity: Vector,
    reference: Vector = COM,
    velocity_reference: Vector = REST,
    acceleration_reference: Vector = REST,
    zmp_height: float = 0.0,
    **params: float,
) -> BalanceCommand:
    """The core, by default about standing still."""
    return dcm_feedback(
        com,
        velocity,
        reference,
        velocity_reference,
        acceleration_reference,
        zmp_height,
        StabilizerParams(**params),
    )


def test_on_the_reference_nothing_is_added() -> None:
    """The reference's acceleration, DCM and ZMP come out."""
    velocity, acceleration = np.array([0.2, -0.1, 0.05]), np.array([0.4, 0.3, -0.5])
    command = feedback(COM, velocity, COM, velocity, acceleration, zmp_height=0.15)
    np.testing.assert_allclose(command.com_acceleration, acceleration, atol=1e-12)
    np.testing.assert_allclose(command.dcm, command.dcm_reference, atol=1e-12)
    omega = np.sqrt((9.81 - 0.5) / 0.70)
    np.testing.assert_allclose(command.dcm, COM[:2] + velocity[:2] / omega)
    np.testing.assert_allclose(command.zmp, COM[:2] - acceleration[:2] / omega**2)


@pytest.mark.parametrize("gain", [0.5, 1.0, 2.0])
def test_dcm_error_decays_at_its_gain(gain: float) -> None:
    """e(t) = e(0) exp(-k omega t) where the commanded acceleration is carried out."""

    def flow(_: float, state: Vector) -> Vector:
        com = np.array([*state[:2], COM[2]])
        velocity = np.array([*state[2:], 0.0])
        command = feedback(com, velocity, dcm_gain=gain)
        return np.concatenate([state[2:], command.com_acceleration[:2]])

    start = np.array([COM[0] + 0.02, COM[1] - 0.01, 0.05, 0.1])
    end = solve_ivp(flow, (0.0, 0.6), start, rtol=1e-9, atol=1e-12).y[:, -1]
    omega = np.sqrt(9.81 / 0.85)
    errors = [state[:2] + state[2:] / omega - COM[:2] for state in (start, end)]
    np.testing.assert_allclose(
        errors[1], errors[0] * np.exp(-gain * omega * 0.6), rtol=1e-6
    )


def test_the_zmp_moves_beyond_the_dcm() -> None:
    """By (1 + k) times its error, and that is the ZMP of the commanded motion."""
    com, velocity = COM + np.array([0.01, -0.02, 0.0]), np.array([0.1, 0.0, 0.0])
    command = feedback(com, velocity, dcm_gain=1.5)
    shift = 2.5 * (command.dcm - command.dcm_reference)
    np.testing.assert_allclose(command.zmp, COM[:2] + shift)
    omega = np.sqrt(9.81 / 0.85)
    own = com[:2] - command.com_acceleration[:2] / omega**2
    np.testing.assert_allclose(own, command.zmp, atol=1e-12)


def test_height_is_a_spring_and_a_damper() -> None:
    """About its own reference."""
    com, velocity = COM + np.array([0.0, 0.0, 0.01]), np.array([0.0, 0.0, 0.02])
    command = feedback(com, velocity, height_stiffness=100.0, height_damping=20.0)
    assert command.com_acceleration[2] == pytest.approx(-100.0 * 0.01 - 20.0 * 0.02)
    np.testing.assert_allclose(command.com_acceleration[:2], 0.0, atol=1e-12)


def test_pendulum_is_as_long_as_the_com_is_over_the_zmp() -> None:
    """On a tread the ground is higher; a CoM that accelerates up is stiffer."""
    com, velocity = COM, np.array([0.3, 0.0, 0.0])
    for height, lift in ((0.0, 0.0), (0.4, 0.0), (0.4, 2.0), (0.0, -3.0)):
        command = feedback(
            com,
            velocity,
            acceleration_reference=np.array([0.0, 0.0, lift]),
            zmp_height=height,
        )
        omega = np.sqrt((9.81 + lift) / (0.85 - height))
        assert command.dcm[0] == pytest.approx(com[0] + 0.3 / omega)


def make(
    com: Vector = COM,
    velocity: Vector = REST,
    contacts: tuple[float, float] = (1.0, 1.0),
    momentum_rate: Vector = REST,
) -> tuple[Stabilizer, Context]:
    """The system on fixed inputs; stands unless told otherwise."""
    system = Stabilizer(StabilizerParams(), JVRC1.sole, MASS)
    context = system.CreateDefaultContext()
    for name, value in (
        ("com", com),
        ("com_velocity", velocity),
        ("com_reference", np.concatenate([COM, np.zeros(6)])),
        ("zmp", [0.05, 0.02, 0.0]),
        ("contacts", [*contacts, JVRC1.sole.length, JVRC1.sole.length]),
        ("foot_references", np.concatenate([FEET.ravel(), np.zeros(12)])),
        ("momentum_rate", momentum_rate),
    ):
        system.GetInputPort(name).FixValue(context, value)
    return system, context


def net(wrenches: Vector, com: Vector) -> tuple[Vector, Vector]:
    """Force, and moment about the CoM, of both feet."""
    force, moment = np.zeros(3), np.zeros(3)
    for wrench, pose in zip(wrenches.reshape(2, 6), FEET, strict=True):
        force += wrench[:3]
        moment += wrench[3:] + np.cross(pose[:3] - com, wrench[:3])
    return force, moment


def test_wrenches_carry_out_the_command() -> None:
    """Mass times acceleration and gravity, and the motion's own momentum rate."""
    com, velocity = COM + np.array([0.002, -0.001, 0.001]), np.array([0.01, 0.005, 0.0])
    rate = np.array([0.5, -1.0, 0.3])
    system, context = make(com, velocity, momentum_rate=rate)
    wrenches = eval_vector(system.GetOutputPort("foot_wrenches"), context)
    force, moment = net(wrenches, com)
    wanted = feedback(com, velocity).com_acceleration + np.array([0.0, 0.0, 9.81])
    np.testing.assert_allclose(force, MASS * wanted, atol=0.1)
    np.testing.assert_allclose(moment, rate, atol=0.1)


def test_without_wrenches_it_does_not_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """A programme that was not solved is no command."""
    monkeypatch.setattr(
        stabilizer, "distribute_wrench", lambda *args: (np.zeros((2, 6)), False)
    )
    system, context = make(COM, np.zeros(3))
    with pytest.raises(RuntimeError, match="no foot wrenches near"):
        system.GetOutputPort("foot_wrenches").Eval(context)


def test_a_foot_in_the_air_gets_nothing() -> None:
    """Even where the other cannot bring the robot back alone."""
    system, context = make(contacts=(0.0, 1.0))
    wrenches = eval_vector(system.GetOutputPort("foot_wrenches"), context)
    assert not wrenches[:6].any()
    assert wrenches[8] > 0.5 * MASS * 9.81


def test_outputs_are_the_core_s() -> None:
    """DCM, its reference and the commanded ZMP; they follow their inputs."""
    com, velocity = COM + np.array([0.01, 0.0, 0.0]), np.array([0.1, -0.1, 0.0])
    system, context = make(com, velocity)
    for _ in range(2):
        command = feedback(com, velocity)
        for name, want in (
            ("dcm", command.dcm),
            ("dcm_reference", command.dcm_reference),
            ("zmp_command", command.zmp),
        ):
            port = system.GetOutputPort(name)
            np.testing.assert_allclose(eval_vector(port, context), want, atol=1e-12)
        velocity = -velocity
        system.GetInputPort("com_velocity").FixValue(context, velocity)


@pytest.mark.parametrize("field", ["dcm_gain", "height_stiffness", "height_damping"])
@pytest.mark.parametrize("value", [-1.0, np.inf, np.nan])
def test_parameters_out_of_range_are_refused(field: str, value: float) -> None:
    """By name; those of the distribution too."""
    with pytest.raises(ValueError, match=rf"^{field}: must be "):
        Stabilizer(StabilizerParams(**{field: value}), JVRC1.sole, MASS)
    params = StabilizerParams()
    params.distribution.friction = 0.0
    with pytest.raises(ValueError, match=r"^distribution\.friction: "):
        Stabilizer(params, JVRC1.sole, MASS)
