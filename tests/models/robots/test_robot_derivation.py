"""What a description leaves out is read off its URDF."""

import dataclasses
from pathlib import Path

import pytest

from footfall.diagrams.robots.robot_files import load_robot
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot import RobotModel, Sole
from footfall.models.robots.robot_derivation import robot_model, spelt_out, stance_of
from tests.models.robots.biped import (
    ANKLE,
    HALF_WIDTH,
    HEEL,
    HIP,
    LEG,
    SHANK,
    THIGH,
    TOE,
    write_biped,
)


@pytest.fixture
def biped(tmp_path: Path) -> RobotModel:
    """Of three lines of YAML."""
    return load_robot(write_biped(tmp_path))


def test_names_are_those_of_the_tree(biped: RobotModel) -> None:
    """Pelvis, trunk, legs, knees; the file gives the robot its name."""
    assert (biped.name, biped.base_body, biped.torso_body) == (
        "biped",
        "pelvis",
        "torso",
    )
    assert biped.leg_joints["right"] == tuple(f"r_{name}" for name in LEG)
    assert biped.knee_joints == {"left": "l_knee", "right": "r_knee"}
    assert biped.head_body is None
    assert biped.swing_joints == ()


def test_lengths_are_measured(biped: RobotModel) -> None:
    """Sole, leg and stance are the URDF's own."""
    sole = biped.sole
    assert (sole.toe, sole.heel) == pytest.approx((TOE, HEEL))
    assert (sole.half_width, sole.ankle_height) == pytest.approx((HALF_WIDTH, ANKLE))
    assert biped.leg_reach == pytest.approx(0.97 * (THIGH + SHANK), abs=1e-3)
    assert biped.stance_width == pytest.approx(2 * HIP)
    assert biped.standing_com[0] == pytest.approx((TOE - HEEL) / 2)
    assert biped.standing_com[1] == pytest.approx(stance_of(biped).com[1], abs=1e-3)
    assert 0.6 < biped.standing_com[1] < 1.0
    assert biped.working_range["l_knee"] == (0.2, 2.4)


def test_mimics_are_fixed_and_the_rest_is_driven(biped: RobotModel) -> None:
    """Fingers too, unless they are welded by name."""
    assert set(biped.welded_joints) == {"l_thumb", "r_thumb"}
    assert set(biped.gains) == set(biped.limits)
    assert {"l_finger", "l_shoulder", "waist"} <= set(biped.gains)
    assert len(biped.gains) == 12 + 1 + 2 * 2


def test_default_servos_have_soft_ankles_in_proportion(biped: RobotModel) -> None:
    """To weight times leg length, as JVRC-1's are."""
    moment = 9.81 * (THIGH + SHANK) * mass(biped) / 457.0
    assert biped.gains["l_knee"].stiffness == pytest.approx(1000.0 * moment, abs=0.1)
    assert biped.gains["l_ankle_p"].stiffness == pytest.approx(150.0 * moment, abs=0.1)


def mass(robot: RobotModel) -> float:
    """Of the biped, kg."""
    return 9.0 + 14.0 + 2 * (4.0 + 2.5 + 1.0 + 3 * 0.3 + 2.0 + 0.2)


def test_what_is_said_counts_before_what_is_derived(tmp_path: Path) -> None:
    """Groups: the last that names a joint; welded joints stay where the posture is."""
    file = write_biped(tmp_path)
    with file.open("a") as more:
        more.write(
            """
sole: {heel: 0.05, toe: 0.1, half_width: 0.03, ankle_height: 0.08}
standing_com: [0.01, 0.7]
head_body: eye
swing_joints: ["?_shoulder"]
welded_joints: ["l_finger"]
servos:
  - {joints: ["*"], stiffness: 300, damping: 30}
  - {joints: [l_knee], stiffness: 500, damping: 50}
limits: [{joints: [waist], speed: 2.0}]
"""
        )
    text = file.read_text().replace("-0.40}", "-0.40, l_finger: 0.5}")
    file.write_text(text)
    robot = load_robot(file)
    assert robot.sole == Sole(0.05, 0.1, 0.03, 0.08)
    assert robot.standing_com == (0.01, 0.7)
    assert robot.head_body == "eye"
    assert robot.swing_joints == ("l_shoulder", "r_shoulder")
    assert robot.welded_at == {"l_finger": 0.5}
    assert "l_finger" not in robot.posture
    assert robot.gains["l_knee"].stiffness == 500.0
    assert robot.gains["r_knee"].stiffness == 300.0
    assert (robot.limits["waist"].speed, robot.limits["waist"].effort) == (2.0, 120.0)


@pytest.mark.parametrize("which", ["biped", "jvrc1"])
def test_what_is_spelt_out_reads_back_the_same(which: str, tmp_path: Path) -> None:
    """Nothing of it is left to derive."""
    robot = JVRC1 if which == "jvrc1" else load_robot(write_biped(tmp_path))
    description = spelt_out(robot)
    description.validate()
    empty = [
        item.name
        for item in dataclasses.fields(description)
        if getattr(description, item.name) is None
    ]
    assert empty == ([] if robot.head_body else ["head_body"])
    assert robot_model(description, tmp_path / "robot.yaml") == robot
