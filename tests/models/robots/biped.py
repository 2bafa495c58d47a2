"""A biped of boxes with whatever URDFs come with, written to a folder for a test."""

from pathlib import Path

import trimesh

THIGH, SHANK, ANKLE = 0.36, 0.34, 0.08
"""Hip to knee, knee to ankle, ankle to sole, m."""
HIP = 0.09
"""Hip from the middle, m."""
TOE, HEEL, HALF_WIDTH = 0.14, 0.08, 0.045
"""Of the foot's box, m."""
LEG = ("hip_p", "hip_r", "hip_y", "knee", "ankle_r", "ankle_p")
DESCRIPTION = """
urdf: biped.urdf
foot_bodies: {left: l_ankle_p_link, right: r_ankle_p_link}
posture: {"?_hip_p": -0.42, "?_knee": 0.82, "?_ankle_p": -0.40}
"""


def write_biped(folder: Path, *, transmissions: bool = False) -> Path:
    """Writes URDF, meshes and description; gives the description's path.

    A floating joint carries the pelvis, the shoulders turn for ever, a finger mimics
    another, the shanks are one mesh and its mirror image, all else is boxes, and a
    material has two colours.
    """
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    shank = trimesh.creation.box([0.06, 0.05, SHANK - 0.08])
    shank.apply_translation([0.0, 0.02, -SHANK / 2])
    shank.export(folder / "meshes/shank.stl")
    text = _robot(transmissions)
    (folder / "biped.urdf").write_text(text, encoding="utf-8")
    (folder / "biped.yaml").write_text(DESCRIPTION, encoding="utf-8")
    return folder / "biped.yaml"


def _robot(transmissions: bool) -> str:
    parts = [
        '<link name="world"/>',
        _joint("root", "world", "pelvis", "0 0 0", "floating"),
        _link("pelvis", 9.0, _box("0.14 0.16 0.10", "0 0 0.08", colour="0.2 0.2 0.2")),
        _joint("waist", "pelvis", "torso", "0 0 0.18", "revolute", "0 0 1"),
        _link("torso", 14.0, _box("0.16 0.24 0.36", "0 0 0.2", colour="0.5 0.5 0.5")),
        _joint("eye_mount", "torso", "eye", "0.1 0 0.45"),
        '<link name="eye"/>',
        '<link name="unused"/>',
        _joint("unused_mount", "torso", "unused", "0 0 0"),
    ]
    for side, y in (("l", 1.0), ("r", -1.0)):
        parts += [*_leg(side, y), *_arm(side, y)]
    if transmissions:
        parts += [_transmission(f"{side}_{name}") for side in "lr" for name in LEG]
    return f'<?xml version="1.0"?>\n<robot name="biped">{"".join(parts)}</robot>\n'


def _leg(side: str, y: float) -> list[str]:
    at = {
        "hip_p": f"0 {y * HIP} 0",
        "knee": f"0 0 {-THIGH}",
        "ankle_r": f"0 0 {-SHANK}",
    }
    axes = {"p": "0 1 0", "r": "1 0 0", "y": "0 0 1", "knee": "0 1 0"}
    sole = f"{(TOE - HEEL) / 2} 0 {-ANKLE / 2}"
    size = f"{TOE + HEEL} {2 * HALF_WIDTH} {ANKLE}"
    mesh = f'<mesh filename="meshes/shank.stl" scale="1 {y:g} 1"/>'
    shapes = {
        "hip_y": (4.0, _box(f"0.07 0.07 {THIGH - 0.1}", f"0 0 {-THIGH / 2}")),
        "knee": (2.5, f"<visual><geometry>{mesh}</geometry></visual>"),
        "ankle_p": (1.0, _box(size, sole)),
    }
    parts, parent = [], "pelvis"
    for name in LEG:
        mass, shape = shapes.get(name, (0.3, ""))
        link = f"{side}_{name}_link"
        axis = axes[name.rpartition("_")[2]]
        joint = f"{side}_{name}"
        where = at.get(name, "0 0 0")
        parts += [
            _joint(joint, parent, link, where, "revolute", axis),
            _link(link, mass, shape),
        ]
        parent = link
    return parts


def _arm(side: str, y: float) -> list[str]:
    return [
        _joint(
            f"{side}_shoulder", "torso", f"{side}_arm", f"0 {y * 0.18} 0.3",
            "continuous", "0 1 0",
        ),
        _link(f"{side}_arm", 2.0, _cylinder(0.03, 0.4, "0 0 -0.2")),
        _joint(
            f"{side}_finger", f"{side}_arm", f"{side}_finger_link", "0 0 -0.42",
            "revolute", "0 1 0",
        ),
        _link(f"{side}_finger_link", 0.1, _sphere(0.02)),
        _joint(
            f"{side}_thumb", f"{side}_arm", f"{side}_thumb_link", "0.02 0 -0.42",
            "revolute", "0 1 0", mimic=f"{side}_finger",
        ),
        _link(f"{side}_thumb_link", 0.1, _sphere(0.02)),
    ]  # fmt: skip


def _joint(
    name: str,
    parent: str,
    child: str,
    xyz: str,
    kind: str = "fixed",
    axis: str = "1 0 0",
    mimic: str = "",
) -> str:
    limit = '<limit effort="120" velocity="9" lower="-2.4" upper="2.4"/>'
    if kind == "continuous":
        limit = '<limit effort="60" velocity="8"/>'
    follow = f'<mimic joint="{mimic}" multiplier="1"/>' if mimic else ""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{child}"/><origin xyz="{xyz}"/><axis xyz="{axis}"/>'
        f'{limit}{follow}<dynamics friction="1" damping="0.1"/></joint>'
    )


def _link(name: str, mass: float, shape: str) -> str:
    i = 0.01 * mass
    return (
        f'<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="{i}" '
        f'iyy="{i}" izz="{i}" ixy="0" ixz="0" iyz="0"/></inertial>{shape}</link>'
    )


def _box(size: str, xyz: str, colour: str = "") -> str:
    shape = f'<origin xyz="{xyz}"/><geometry><box size="{size}"/></geometry>'
    paint = f'<color rgba="{colour} 1"/>' if colour else ""
    return f'<visual>{shape}<material name="grey">{paint}</material></visual>'


def _cylinder(radius: float, length: float, xyz: str) -> str:
    shape = f'<cylinder radius="{radius}" length="{length}"/>'
    return f'<visual><origin xyz="{xyz}"/><geometry>{shape}</geometry></visual>'


def _sphere(radius: float) -> str:
    shape = f'<geometry><sphere radius="{radius}"/></geometry>'
    return f"<visual>{shape}</visual><collision>{shape}</collision>"


def _transmission(joint: str) -> str:
    return (
        f'<transmission name="{joint}_t"><type>transmission_interface/'
        f'SimpleTransmission</type><joint name="{joint}"><hardwareInterface>'
        f"EffortJointInterface</hardwareInterface></joint>"
        f'<actuator name="{joint}_m"><mechanicalReduction>1</mechanicalReduction>'
        f"</actuator></transmission>"
    )
