"""The summary: what it says of perception and timing, and that it is plain JSON."""

import json

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.diagrams.judge.summary import (
    Summary,
    installed_versions,
    perception_summary,
    timing_us,
)
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.perceived import PlaneSegment, PlaneSegmentation, Staircase

TREADS = StaircaseParams(steps=2, rise=0.2, run=0.27, width=0.5, x=0.4).treads()
REQUIRED = (
    *("scenario", "outcome", "reason", "seed", "simulated_time_s", "wall_time_s"),
    *("real_time_factor", "footsteps", "steps_climbed", "obstacles_crossed"),
    *("goal_error_m", "max_torque_fraction", "max_speed_fraction"),
    *("min_zmp_margin_m", "max_dcm_error_m", "com_rms_error_m", "max_foot_slip_m"),
    *("max_impact_body_weights", "min_clearance_m", "perception", "timing_us"),
    "versions",
)


def seen(dx: float, dz: float, tilt: float = 0.0) -> PlaneSegment:
    """The first tread, seen with a front edge, height and tilt that are off."""
    X_WR = RigidTransform(
        RollPitchYaw(tilt, 0.0, 0.0),
        TREADS[0].X_WR.translation() + np.array([dx, 0.0, dz]),
    )
    return PlaneSegment(
        polygon=np.zeros((0, 3)),
        X_WR=X_WR,
        size=np.array([0.27, 0.5]),
        normal=np.array(X_WR.rotation().col(2)),
        area=0.1,
        support_count=100,
    )


def test_every_field_of_the_design_is_there(tmp_path) -> None:
    """What was not measured is null."""
    summary = Summary(
        scenario="s",
        outcome="fell",
        reason="slipped",
        seed=3,
        simulated_time_s=1.0,
        wall_time_s=2.0,
        real_time_factor=0.5,
        max_foot_slip_m=np.float64(0.02),
        min_clearance_m=float("nan"),
    )
    summary.write(tmp_path / "summary.json")
    data = json.loads((tmp_path / "summary.json").read_text())
    assert set(REQUIRED) <= set(data)
    assert list(data)[:4] == ["scenario", "outcome", "reason", "seed"]
    assert data["max_foot_slip_m"] == 0.02
    assert data["min_clearance_m"] is None
    assert data["perception"] is None


def test_perception_is_measured_against_the_true_treads() -> None:
    """Mean and worst error, median time by stage."""
    frames = [
        PlaneSegmentation(
            staircase=Staircase((seen(dx, dz, tilt),)),
            times_ms=(("normals", ms), ("merge", 2.0)),
        )
        for dx, dz, tilt, ms in (
            (0.01, 0.004, 0.0, 10.0),
            (-0.03, -0.002, np.deg2rad(2.0), 30.0),
            (0.0, 0.0, 0.0, 14.0),
        )
    ]
    data = perception_summary(frames, [], TREADS)
    assert data["frames"] == 3
    assert data["ms_per_frame"] == {"normals": 14.0, "merge": 2.0, "total": 16.0}
    errors = data["errors"]
    assert errors["treads"] == 3
    assert errors["max_height_m"] == pytest.approx(0.004)
    assert errors["mean_height_m"] == pytest.approx(0.002)
    assert errors["max_front_edge_m"] == pytest.approx(0.03)
    assert errors["max_normal_deg"] == pytest.approx(2.0)


def test_perception_that_did_not_run_is_none() -> None:
    """And without a true staircase there are no errors."""
    assert perception_summary([], [Staircase()], TREADS) is None
    frame = PlaneSegmentation(staircase=Staircase((seen(0.0, 0.0),)))
    assert perception_summary([frame], [], [])["errors"] is None


def test_staircases_serve_where_frames_were_not_logged() -> None:
    """Their errors are known, how long they took is not."""
    data = perception_summary([], [Staircase(), Staircase((seen(0.0, 0.01),))], TREADS)
    assert data["errors"]["max_height_m"] == pytest.approx(0.01)
    assert data["frames"] is None
    assert data["ms_per_frame"] is None


def test_timing_names_the_systems(standing) -> None:
    """Median, 99th percentile and count, only of what ran."""
    task = standing.task()
    assert timing_us(task.diagram) == {}
    context = task.diagram.CreateDefaultContext()
    for time in (0.0, 0.1, 0.2):
        context.SetTime(time)
        task.task_status(context)
    timing = timing_us(task.diagram)
    assert set(timing) == {"executive"}
    assert timing["executive"]["calls"] == 3
    assert 0.0 < timing["executive"]["median"] <= timing["executive"]["p99"]


def test_versions_name_what_the_result_hangs_on() -> None:
    """At least these."""
    assert {"python", "footfall", "drake", "numpy"} <= set(installed_versions())
