"""Tracking with varying height: against a dense solution, Kajita's, and itself."""

import numpy as np
import pytest

from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ZmpPreviewParams,
    cart,
    generate,
    preview_gains,
)
from footfall.systems.balance.zmp_tracking import generate_varying_height, height_factor

T = 0.005
PARAMS = ZmpPreviewParams()


def stairs(ticks: int = 2000) -> tuple[np.ndarray, np.ndarray]:
    """Reference and height factor of six steps of 27 x 20 cm, 1 s each, from 2 s."""
    times = np.arange(ticks) * T - 2.0
    steps = np.clip(np.floor(times) + 1, 0, 7)
    y = np.where((steps > 0) & (steps < 7), 0.1 * (-1.0) ** steps, 0.0)
    phase = np.clip(times, 0.0, 6.0)
    # A climb of 0.2 m a second with a ripple, and the ground it climbs over.
    z = 0.75 + 0.2 * phase - 0.02 * np.cos(2.0 * np.pi * phase) + 0.02
    zdd = 0.02 * (2.0 * np.pi) ** 2 * np.cos(2.0 * np.pi * phase)
    zdd[(times < 0.0) | (times > 6.0)] = 0.0
    c = height_factor(z, 0.2 * np.clip(steps - 0.5, 0.0, 6.0), zdd)
    return np.column_stack([0.27 * steps, y]), c


def away_from_jumps(reference: np.ndarray, margin: float) -> np.ndarray:
    """Which ticks are further than `margin` seconds from any jump."""
    times = np.arange(len(reference)) * T
    jumps = np.flatnonzero(np.abs(np.diff(reference, axis=0)).max(axis=1) > 0.0) + 1
    return (np.abs(times[:, None] - times[jumps]) > margin).all(axis=1)


@pytest.mark.parametrize("weighted", [False, True])
def test_it_is_the_optimum_of_a_dense_programme(weighted: bool) -> None:
    """Jerks as unknowns, states by simulation, KKT system dense: another route."""
    ticks = 240
    rng = np.random.default_rng(0)
    c = 0.08 + 0.02 * np.sin(np.arange(ticks) * 0.05)
    reference = np.repeat(rng.uniform(-0.2, 0.2, (4, 2)), ticks // 4, axis=0)
    start = np.array([[0.05, 0.1, 0.2], [-0.02, -0.1, 0.4]])
    weight = np.geomspace(1e-3, 1.0, ticks) if weighted else np.ones(ticks)
    motion = generate_varying_height(
        reference, c, PARAMS, start, weight if weighted else None
    )

    A, B = cart(T)
    free, forced = [np.eye(3)], [np.zeros((3, ticks))]
    for tick in range(ticks - 1):
        free.append(A @ free[-1])
        response = A @ forced[-1]
        response[:, tick] += B
        forced.append(response)
    row = np.column_stack([np.ones(ticks), np.zeros(ticks), -c])
    Z = np.einsum("ns,nst->nt", row, forced)
    Z0 = np.einsum("ns,nst->nt", row, free)
    keep = np.ones(ticks, bool)
    keep[-1] = False  # the last jerk acts after the end
    D = (np.eye(ticks) - np.eye(ticks, k=-1))[:, keep]
    Z, last = Z[:, keep], forced[-1][:, keep]
    # Conditioning: unknowns in units of 100 m/s^3.
    unit = 100.0
    H = unit**2 * (Z.T @ (weight[:, None] * Z) + PARAMS.jerk_weight * D.T @ D)
    kkt = np.block([[H, unit * last.T], [unit * last, np.zeros((3, 3))]])
    goal = np.zeros((3, 2))
    goal[0] = reference[-1]
    rhs = np.vstack(
        [
            unit * Z.T @ (weight[:, None] * (reference - Z0 @ start.T)),
            goal - free[-1] @ start.T,
        ]
    )
    jerk = unit * np.linalg.solve(kkt, rhs)[:-3]
    com = np.einsum("nt,ti->ni", np.array(forced)[:, 0, keep], jerk)
    com += np.einsum("ns,si->ni", np.array(free)[:, 0], start.T)
    np.testing.assert_allclose(motion.com, com, atol=1e-8)
    np.testing.assert_allclose(motion.jerk[:-1], jerk, atol=1e-3)


def test_at_constant_height_it_reproduces_kajita() -> None:
    """The same cost, so the same motion but for what lies beyond 1.6 s of preview."""
    reference, _ = stairs()
    c = np.full(len(reference), PARAMS.com_height / GRAVITY)
    tracked = generate_varying_height(reference, c, PARAMS)
    previewed = generate(preview_gains(PARAMS), reference)
    assert np.abs(tracked.com - previewed.com).max() < 1e-3


def test_on_stairs_the_zmp_is_on_its_reference_within_a_millimetre() -> None:
    """With the ZMP recomputed from CoM and acceleration."""
    reference, c = stairs()
    motion = generate_varying_height(reference, c, PARAMS)
    zmp = motion.com - c[:, None] * motion.acceleration
    np.testing.assert_allclose(motion.zmp, zmp, atol=1e-12)
    error = np.abs(zmp - reference)[away_from_jumps(reference, 0.06)]
    assert error.max() < 1e-3
    constant = generate(preview_gains(PARAMS), reference)
    wrong = constant.com - c[:, None] * constant.acceleration - reference
    assert np.abs(wrong[away_from_jumps(reference, 0.06)]).max() > 0.01


def test_the_motion_is_that_of_a_triple_integrator() -> None:
    """Position, velocity, acceleration and jerk fit; both ends are as asked."""
    reference, c = stairs()
    start = np.array([[0.01, 0.02, 0.1], [0.0, -0.03, 0.05]])
    motion = generate_varying_height(reference, c, PARAMS, start)
    A, B = cart(T)
    states = np.stack([motion.com, motion.velocity, motion.acceleration], axis=2)
    following = states @ A.T + motion.jerk[:, :, None] * B
    np.testing.assert_allclose(following[:-1], states[1:], atol=1e-9)
    np.testing.assert_allclose(states[0], start, atol=1e-9)
    np.testing.assert_allclose(motion.com[-1], reference[-1], atol=1e-12)
    np.testing.assert_allclose(states[-1, :, 1:], 0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("ticks", "c", "field"),
    [
        (2, np.ones(2), "zmp_ref"),
        (9, np.ones(8), "height_factor"),
        (9, np.zeros(9), "height_factor"),
    ],
)
def test_what_is_no_plan_is_refused(ticks: int, c: np.ndarray, field: str) -> None:
    """Too short, of another length, or without height."""
    with pytest.raises(ValueError, match=f"{field}: must"):
        generate_varying_height(np.zeros((ticks, 2)), c, PARAMS)


def test_a_weight_that_is_none_is_refused() -> None:
    """Of another length, or zero."""
    for weight in (np.ones(8), np.zeros(9)):
        with pytest.raises(ValueError, match="weight: must"):
            generate_varying_height(np.zeros((9, 2)), np.ones(9), PARAMS, weight=weight)
