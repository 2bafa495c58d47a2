"""Words in place of fields."""

import pytest

from footfall.diagrams.fields.words import IDEAL
from footfall.diagrams.scenario import load_scenario


@pytest.mark.parametrize("sensor", IDEAL)
def test_an_ideal_sensor(sensor: str) -> None:
    """Every field that the word stands for; the others stay."""
    scenario = load_scenario("stairs-exp1", [f"sensors.{sensor}=ideal"])
    params = getattr(scenario.sensors, sensor)
    for name, value in IDEAL[sensor].items():
        assert getattr(params, name) == value
    usual = getattr(load_scenario("stairs-exp1").sensors, sensor)
    assert params != usual


@pytest.mark.parametrize(("said", "state"), [("true", "true"), ("false", "estimated")])
def test_the_true_state_in_yaml(said: str, state: str) -> None:
    """True and false are no texts there."""
    scenario = load_scenario("stand", [f"robot.state={said}"])
    assert scenario.robot.state == state
