"""Shapes of links: every kind of file and primitive, scaled, mirrored, placed."""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
import trimesh

from footfall.models.robots.link_geometry import link_shapes

SIZE = (0.1, 0.2, 0.4)


def surface(folder: Path, shape: str, origin: str = "") -> trimesh.Trimesh:
    """What is seen of a link with one visual."""
    text = (
        f"<link name='l'><visual>{origin}<geometry>{shape}</geometry></visual></link>"
    )
    (found,) = link_shapes(ET.fromstring(text), "visual", folder / "r.urdf", {}, {})
    return found.mesh()


def wedge() -> trimesh.Trimesh:
    """A box with one corner drawn out: no mirror image is the same."""
    mesh = trimesh.creation.box(SIZE)
    mesh.vertices[np.argmax(mesh.vertices @ [1.0, 1.0, 1.0])] += [0.1, 0.2, 0.3]
    return mesh


@pytest.mark.parametrize("suffix", ["stl", "obj", "dae", "glb"])
def test_mesh_files_of_every_kind(tmp_path: Path, suffix: str) -> None:
    """The y of glTF points up: what is exported so is z up in the link."""
    mesh = wedge()
    if suffix == "glb":
        mesh.apply_transform(
            trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0])
        )
    mesh.export(tmp_path / f"part.{suffix}")
    found = surface(tmp_path, f'<mesh filename="part.{suffix}"/>')
    np.testing.assert_allclose(found.bounds, wedge().bounds, atol=1e-6)


def test_a_mirrored_mesh_is_mirrored_and_not_inside_out(tmp_path: Path) -> None:
    """Scale 1 -2 1: y changes its side, and the volume stays positive."""
    wedge().export(tmp_path / "part.stl")
    found = surface(tmp_path, '<mesh filename="part.stl" scale="1 -2 1"/>')
    low, high = wedge().bounds * [1.0, -2.0, 1.0]
    np.testing.assert_allclose(found.bounds, np.sort([low, high], axis=0), atol=1e-6)
    assert found.volume == pytest.approx(2.0 * wedge().volume)


@pytest.mark.parametrize(
    ("shape", "size"),
    [
        ('<box size="0.1 0.2 0.4"/>', SIZE),
        ('<cylinder radius="0.1" length="0.4"/>', (0.2, 0.2, 0.4)),
        ('<sphere radius="0.1"/>', (0.2, 0.2, 0.2)),
    ],
)
def test_primitives(tmp_path: Path, shape: str, size: tuple[float, ...]) -> None:
    """Placed by their origin."""
    origin = '<origin xyz="1 2 3"/>'
    found = surface(tmp_path, shape, origin)
    np.testing.assert_allclose(found.extents, size, atol=2e-3)
    np.testing.assert_allclose(found.bounds.mean(axis=0), [1.0, 2.0, 3.0], atol=1e-6)


@pytest.mark.parametrize(
    ("shape", "reason"),
    [
        ('<mesh filename="lost.stl"/>', "there is no file"),
        ('<mesh filename="part.stl" scale="1 ${y} 1"/>', "could not convert"),
        ('<mesh filename="part.stl" scale="1 0 1"/>', "scale: must be three numbers"),
        ("<torus/>", "a <torus> is not read"),
        ("", "has no geometry"),
    ],
)
def test_what_cannot_be_read_is_named(tmp_path: Path, shape: str, reason: str) -> None:
    """By link and use."""
    wedge().export(tmp_path / "part.stl")
    with pytest.raises(ValueError, match=f"link l: visual: .*{reason}"):
        surface(tmp_path, shape)
