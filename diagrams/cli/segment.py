"""`footfall segment`: finds planes and stairs in a point cloud."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.cloud_options import (
    parse_direction,
    parse_slope,
    parse_viewpoint,
)
from footfall.diagrams.cli.errors import bad_input_in_one_line

SLOPE = 15.0
"""Of the planes that `segment` keeps, deg; what `PlaneSegmenterParams` has."""


def segment(
    cloud: Annotated[
        Path,
        typer.Argument(
            metavar="CLOUD",
            help="Point cloud in metres: .pcd, .ply, .xyz, .txt, .csv, .npy or .npz.",
        ),
    ],
    gravity: Annotated[
        str,
        typer.Option(
            metavar="X,Y,Z", help="Direction of gravity in the cloud's frame."
        ),
    ] = "0,0,-1",
    slope: Annotated[
        float,
        typer.Option(
            metavar="DEG",
            help="Steepest plane that is kept, in degrees from the horizontal.",
        ),
    ] = SLOPE,
    viewpoint: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,Z",
            help="Where the cloud was seen from, in its frame: edges are found between "
            "rays, and what is above it is no plane to step on.",
            show_default=False,
        ),
    ] = None,
    published: Annotated[
        bool,
        typer.Option(
            "--published",
            help="Find them as the stair paper does: normals, voxels, supervoxels, "
            "RANSAC over all, the largest cluster of one size.",
        ),
    ] = False,
    robot: Annotated[
        str | None,
        typer.Option(
            metavar="FILE",
            help="A robot's YAML file: what is smaller than its sole is no plane to "
            "stand on; by default JVRC-1's.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write planes.json and planes.png to; by default "
            "segmented/CLOUD.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Find planes and stairs in a point cloud: JSON, a picture, times."""
    with bad_input_in_one_line():
        from footfall.diagrams.segmenting import segment_file
        from footfall.systems.perception.planes.segmenter_params import (
            PlaneSegmenterParams,
        )

        direction = parse_direction(gravity)
        params = PlaneSegmenterParams(slope_tolerance=parse_slope(slope))
        if published:
            params = params.published()
        eye = None if viewpoint is None else parse_viewpoint(viewpoint)
        target = out or Path("segmented") / cloud.stem
        sole = None
        if robot is not None:
            from footfall.diagrams.robots.robot_files import load_robot

            sole = load_robot(robot).sole
        result = segment_file(cloud, direction, target, params, sole, eye)
    found = result.segmentation
    typer.echo(
        f"{result.points} points: {len(found.planes)} planes, "
        f"{len(found.staircase.treads)} treads"
    )
    for doubt in result.doubts:
        typer.echo(f"  {doubt}")
    for stage, milliseconds in found.times_ms:
        typer.echo(f"  {stage:<16} {milliseconds:8.1f} ms")
    typer.echo(f"{result.planes_json}\n{result.planes_png}")
