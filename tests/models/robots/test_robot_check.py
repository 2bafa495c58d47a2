"""Everything in a robot's file that does not fit its URDF is told by name."""

from pathlib import Path

import pytest

from footfall.diagrams.robots.robot_files import load_robot
from footfall.models.robots.robot_errors import RobotError
from tests.models.robots.biped import DESCRIPTION, write_biped


def problems(
    folder: Path, more: str = "", swap: tuple[str, str] = ("", ""), urdf: str = ""
) -> tuple[str, ...]:
    """What is wrong with the biped after a change of its description or its URDF."""
    file = write_biped(folder)
    file.write_text(DESCRIPTION.replace(*swap) + more, encoding="utf-8")
    if urdf:
        old, new = urdf.split(" => ")
        path = folder / "biped.urdf"
        text = path.read_text("utf-8")
        assert old in text
        path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(RobotError) as raised:
        load_robot(file)
    assert raised.value.robot == str(file) or raised.value.robot.endswith(".urdf")
    return raised.value.problems


@pytest.mark.parametrize(
    ("more", "problem"),
    [
        (
            "base_body: pelvi",
            "base_body: there is no link 'pelvi'; did you mean pelvis?",
        ),
        (
            "base_body: world",
            "base_body: the link 'world' is a frame without mass; is it pelvis?",
        ),
        (
            "base_body: torso",
            "base_body: must be the root of the tree, pelvis, which floats; "
            "got 'torso', which waist carries",
        ),
        ("head_body: head", "head_body: there is no link 'head'"),
        (
            "swing_joints: [l_shoulde]",
            "swing_joints: there is no joint 'l_shoulde' that moves; "
            "did you mean l_shoulder?",
        ),
        (
            "welded_joints: [eye_mount]",
            "welded_joints: the joint 'eye_mount' is fixed and does not move",
        ),
        ("servos: [{joints: []}]", "servos[0].joints: names no joint"),
        ("limits: [{joints: [nose]}]", "limits[0].joints: there is no joint 'nose'"),
        (
            "working_range: {l_knee: [0.1, 2.5]}",
            "working_range.l_knee: must lie within -2.4 and 2.4, got [0.1, 2.5]",
        ),
        (
            "working_range: {l_knee: [2.0, 0.1]}",
            "working_range.l_knee: must be the least and the greatest angle",
        ),
        (
            "welded_joints: [l_knee]",
            "leg_joints.left: l_knee is welded: a leg's joints need motors",
        ),
        (
            "leg_joints: {left: [l_knee], right: [r_knee]}",
            "leg_joints.left: must be what moves from pelvis to l_ankle_p_link, l_hip",
        ),
        ("convex_pieces: {torso: 100}", "convex_pieces.torso: must be between 1 and"),
        ("sole: {heel: -1.0}", "sole.heel: must be positive, got -1 m"),
        ("souls: 1", "souls: no such field"),
        ("head_body: [eye]", "head_body: must be a text, got a list"),
    ],
)
def test_a_field_that_does_not_fit_is_named(
    tmp_path: Path, more: str, problem: str
) -> None:
    """With what it should be."""
    assert any(line.startswith(problem) for line in problems(tmp_path, more))


@pytest.mark.parametrize(
    ("urdf", "problem"),
    [
        (
            'effort="60" => effort="0"',
            "limits: the URDF gives no effort limit above 0 ",
        ),
        (
            'name="waist" type="revolute" => name="waist" type="planar"',
            "urdf: the joint waist is of type 'planar': must be",
        ),
        (
            "meshes/shank.stl => meshes/lost.stl",
            "urdf: link l_knee_link: visual, link r_knee_link: visual: there is no fi",
        ),
        (
            "meshes/shank.stl => package://nowhere/shank.stl",
            "urdf: link l_knee_link: visual, link r_knee_link: visual: there is no "
            "package 'nowhere'",
        ),
        (
            "sphere radius => torus radius",
            "urdf: link l_finger_link: visual, link l_fin",
        ),
        (
            '<parent link="l_arm"/> => <parent link="hand"/>',
            "joint l_finger: there is ",
        ),
        ("</robot> => ", "not XML: "),
        ("robot name => model name", "not XML: "),
    ],
)
def test_a_urdf_that_cannot_be_used_is_told(
    tmp_path: Path, urdf: str, problem: str
) -> None:
    """By link or joint."""
    assert any(line.startswith(problem) for line in problems(tmp_path, urdf=urdf))


def test_everything_is_told_at_once(tmp_path: Path) -> None:
    """So that a user need not come back for each."""
    more = "head_body: hed\nswing_joints: [arm]\nwelded_joints: [toe]"
    found = problems(tmp_path, more, urdf='type="continuous" => type="planar"')
    fields = [line.partition(":")[0] for line in found]
    assert fields == ["head_body", "swing_joints", "welded_joints", "urdf", "urdf"]


def test_wrong_fields_are_told_at_once(tmp_path: Path) -> None:
    """Before anything is looked up in the URDF."""
    found = problems(tmp_path, "souls: 1\nleg_reach: far\n")
    assert len(found) == 2


def test_feet_must_be_the_last_links_that_move_and_level(tmp_path: Path) -> None:
    """A foot that is turned cannot carry the sole as it is said."""
    turned = '<origin xyz="0 0 -0.34"/> => <origin xyz="0 0 -0.34" rpy="0 0 1.57"/>'
    found = problems(tmp_path, urdf=turned)
    assert found[0].startswith("foot_bodies.left: the axes of 'l_ankle_p_link' must be")
    missing = problems(tmp_path, swap=("l_ankle_p_link", "eye"))
    assert "foot_bodies.left: the link 'eye' is a frame without mass; is it torso?" in (
        missing
    )


def test_what_must_be_given_is_asked_for(tmp_path: Path) -> None:
    """The URDF and both feet."""
    file = tmp_path / "empty.yaml"
    file.write_text("name: nobody\n", encoding="utf-8")
    with pytest.raises(
        RobotError, match=r"urdf, foot_bodies.left, foot_bodies.right: "
    ):
        load_robot(file)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("nobody.yaml", "no such file"),
        ("jvrc", "no such robot; there is jvrc1; did you mean jvrc1"),
    ],
)
def test_a_robot_that_is_not_there(tmp_path: Path, name: str, reason: str) -> None:
    """By file or by name."""
    path = tmp_path / name if name.endswith("yaml") else name
    with pytest.raises(RobotError, match=reason):
        load_robot(path)
