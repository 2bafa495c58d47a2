"""Where package:// leads."""

from pathlib import Path

import jvrc_description
import pytest

from footfall.models.robots.package_paths import find_file


@pytest.fixture
def urdf(tmp_path: Path) -> Path:
    """A URDF two folders below the package that it names."""
    for name in ("mine/urdf", "mine/meshes", "other"):
        (tmp_path / name).mkdir(parents=True)
    for name in ("mine/urdf/r.urdf", "mine/meshes/a.stl", "other/a.stl"):
        (tmp_path / name).write_text("")
    return tmp_path / "mine/urdf/r.urdf"


@pytest.mark.parametrize(
    ("uri", "found"),
    [
        ("package://mine/meshes/a.stl", "mine/meshes/a.stl"),
        ("package:///mine/meshes/a.stl", "mine/meshes/a.stl"),
        ("package://other/a.stl", "other/a.stl"),
        ("../meshes/a.stl", "mine/meshes/a.stl"),
    ],
)
def test_packages_lie_about_the_urdf(urdf: Path, uri: str, found: str) -> None:
    """And relative paths start beside it."""
    root = urdf.parents[2]
    assert find_file(uri, urdf, {}).resolve() == (root / found).resolve()


def test_what_is_said_counts_first(urdf: Path) -> None:
    """Before what lies about."""
    packages = {"mine": urdf.parents[2] / "other"}
    assert find_file("package://mine/a.stl", urdf, packages).parent.name == "other"


@pytest.mark.parametrize("variable", ["ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"])
def test_ros_is_asked(tmp_path: Path, monkeypatch, variable: str) -> None:
    """A folder of packages, or one with share/ in it."""
    share = tmp_path / "ros" / ("share" if variable.startswith("AMENT") else "")
    (share / "far").mkdir(parents=True)
    (share / "far/a.stl").write_text("")
    monkeypatch.setenv(variable, str(tmp_path / "ros"))
    beside = tmp_path / "elsewhere/r.urdf"
    assert find_file("package://far/a.stl", beside, {}) == share / "far/a.stl"


def test_installed_python_packages_are_found(tmp_path: Path) -> None:
    """As that of JVRC-1."""
    found = find_file(
        "package://jvrc_description/urdf/jvrc1.urdf", tmp_path / "r.yaml", {}
    )
    assert found == Path(jvrc_description.urdf_path)


def test_what_is_not_there_is_told(urdf: Path) -> None:
    """Package or file."""
    with pytest.raises(ValueError, match="there is no package 'none'"):
        find_file("package://none/a.stl", urdf, {})
    with pytest.raises(ValueError, match=r"there is no file .*lost.stl"):
        find_file("package://mine/lost.stl", urdf, {})
