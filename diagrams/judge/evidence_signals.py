"""What a run's evidence says of its ground, its feet and its falls, pure."""

import numpy as np
import pandas as pd

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.falls import Fall, find_fall
from footfall.diagrams.judge.ground import Ground, end_ground
from footfall.models.scenes.tread import Tread
from footfall.models.values.feet import Foot
from footfall.models.values.vector import Vector

CLIMBING = "stair_climbing"
"""The kind of task that ends on the top tread; every other ends on the floor."""
EDGE = 0.02
"""Before its first sample and after its last a signal is taken as it was there for no
longer than this, s."""


def task_treads(evidence: Evidence) -> tuple[Tread, ...]:
    """Lists the treads of the staircase to be climbed; none in another task."""
    return evidence.treads if evidence.kind == CLIMBING else ()


def last_ground(evidence: Evidence) -> Ground:
    """Finds what both soles should stand on in the end: the top tread, or the floor."""
    return end_ground(task_treads(evidence))


def foot_wrenches(evidence: Evidence) -> dict[Foot, Vector] | None:
    """Reads each foot's true contact wrench at `motion.time`, (n, 6)."""
    frame = evidence.frames.get("station.foot_wrenches")
    if frame is None:
        return None
    both = signal_at(evidence.motion.time, frame)
    return {"left": both[:, :6], "right": both[:, 6:12]}


def signal_at(time: Vector, frame: pd.DataFrame) -> Vector:
    """Samples a signal's columns at other times, (n, columns); nan where not logged."""
    samples = frame.to_numpy(dtype=np.float64)
    if not len(samples):
        return np.full((len(time), samples.shape[1] - 1), np.nan)
    columns = [np.interp(time, samples[:, 0], column) for column in samples[:, 1:].T]
    values: Vector = np.stack(columns, axis=1)
    values[(time < samples[0, 0] - EDGE) | (time > samples[-1, 0] + EDGE)] = np.nan
    return values


def foot_loads(evidence: Evidence) -> dict[Foot, Vector] | None:
    """Upward force on each foot at `motion.time`, (n,), N; None where unknown."""
    wrenches = foot_wrenches(evidence)
    if wrenches is None:
        return None
    return {
        foot: upward_force(evidence, foot, wrench) for foot, wrench in wrenches.items()
    }


def fall(evidence: Evidence) -> Fall | None:
    """Finds the first sign of a fall; None where there is none."""
    frame = evidence.frames.get("contact_monitor.other_support")
    if frame is None:
        nothing: Vector = np.zeros(0)
        return find_fall(evidence.motion, nothing, nothing)
    samples = frame.to_numpy(dtype=np.float64)
    return find_fall(
        evidence.motion, samples[:, 0], samples[:, 1] / evidence.limits.weight
    )


def upward_force(evidence: Evidence, foot: Foot, wrench: Vector) -> Vector:
    """Upward part of the force on a foot, (n,), N."""
    R_WF = evidence.motion.X_WF[foot][:, :3, :3]
    upward: Vector = np.einsum("nj,nj->n", R_WF[:, 2, :], wrench[:, :3])
    return upward


def felt_forces(evidence: Evidence) -> dict[Foot, Vector] | None:
    """Mean upward force on each foot at `motion.time`, (n,), N."""
    frame = evidence.frames.get("contact_monitor.foot_forces")
    if frame is None:
        return None
    both = signal_at(evidence.motion.time, frame)
    return {"left": both[:, 2], "right": both[:, 5]}
