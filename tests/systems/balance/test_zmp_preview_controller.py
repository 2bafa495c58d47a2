"""The preview controller's shell: one tick, a whole walk, a reset."""

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.systems.balance.zmp_preview import (
    ZmpPreviewParams,
    generate,
    preview_step,
)
from footfall.systems.balance.zmp_preview_controller import ZmpPreviewController

PARAMS = ZmpPreviewParams(preview_time=1.0)


def value(system: ZmpPreviewController, context: Context, port: str) -> np.ndarray:
    """What a port shows."""
    return np.array(system.GetOutputPort(port).Eval(context))


def test_a_walk_in_the_simulator_is_the_core_s_walk() -> None:
    """Fed tick by tick, the outputs are `generate`'s rows."""
    system = ZmpPreviewController(PARAMS)
    N = system.gains.horizon
    reference = np.zeros((400, 2))
    reference[100:] = 0.3, -0.1
    expected = generate(system.gains, reference)
    padded = np.vstack([reference, np.repeat(reference[-1:], N, axis=0)])
    context = system.CreateDefaultContext()
    simulator = Simulator(system, context)
    for tick in range(300):
        window = padded[tick : tick + N + 1].T
        system.GetInputPort("zmp_preview").FixValue(context, window.ravel())
        for port, rows in (
            ("com", expected.com),
            ("com_velocity", expected.velocity),
            ("com_acceleration", expected.acceleration),
            ("zmp", expected.zmp),
        ):
            np.testing.assert_allclose(
                value(system, context, port), rows[tick], atol=1e-9
            )
        simulator.AdvanceTo((tick + 1) * PARAMS.period - 1e-6)
        simulator.AdvancePendingEvents()
    assert expected.com[299, 0] > 0.2


def test_reset_starts_from_the_measured_motion() -> None:
    """The tick after a reset is one step on from the measurement; no flag, no reset."""
    system = ZmpPreviewController(PARAMS, initial_com=(1.0, 2.0))
    context = system.CreateDefaultContext()
    np.testing.assert_array_equal(value(system, context, "com"), [1.0, 2.0])
    window = np.tile([[0.5], [0.1]], (1, system.gains.horizon + 1))
    system.GetInputPort("zmp_preview").FixValue(context, window.ravel())
    reset = system.GetInputPort("reset")
    reset.FixValue(context, [1.0, 0.5, 0.1, 0.0, 0.0])
    Simulator(system, context).AdvanceTo(PARAMS.period / 2)
    np.testing.assert_allclose(value(system, context, "com"), [0.5, 0.1], atol=1e-12)
    np.testing.assert_allclose(value(system, context, "com_velocity"), 0.0, atol=1e-9)

    context = system.CreateDefaultContext()
    system.GetInputPort("zmp_preview").FixValue(context, window.ravel())
    reset.FixValue(context, [1.0, 0.4, 0.1, 0.2, -0.1])
    Simulator(system, context).AdvanceTo(PARAMS.period / 2)
    state = np.array([[0.4, 0.2, 0.0], [0.1, -0.1, 0.0]])
    drift = -(system.gains.G_x[0] + system.gains.G_p.sum()) / system.gains.G_i
    expected, _, _ = preview_step(system.gains, state, drift * window[:, 0], window)
    np.testing.assert_allclose(value(system, context, "com"), expected[:, 0])

    context = system.CreateDefaultContext()
    rest = np.tile([[1.0], [2.0]], (1, system.gains.horizon + 1))
    system.GetInputPort("zmp_preview").FixValue(context, rest.ravel())
    reset.FixValue(context, [0.0, 0.5, 0.1, 0.0, 0.0])
    Simulator(system, context).AdvanceTo(PARAMS.period / 2)
    np.testing.assert_allclose(value(system, context, "com"), [1.0, 2.0], atol=1e-9)


def test_outputs_do_not_depend_on_inputs() -> None:
    """No direct feedthrough, so the loop may be closed around it."""
    assert not ZmpPreviewController(PARAMS).HasAnyDirectFeedthrough()


def test_parameters_are_checked() -> None:
    """Before any port is declared."""
    with pytest.raises(ValueError, match="com_height"):
        ZmpPreviewController(ZmpPreviewParams(com_height=0.0))
