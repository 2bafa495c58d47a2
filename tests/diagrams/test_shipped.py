"""The scenarios that are shipped, listed without loading them."""

from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.shipped import list_scenarios, shipped_scenarios


def test_descriptions_are_those_of_the_loaded_scenarios() -> None:
    """Each has one, and it is what the file says."""
    listed = list_scenarios()
    assert [name for name, _ in listed] == sorted(shipped_scenarios())
    for name, description in listed:
        assert description
        assert load_scenario(name).description == description
