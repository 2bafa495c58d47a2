"""The shapes of a URDF's links as triangle meshes in the link's frame.

Meshes are read by trimesh (.stl, .dae, .obj, .glb, ...), their `scale` applied, a
mirroring one too; boxes, cylinders and spheres are made.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

import numpy as np
import trimesh
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from footfall.models.robots.package_paths import find_file
from footfall.models.robots.urdf import numbers, pose_of
from footfall.models.values.vector import Vector

Use: TypeAlias = Literal["visual", "collision"]

Z_UP_TO_Y_UP = np.array(
    [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
)
"""glTF's y points up; readers turn it back."""
SEGMENTS = 32
"""Sides of the prism that stands for a cylinder."""


@dataclass(frozen=True)
class MeshSource:
    """A mesh file and how large it is taken."""

    file: Path
    scale: tuple[float, float, float]
    """Negative ones mirror."""


@dataclass(frozen=True, eq=False)
class LinkShape:
    """One `visual` or `collision` of a link."""

    element: ET.Element
    """Of the URDF."""
    primitive: trimesh.Trimesh | None
    """A box, cylinder or sphere, about its own origin."""
    source: MeshSource | None
    """Where it is a mesh."""
    X_LS: Vector
    """Pose in the link, (4, 4)."""
    colour: tuple[float, float, float, float] | None
    """RGBA that the URDF gives it."""

    def mesh(self) -> trimesh.Trimesh:
        """Gives the surface in the link's frame.

        Raises:
            ValueError: the file holds no triangles.
        """
        if self.primitive is not None:
            mesh = self.primitive.copy()
        else:
            joined = self.scene().to_geometry()
            if not isinstance(joined, trimesh.Trimesh) or not len(joined.faces):
                file = "" if self.source is None else self.source.file
                raise ValueError(f"{file}: has no triangles")
            mesh = joined
        mesh.apply_transform(self.X_LS)
        return mesh

    def scene(self) -> trimesh.Scene:
        """Loads the mesh with its materials, scaled, about its own origin, z up."""
        if self.source is None:
            raise TypeError("a primitive has no file")
        scene = trimesh.load_scene(self.source.file)
        if self.source.file.suffix.lower() in (".glb", ".gltf"):
            scene.apply_transform(Z_UP_TO_Y_UP.T)  # type: ignore[no-untyped-call]
        if self.source.scale != (1.0, 1.0, 1.0):
            scene = _scaled(scene, self.source.scale)
        if self.colour is not None:
            _paint(scene, self.colour)
        return scene


def link_shapes(
    link: ET.Element,
    use: Use,
    urdf: Path,
    packages: Mapping[str, Path],
    colours: Mapping[str, tuple[float, float, float, float]],
) -> list[LinkShape]:
    """Finds the shapes of one link, none where it has none.

    Args:
        link: of the URDF.
        use: which.
        urdf: the file, relative to which mesh files may be named.
        packages: folders of packages by name.
        colours: RGBA of the URDF's materials by name.

    Raises:
        ValueError: "link NAME: visual: reason" of the first that cannot be read.
    """
    shapes = []
    for element in link.findall(use):
        try:
            shapes.append(_shape(element, urdf, packages, colours))
        except ValueError as error:
            raise ValueError(f"link {link.get('name')}: {use}: {error}") from None
    return shapes


def material_colours(
    root: ET.Element,
) -> dict[str, tuple[float, float, float, float]]:
    """RGBA of the materials that a URDF defines, by name; of two the first counts."""
    colours: dict[str, tuple[float, float, float, float]] = {}
    for material in root.iter("material"):
        colour = colour_of(material)
        if colour is not None:
            colours.setdefault(material.get("name", ""), colour)
    return colours


def colour_of(material: ET.Element) -> tuple[float, float, float, float] | None:
    """RGBA of a material; None where it only has a name."""
    colour = material.find("color")
    if colour is None:
        return None
    r, g, b, a = numbers(colour.get("rgba"), "1 1 1 1")
    return float(r), float(g), float(b), float(a)


def _shape(
    element: ET.Element,
    urdf: Path,
    packages: Mapping[str, Path],
    colours: Mapping[str, tuple[float, float, float, float]],
) -> LinkShape:
    geometry = element.find("geometry")
    shape = None if geometry is None else next(iter(geometry), None)
    if shape is None:
        raise ValueError("has no geometry")
    primitive, source = None, None
    if shape.tag == "mesh":
        scale = numbers(shape.get("scale"), "1 1 1")
        if scale.shape == (1,):
            scale = np.repeat(scale, 3)
        if scale.shape != (3,) or not np.all(scale):
            raise ValueError(f"scale: must be three numbers, got {shape.get('scale')}")
        source = MeshSource(
            find_file(shape.get("filename", ""), urdf, packages),
            (float(scale[0]), float(scale[1]), float(scale[2])),
        )
    elif shape.tag == "box":
        primitive = trimesh.creation.box(numbers(shape.get("size"), "0 0 0"))
    elif shape.tag == "cylinder":
        primitive = trimesh.creation.cylinder(
            radius=float(shape.get("radius", "0")),
            height=float(shape.get("length", "0")),
            sections=SEGMENTS,
        )
    elif shape.tag == "sphere":
        primitive = trimesh.creation.icosphere(
            subdivisions=3, radius=float(shape.get("radius", "0"))
        )
    else:
        raise ValueError(
            f"a <{shape.tag}> is not read: must be a mesh, box, cylinder or sphere"
        )
    X: Vector = pose_of(element).GetAsMatrix4()
    return LinkShape(element, primitive, source, X, _colour(element, colours))


def _colour(
    element: ET.Element, colours: Mapping[str, tuple[float, float, float, float]]
) -> tuple[float, float, float, float] | None:
    material = element.find("material")
    if material is None:
        return None
    return colour_of(material) or colours.get(material.get("name", ""))


def _scaled(scene: trimesh.Scene, scale: tuple[float, float, float]) -> trimesh.Scene:
    """Scales the vertices of a scene.

    As a node's transform a mirror would leave the triangles inside out.
    """
    parts = scene.dump()
    for part in parts:
        part.apply_transform(np.diag([*scale, 1.0]))
    return trimesh.Scene(parts)


def _paint(scene: trimesh.Scene, rgba: tuple[float, float, float, float]) -> None:
    """Gives the parts that have no colour of their own the URDF's."""
    for part in scene.geometry.values():
        if isinstance(part, trimesh.Trimesh) and not getattr(
            part.visual, "defined", False
        ):
            material = PBRMaterial(  # type: ignore[no-untyped-call]
                baseColorFactor=[*rgba], metallicFactor=0.1
            )
            part.visual = TextureVisuals(material=material)  # type: ignore[no-untyped-call]
