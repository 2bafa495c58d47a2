"""A climb of two steps as evidence, of which it is known what became of it.

It has seven moments of a second each, sampled at 100 Hz; in the last, which goes on for
a fifth longer, the robot rests on the top tread.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from pydrake.math import RigidTransform

from footfall.diagrams.judge.evidence import Evidence, Limits
from footfall.diagrams.judge.true_motion import TrueMotion, sole_corners_F
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector

WEIGHT = 600.0
TREADS = StaircaseParams(steps=2, rise=0.2, run=0.27, x=0.3).treads()
PLACES = {
    "floor": (0.0, 0.0),
    "step 1": (0.40, 0.2),
    "step 2": (0.67, 0.4),
}
TIME: Vector = np.arange(721) * 0.01
"""When there are samples, s."""
SAMPLES = len(TIME)


def held(moments: Sequence | Vector) -> Vector:
    """Seven moments, each for as long as it lasts, (n, ...)."""
    return np.asarray(moments)[np.minimum(TIME.astype(int), 6)]


def motion_of(left: list[str], right: list[str], base: float = 0.85) -> TrueMotion:
    """A robot whose feet are at these places, one a moment."""
    poses = {
        foot: held(
            np.stack(
                [
                    RigidTransform(
                        np.array([PLACES[p][0], y, PLACES[p][1]])
                    ).GetAsMatrix4()
                    for p in places
                ]
            )
        )
        for foot, places, y in (("left", left, 0.1), ("right", right, -0.1))
    }
    middle = (poses["left"][:, :3, 3] + poses["right"][:, :3, 3]) / 2.0
    corners_F = sole_corners_F(JVRC1.sole)
    return TrueMotion(
        time=TIME,
        com=middle + np.array([0.0, 0.0, 0.8]),
        com_velocity=np.zeros((SAMPLES, 3)),
        base=middle + np.array([0.0, 0.0, base]),
        torso_up=np.ones(SAMPLES),
        sole_corners={
            foot: poses[foot][:, None, :3, 3] + corners_F[None] for foot in FEET
        },
        X_WF=poses,
    )


def frame(columns: Vector) -> pd.DataFrame:
    """A signal with a row a sample."""
    return pd.DataFrame(np.column_stack([TIME, columns]))


def wrenches(left: list[float], right: list[float]) -> pd.DataFrame:
    """Normal forces of each moment, in weights, at the soles' origins."""
    both = np.zeros((SAMPLES, 12))
    both[:, 2], both[:, 8] = held(left) * WEIGHT, held(right) * WEIGHT
    return frame(both)


LEFT = ["floor", "floor", "step 1", "step 1", "step 2", "step 2", "step 2"]
RIGHT = ["floor", "floor", "floor", "floor", "floor", "step 2", "step 2"]
LOADS = ([0.5, 0.0, 0.5, 0.0, 1.0, 0.5, 0.5], [0.5, 1.0, 0.5, 1.0, 0.0, 0.5, 0.5])


def climb_evidence() -> Evidence:
    """Two steps climbed: the left foot by one, then by two, the right one follows."""
    torque = np.zeros((SAMPLES, 2))
    torque[300, 1] = -80.0
    return Evidence(
        stop="finished",
        stop_reason="at the top",
        kind="stair_climbing",
        motion=motion_of(LEFT, RIGHT),
        joint_velocities={
            "HIP": np.full(SAMPLES, 1.0),
            "KNEE": np.full(SAMPLES, -6.0),
        },
        frames={
            "station.foot_wrenches": wrenches(*LOADS),
            "plant.net_actuation": frame(torque),
            "station.torque_wanted": frame(1.5 * torque),
            "contact_monitor.impact": frame(np.full((SAMPLES, 2), 1.1 * WEIGHT)),
            "contact_monitor.friction_ratio": frame(np.full((SAMPLES, 1), 0.25)),
            "contact_monitor.other_support": frame(np.zeros((SAMPLES, 1))),
            "speed_monitor.peak_speeds": frame(np.tile([1.0, 6.5], (SAMPLES, 1))),
        },
        treads=TREADS,
        limits=Limits(
            torque={"HIP": 100.0, "KNEE": 100.0},
            speed={"HIP": 10.0, "KNEE": 10.0},
            weight=WEIGHT,
        ),
        friction=0.8,
        touches=(),
        activities=((0.0, "scan"), (1.0, "move"), (2.0, "scan"), (2.5, "move")),
    )
