"""The signals of a walking task: those that the design names, with their units."""

import numpy as np
import pytest

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import load_run
from footfall.diagrams.simulation import run_task

EXPECTED = {
    "plant.state": 39 + 38,
    "plant.net_actuation": 32,
    "station.torque_command": 32,
    "station.torque_wanted": 32,
    "station.foot_wrenches": 12,
    "contact_monitor.foot_forces": 6,
    "contact_monitor.other_support": 1,
    "contact_monitor.impact": 2,
    "contact_monitor.friction_ratio": 1,
    "stabilizer.foot_wrenches": 12,
    "balance_state.com": 3,
    "reference.com": 9,
    "balance_state.zmp": 3,
    "reference.zmp": 3,
    "balance_state.dcm": 2,
    "reference.dcm": 2,
    "stabilizer.zmp_command": 2,
    "feet.true": 12,
    "feet.wanted": 24,
    "motion_player.contacts": 4,
    "landing_adaptor.contacts": 4,
}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory):
    """A run of a fifth of a second, read back."""
    folder = tmp_path_factory.mktemp("signals") / "run"
    scenario = load_scenario("stairs-exp1", ["simulation.max_time=0.2"])
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


def test_all_are_there_every_5_ms(run) -> None:
    """With a column an element and a unit each."""
    assert set(run.signals) >= set(EXPECTED)
    rows = len(run.signals["plant.state"])
    assert rows >= 40
    for name, size in EXPECTED.items():
        frame = run.signals[name]
        assert frame.shape == (rows, 1 + size), name
        np.testing.assert_allclose(np.diff(frame["time"]), 0.005, err_msg=name)
        units = frame.attrs["units"]
        assert set(units) == set(frame.columns)
        assert units["time"] == "s"
        assert all(units.values()), name


def test_abstract_signals_are_there(run) -> None:
    """What the executive does, what touches."""
    assert {"executive.status", "contact_monitor.touches"} <= set(run.value_names)
    assert run.values("contact_monitor.touches")[-1][1] == {"touches": []}


def test_columns_hold_what_they_are_called(run) -> None:
    """State by joint, wrenches and feet by side, in their units."""
    state = run.signals["plant.state"]
    knee = state["L_KNEE_q"]
    assert state.attrs["units"]["L_KNEE_q"] == "rad"
    assert 0.3 < knee.iloc[0] < 1.5
    base = [name for name in state.columns if name.endswith("_z")]
    assert state[base[0]].iloc[0] == pytest.approx(0.8, abs=0.15)
    feet = run.signals["feet.true"]
    assert feet["left_y"].iloc[-1] == pytest.approx(0.095, abs=2e-3)
    assert feet["right_y"].iloc[-1] == pytest.approx(-0.095, abs=2e-3)
    assert feet.attrs["units"]["left_yaw"] == "rad"
    wrenches = run.signals["station.foot_wrenches"]
    assert wrenches.attrs["units"]["right_mx"] == "N m"
    total = (wrenches["left_fz"] + wrenches["right_fz"]).iloc[-1]
    assert total == pytest.approx(62.4 * 9.81, rel=0.05)
    torque = run.signals["plant.net_actuation"]
    assert abs(torque["L_KNEE"].iloc[-1]) > 10.0
    reference = run.signals["reference.com"]
    assert reference["z"].iloc[0] == pytest.approx(0.85)
    assert reference.attrs["units"]["az"] == "m/s^2"
