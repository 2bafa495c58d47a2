"""Preview control against independent solutions of the same problem."""

import numpy as np
import pytest

from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ZmpPreviewParams,
    generate,
    preview_gains,
    preview_step,
    rest_error_sum,
    rest_state,
)

T = 0.005
PARAMS = ZmpPreviewParams()
GAINS = preview_gains(PARAMS)


def walk(ticks: int = 2000, origin: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Six steps of 0.3 m and 0.8 s from 2 s on, feet 0.2 m apart."""
    steps = np.clip(np.floor((np.arange(ticks) * T - 2.0) / 0.8) + 1, 0, 7)
    y = np.where((steps > 0) & (steps < 7), 0.1 * (-1.0) ** steps, 0.0)
    return np.column_stack([0.3 * steps, y]) + origin


def away_from_jumps(reference: np.ndarray, margin: float = 0.05) -> np.ndarray:
    """Which ticks are further than `margin` seconds from any jump."""
    times = np.arange(len(reference)) * T
    jumps = np.flatnonzero(np.abs(np.diff(reference, axis=0)).max(axis=1) > 0.0) + 1
    return (np.abs(times[:, None] - times[jumps]) > margin).all(axis=1)


def test_feedback_gains_are_those_of_value_iteration() -> None:
    """The Riccati recursion from zero, run long, gives the same feedback."""
    C, A, B = GAINS.C, GAINS.A, GAINS.B
    A_s = np.block([[np.ones((1, 1)), (C @ A)[None]], [np.zeros((3, 1)), A]])
    B_s = np.array([C @ B, *B])
    P = np.zeros((4, 4))
    for _ in range(4000):
        K = B_s @ P @ A_s / (PARAMS.jerk_weight + B_s @ P @ B_s)
        P = np.diag([1.0, 0, 0, 0]) + A_s.T @ P @ (A_s - np.outer(B_s, K))
    np.testing.assert_allclose([GAINS.G_i, *GAINS.G_x], K, rtol=1e-6)


def test_preview_gains_are_the_optimal_answer_to_a_jump_ahead() -> None:
    """-G_p(j) is the first jerk of a least-squares plan for a jump j ticks ahead."""
    ticks = 500
    C, A, B = GAINS.C, GAINS.A, GAINS.B
    # Responses of p(1), p(2), ... and of the state to a step of the jerk at tick 0.
    x, states = np.zeros(3), []
    for _ in range(ticks):
        x = A @ x + B
        states.append(x)
    response = np.array(states) @ C
    S = np.zeros((ticks, ticks))
    for column in range(ticks):
        S[column:, column] = response[: ticks - column]
    # Without an end at rest a finite plan would track best by falling over.
    end = 1e3 * np.array(states[::-1]).T
    stacked = np.vstack([S, np.sqrt(PARAMS.jerk_weight) * np.eye(ticks), end])
    ahead = np.array([1, 2, 5, 20, 60, 150])
    goal = np.vstack(
        [
            np.arange(1, ticks + 1)[:, None] >= ahead,
            np.zeros((ticks, len(ahead))),
            1e3 * np.eye(3)[:, :1] * np.ones(len(ahead)),
        ]
    )
    plan = np.linalg.lstsq(stacked, goal, rcond=None)[0]
    np.testing.assert_allclose(-GAINS.G_p[ahead - 1], plan[0], rtol=1e-4)


def test_zmp_follows_away_from_jumps() -> None:
    """Kajita's parameters: 2.5 mm outside 50 ms of a jump of 0.3 m."""
    reference = walk()
    motion = generate(GAINS, reference)
    error = np.abs(motion.zmp - reference)[away_from_jumps(reference)]
    assert error.max() < 0.0026
    recomputed = motion.com - PARAMS.com_height / GRAVITY * motion.acceleration
    np.testing.assert_allclose(motion.zmp, recomputed, atol=1e-12)


def test_generate_is_preview_step_repeated() -> None:
    """The banded solution equals the loop, from any start."""
    reference = walk(700)
    start = np.array([[0.02, 0.1, -0.3], [-0.01, 0.05, 0.2]])
    motion = generate(GAINS, reference, start)
    padded = np.vstack([reference, np.repeat(reference[-1:], GAINS.horizon, axis=0)])
    state, error_sum = start, rest_error_sum(GAINS, reference[0])
    for tick in range(len(reference)):
        np.testing.assert_allclose(motion.com[tick], state[:, 0], atol=1e-11)
        np.testing.assert_allclose(motion.velocity[tick], state[:, 1], atol=1e-10)
        np.testing.assert_allclose(motion.acceleration[tick], state[:, 2], atol=1e-9)
        window = padded[tick : tick + GAINS.horizon + 1].T
        state, error_sum, jerk = preview_step(GAINS, state, error_sum, window)
        np.testing.assert_allclose(motion.jerk[tick], jerk, atol=1e-7)


def test_the_motion_does_not_depend_on_where_the_walk_starts() -> None:
    """The finite preview does not pull the CoM to the world's origin."""
    here = generate(GAINS, walk())
    there = generate(GAINS, walk(origin=(4.0, -3.0)))
    np.testing.assert_allclose(there.com - [4.0, -3.0], here.com, atol=1e-9)
    rest = generate(GAINS, np.full((400, 2), 2.0))
    np.testing.assert_allclose(rest.com, 2.0, atol=1e-12)


def test_it_stops_on_the_last_zmp() -> None:
    """After the last step the CoM comes to rest over the reference."""
    motion = generate(GAINS, walk(4000))
    np.testing.assert_allclose(motion.com[-1], [2.1, 0.0], atol=1e-4)
    np.testing.assert_allclose(motion.velocity[-1], 0.0, atol=1e-4)


def test_a_disturbed_state_comes_back() -> None:
    """The loop is stable: 5 cm and 0.2 m/s off, at rest over the ZMP in 3 s."""
    state = rest_state(np.zeros(2))
    state[0, :2] = 0.05, 0.2
    motion = generate(GAINS, np.zeros((600, 2)), state)
    assert np.abs(motion.com[-1]).max() < 1e-4


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"period": 0.0}, "period"),
        ({"com_height": -0.8}, "com_height"),
        ({"preview_time": 0.001}, "preview_time"),
        ({"jerk_weight": float("nan")}, "jerk_weight"),
        ({"state_weight": [0.0, 1.0]}, "state_weight"),
    ],
)
def test_parameters_out_of_range_are_refused(change: dict, field: str) -> None:
    """Each says which field, why, and what it got."""
    with pytest.raises(ValueError, match=f"{field}: must .* got"):
        preview_gains(ZmpPreviewParams(**change))


@pytest.mark.parametrize(
    "reference", [np.zeros((0, 2)), np.zeros(5), np.full((5, 2), np.nan)]
)
def test_references_of_another_shape_are_refused(reference: np.ndarray) -> None:
    """Before any arithmetic."""
    with pytest.raises(ValueError, match="zmp_ref: must"):
        generate(GAINS, reference)
