"""Fig. 2: the maps are drawn as they were computed."""

import numpy as np

from footfall.diagrams.figures.feasibility_view import feasibility_figure
from footfall.models.values.obstacle import KeyConfiguration
from footfall.systems.planning.crossing.feasibility_maps import FeasibilityMaps


def test_each_map_has_its_panel_and_the_key_its_place() -> None:
    """Quasi-static first; cells lie about their step length and waist height."""
    X, Z = np.array([0.3, 0.4, 0.5]), np.array([0.6, 0.7])
    begin, end = np.array([[1.0, 0, 0], [1, 1, 0]]), np.array([[1.0, 0, 0], [0, 0, 0]])
    maps = FeasibilityMaps(X, Z, begin, np.ones((2, 3)), end, 1.0 - begin)
    key = KeyConfiguration(0.4, 0.2, 0.6, 0.2)
    axes = feasibility_figure(maps, "a robot", key).axes
    shown = [ax.collections[0] for ax in axes]
    for mesh, expected in zip(
        shown, (begin, np.ones((2, 3)), end, 1.0 - begin), strict=True
    ):
        np.testing.assert_array_equal(np.ravel(mesh.get_array()), expected.ravel())
    corners = shown[0].get_coordinates()
    np.testing.assert_allclose(corners[0, :, 0], [0.25, 0.35, 0.45, 0.55])
    np.testing.assert_allclose(corners[:, 0, 1], [0.55, 0.65, 0.75])
    assert "50 %" in axes[0].get_title()
    assert "Eq. 8" in axes[2].get_title()
    (mark,) = axes[3].get_lines()
    assert np.ravel(mark.get_data()).tolist() == [0.4, 0.6]
    assert not any(ax.get_lines() for ax in axes[:3])


def test_without_a_key_nothing_is_marked() -> None:
    """Where the feasibility unit refuses."""
    X, Z = np.array([0.3, 0.4]), np.array([0.6, 0.7])
    none = np.zeros((2, 2))
    axes = feasibility_figure(FeasibilityMaps(X, Z, none, none, none, none), "x").axes
    assert not any(ax.get_lines() or ax.texts for ax in axes)
