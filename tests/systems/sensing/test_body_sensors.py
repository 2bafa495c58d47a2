"""IMU, encoders and ankle sensors: what they tell, how late, how noisy, when broken."""

import numpy as np
import pytest
from pydrake.multibody.math import SpatialForce
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.ankle_force_sensors import (
    AnkleForceParams,
    AnkleForceSensors,
)
from footfall.systems.sensing.imu import Imu, ImuParams
from footfall.systems.sensing.joint_encoders import JointEncoderParams, JointEncoders
from footfall.systems.sensing.sampling import NoiseSource, latency_steps
from tests.systems.test_system_docstrings import robot_alone

H = 0.0025
QUIET = ImuParams(
    gyroscope_noise=0.0,
    accelerometer_noise=0.0,
    gyroscope_bias=0.0,
    accelerometer_bias=0.0,
    gyroscope_walk=0.0,
    accelerometer_walk=0.0,
)


def started(system: LeafSystem, **inputs: object) -> tuple[Simulator, Context]:
    """A System alone with fixed inputs."""
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    for name, value in inputs.items():
        system.GetInputPort(name).FixValue(context, value)
    return simulator, context


def output(system: LeafSystem, context: Context) -> Vector:
    """The one output."""
    return eval_vector(system.get_output_port(0), context)


def test_noise_is_a_function_of_seed_name_and_step() -> None:
    """And white, with unit deviation."""
    source = NoiseSource(3, "imu", 4)
    drawn = np.array([source.at(step) for step in range(3000)])
    again = NoiseSource(3, "imu", 4)
    np.testing.assert_array_equal(again.at(2999), drawn[2999])
    np.testing.assert_array_equal(again.at(5), drawn[5])
    assert not np.array_equal(NoiseSource(3, "ankles", 4).at(5), drawn[5])
    assert not np.array_equal(NoiseSource(4, "imu", 4).at(5), drawn[5])
    np.testing.assert_allclose(drawn.std(axis=0), 1.0, atol=0.05)
    np.testing.assert_allclose(drawn.mean(axis=0), 0.0, atol=0.08)


@pytest.mark.parametrize(
    ("latency", "steps"), [(0.0, 1), (0.0025, 1), (0.003, 2), (0.005, 2)]
)
def test_latency_in_steps(latency: float, steps: int) -> None:
    """At least the one to the next step of the plant."""
    assert latency_steps(latency, H) == steps


def test_imu_integrates() -> None:
    """Rate times time, force times time, and until when."""
    imu = Imu(QUIET, H)
    simulator, context = started(
        imu, angular_rate=[0.1, 0.2, 0.3], specific_force=[0.0, 0.0, 9.81]
    )
    simulator.AdvanceTo(1.0 - H / 2)
    expected = [1.0, 0.1, 0.2, 0.3, 0.0, 0.0, 9.81]
    np.testing.assert_allclose(output(imu, context), expected, atol=1e-9)


def test_imu_noise_is_that_of_its_densities() -> None:
    """An integral of white noise over T deviates by the density times root T."""
    params = ImuParams(gyroscope_bias=0.0, accelerometer_bias=0.0)
    ends = []
    for seed in range(30):
        noisy = ImuParams(**{**vars(params), "seed": seed})
        imu = Imu(noisy, H)
        simulator, context = started(
            imu, angular_rate=np.zeros(3), specific_force=np.zeros(3)
        )
        simulator.AdvanceTo(1.0)
        ends.append(output(imu, context)[1:])
    deviation = np.std(ends, axis=0).reshape(2, 3).mean(axis=1)
    assert deviation[0] == pytest.approx(params.gyroscope_noise, rel=0.3)
    assert deviation[1] == pytest.approx(params.accelerometer_noise, rel=0.3)


def test_imu_bias_is_drawn_at_the_start() -> None:
    """Another seed, another bias; the same seed, the same numbers bit for bit."""
    ends = []
    for seed in (1, 1, 2):
        imu = Imu(ImuParams(seed=seed), H)
        simulator, context = started(
            imu, angular_rate=np.zeros(3), specific_force=np.zeros(3)
        )
        simulator.AdvanceTo(2.0)
        ends.append(output(imu, context))
    np.testing.assert_array_equal(ends[0], ends[1])
    assert not np.allclose(ends[0], ends[2])


def test_a_dead_imu_falls_silent() -> None:
    """Its latest sample stays what it was."""
    imu = Imu(ImuParams(fails_at=0.5), H)
    simulator, context = started(
        imu, angular_rate=np.ones(3), specific_force=np.ones(3)
    )
    simulator.AdvanceTo(0.6)
    last = output(imu, context)
    assert last[0] == pytest.approx(0.5)
    simulator.AdvanceTo(0.7)
    np.testing.assert_array_equal(output(imu, context), last)


def encoders(params: JointEncoderParams) -> JointEncoders:
    """Of two joints that begin at 0.1 and 0.2."""
    return JointEncoders(params, H, ["hip", "knee"], np.array([0.1, 0.2]), 17)


def at(hip: float, knee: float) -> Vector:
    """The robot's state with these positions; its velocities are not to be read."""
    state = np.full(17, np.nan)
    state[7:9] = hip, knee
    return state


def test_encoders_round_to_their_steps() -> None:
    """To the nearest."""
    system = encoders(JointEncoderParams(resolution=0.01))
    simulator, context = started(system, state=at(0.1234, -0.0561))
    simulator.AdvanceTo(H / 2)
    np.testing.assert_allclose(output(system, context)[:2], [0.12, -0.06])


def test_encoder_velocities_follow_with_their_filter() -> None:
    """A steady rate is found, late by the low pass, never from the true velocity."""
    system = encoders(JointEncoderParams(resolution=0.0, bandwidth=50.0))
    simulator, context = started(system, state=at(0.1, 0.2))
    for k in range(1, 41):
        state = at(0.1 + 2.0 * k * H, 0.2)
        system.GetInputPort("state").FixValue(context, state)
        simulator.AdvanceTo((k - 0.5) * H)
        if k == 2:
            assert 0.5 < output(system, context)[2] < 1.9
    np.testing.assert_allclose(output(system, context)[2:], [2.0, 0.0], atol=1e-6)


def test_samples_arrive_late() -> None:
    """By so many steps of the plant."""
    system = encoders(JointEncoderParams(resolution=0.0, latency=3 * H))
    simulator, context = started(system, state=at(1.0, 1.0))
    simulator.AdvanceTo(1.5 * H)
    np.testing.assert_array_equal(output(system, context)[:2], [0.1, 0.2])
    simulator.AdvanceTo(2.5 * H)
    np.testing.assert_array_equal(output(system, context)[:2], [1.0, 1.0])


def test_an_encoder_sticks() -> None:
    """The one that is named, from when on it does."""
    params = JointEncoderParams(resolution=0.0, stuck_joints=["knee"], sticks_at=0.01)
    system = encoders(params)
    simulator, context = started(system, state=at(0.5, 0.5))
    simulator.AdvanceTo(0.009)
    system.GetInputPort("state").FixValue(context, at(0.7, 0.7))
    simulator.AdvanceTo(0.02)
    np.testing.assert_array_equal(output(system, context)[:2], [0.7, 0.5])


def ankles(**params: float) -> AnkleForceSensors:
    """The robot's."""
    plant, instance = robot_alone()
    return AnkleForceSensors(AnkleForceParams(**params), H, plant, instance, JVRC1)


def test_ankles_take_the_level_foot_off() -> None:
    """Nothing borne but the hanging foot: no ground; else its wrench about F."""
    plant, instance = robot_alone()
    system = ankles(
        force_noise=0.0, moment_noise=0.0, force_offset=0.0, moment_offset=0.0
    )
    foot = plant.GetBodyByName(JVRC1.foot_bodies["left"], instance)
    weight = foot.default_mass() * 9.81
    forces = [SpatialForce.Zero()] * plant.num_joints()
    index = next(
        int(plant.get_joint(i).index())
        for i in plant.GetJointIndices(instance)
        if plant.get_joint(i).child_body().index() == foot.index()
    )
    p_AFoot = foot.default_com()
    hanging = np.array([0.0, 0.0, weight])
    forces[index] = SpatialForce(np.cross(p_AFoot, hanging), hanging)
    simulator, context = started(system, reaction_forces=forces)
    simulator.AdvanceTo(H / 2)
    np.testing.assert_allclose(output(system, context)[:6], 0.0, atol=1e-9)
    # 100 N upward 5 cm before F.
    down = hanging - np.array([0.0, 0.0, 100.0])
    about = np.cross(p_AFoot, hanging) - np.cross([0.05, 0.0, 0.0], [0.0, 0.0, 100.0])
    forces[index] = SpatialForce(about, down)
    system.GetInputPort("reaction_forces").FixValue(context, forces)
    simulator.AdvanceTo(1.5 * H)
    expected = [0.0, 0.0, 100.0, 0.0, -5.0, 0.0]
    np.testing.assert_allclose(output(system, context)[:6], expected, atol=1e-9)


@pytest.mark.parametrize(
    "params",
    [
        ImuParams(gyroscope_noise=-1.0),
        ImuParams(latency=1.0),
        JointEncoderParams(bandwidth=0.0),
        AnkleForceParams(force_noise=np.nan),
    ],
)
def test_parameters_out_of_range_are_refused(params: ImuParams) -> None:
    """By name."""
    with pytest.raises(ValueError, match=r"^\w+: must"):
        params.validate()
