"""Scenes from files: what is touched, what is climbed, and what is refused."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.scene_model import SceneModelParams
from footfall.models.scenes.solids import triangle_mesh
from tests.models.scenes.scene_meshes import block_steps, box, joined, profile_steps

SDF = """<?xml version="1.0"?>
<sdf version="1.9"><model name="rail"><static>true</static>
<link name="bar"><pose>0.4 0.4 0.9 0 -0.64 0</pose>
<collision name="c"><geometry><box><size>1.2 0.05 0.05</size></box></geometry>
</collision></link>
<link name="post"><pose>0 0.4 0.25 0 0 0</pose>
<collision name="c"><geometry><cylinder><radius>0.03</radius><length>0.5</length>
</cylinder></geometry></collision></link>
<link name="seat"><pose>2 0 0.2 0 0 0</pose>
<collision name="c"><geometry><sphere><radius>0.2</radius></sphere></geometry>
</collision></link></model></sdf>"""


def tread_figures(params: SceneModelParams) -> list[list[float]]:
    """Middle and size of every tread, m."""
    return [
        [*tread.X_WR.translation(), *tread.size]
        for tread in SceneParams(models=[params]).treads()
    ]


def test_every_format_and_scale_is_the_same_staircase(tmp_path: Path) -> None:
    """In metres, in millimetres, z up and y up, one surface or a block a step."""
    mesh = profile_steps([0.2] * 3, [0.27] * 3)
    upright = trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0])
    files = {
        "metres.stl": (mesh, {}),
        "blocks.stl": (block_steps(), {}),
        "millimetres.stl": (mesh.copy().apply_scale(1000.0), {"scale": 0.001}),
        "upright.glb": (mesh.copy().apply_transform(upright), {}),
        "upright.obj": (mesh.copy().apply_transform(upright), {"roll": np.pi / 2}),
    }
    want = [[0.6 + 0.27 * (n + 0.5), 0.1, 0.2 * (n + 1), 0.27, 0.5] for n in range(3)]
    for name, (content, options) in files.items():
        content.export(tmp_path / name)
        params = SceneModelParams(file=str(tmp_path / name), x=0.6, y=0.1, **options)
        np.testing.assert_allclose(tread_figures(params), want, atol=1e-6, err_msg=name)
        solids = params.solids()
        assert {solid.role for solid in solids} == {"stairs"}
        surface = triangle_mesh(solids)
        whole = trimesh.Trimesh(surface.vertices, surface.triangles)
        assert whole.volume == pytest.approx(mesh.volume, rel=1e-6), name


def test_a_model_is_what_it_collides_with(tmp_path: Path) -> None:
    """Each shape where its link is; none of it to stand on, so none may be touched."""
    file = tmp_path / "rail.sdf"
    file.write_text(SDF)
    params = SceneModelParams(name="rail", file=str(file), x=1.0, yaw=np.pi / 2)
    solids = {solid.name: solid for solid in params.solids()}
    names = ["rail/bar/c/piece_1", "rail/post/c/piece_1", "rail/seat/c/piece_1"]
    assert sorted(solids) == names
    assert {solid.role for solid in solids.values()} == {"structure"}
    post = solids[names[1]].vertices
    np.testing.assert_allclose(post.min(axis=0), [0.57, -0.03, 0.0], atol=1e-6)
    np.testing.assert_allclose(post.max(axis=0), [0.63, 0.03, 0.5], atol=1e-6)
    scene = SceneParams(models=[params])
    assert scene.treads() == ()
    assert scene.ground_names() == {"room/floor"}


def test_what_is_neither_level_nor_convex_is_taken_in_near_pieces(
    tmp_path: Path,
) -> None:
    """A ramp beside a block: the block's top is a tread, the ramp none."""
    ramp = trimesh.convex.convex_hull(
        np.array([[0, 2, 0], [1, 2, 0], [0, 3, 0], [1, 3, 0], [1, 2, 0.3], [1, 3, 0.3]])
    )
    joined(ramp, box([0, 0, 0], [1, 1, 0.2])).export(tmp_path / "yard.stl")
    params = SceneModelParams(file=str(tmp_path / "yard.stl"))
    roles = [solid.role for solid in params.solids()]
    assert sorted(roles) == ["stairs", "structure"]
    np.testing.assert_allclose(
        tread_figures(params), [[0.5, 0.5, 0.2, 1.0, 1.0]], atol=1e-6
    )


def write_open(path: Path) -> None:
    """A box without a face."""
    mesh = box([0, 0, 0], [1, 1, 1])
    mesh.update_faces(np.arange(len(mesh.faces)) > 1)
    mesh.export(path)


def write_bowl(path: Path) -> None:
    """Hollow and round: no convex pieces come near."""
    outer, inner = (
        trimesh.creation.icosphere(3, 0.5),
        trimesh.creation.icosphere(3, 0.49),
    )
    inner.invert()
    trimesh.util.concatenate([outer, inner]).export(path)


@pytest.mark.parametrize(
    ("name", "write", "message"),
    [
        ("a.stl", None, r"file: .*a\.stl: no such file"),
        ("a.txt", None, r"file: must end with \.stl, .*\.urdf, got 'a\.txt'"),
        ("a.stl", write_open, r"must be a closed surface.*open along 4 edges"),
        ("a.stl", write_bowl, r"convex pieces stand off it by .* cm"),
        ("a.stl", lambda p: p.write_text("solid a\nendsolid a"), r"has no triangles"),
        ("a.sdf", lambda p: p.write_text("<sdf"), r"a\.sdf: cannot be read: "),
        (
            "a.urdf",
            lambda p: p.write_text('<robot name="a"><link name="b"/></robot>'),
            r"a\.urdf: has no collision geometry",
        ),
    ],
)
def test_a_file_that_cannot_be_used_is_told(
    tmp_path: Path, name: str, write, message: str
) -> None:
    """In one line, with its name."""
    if write is not None:
        write(tmp_path / name)
    with pytest.raises(ValueError, match=message) as told:
        SceneModelParams(file=str(tmp_path / name)).validate()
    assert "\n" not in str(told.value)


def test_names_are_unique(tmp_path: Path) -> None:
    """A contact could not be traced otherwise."""
    block_steps().export(tmp_path / "a.stl")
    twice = [SceneModelParams(file=str(tmp_path / "a.stl"))] * 2
    with pytest.raises(ValueError, match=r"models\[1\]\.name: must be unique"):
        SceneParams(models=twice).validate()
    far = SceneModelParams(file=str(tmp_path / "a.stl"), x=5.0)
    with pytest.raises(ValueError, match=r"models\[0\]: must lie inside the room"):
        SceneParams(models=[far]).validate()
