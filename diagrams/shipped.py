"""The scenarios that come with footfall, as they lie in the package."""

from importlib import resources

from footfall.diagrams.schema import parse_yaml


def list_scenarios() -> tuple[tuple[str, str], ...]:
    """Name and description of every shipped scenario, by name."""
    return tuple(
        (name, parse_yaml(text)["description"])
        for name, text in sorted(shipped_scenarios().items())
    )


def shipped_scenarios() -> dict[str, str]:
    """YAML text of every shipped scenario by name."""
    folder = resources.files("footfall.diagrams.scenarios")
    return {
        item.name.removesuffix(".yaml"): item.read_text(encoding="utf-8")
        for item in folder.iterdir()
        if item.name.endswith(".yaml")
    }
