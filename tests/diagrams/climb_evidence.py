"""A climb of two steps as evidence, of which it is known what became of it."""

import numpy as np
import pandas as pd
from pydrake.math import RigidTransform

from diagrams.evidence import Evidence, Limits
from diagrams.true_motion import TrueMotion, sole_corners_F
from models.jvrc1 import JVRC1
from models.staircase import StaircaseParams
from systems.values import FEET

WEIGHT = 600.0
TREADS = StaircaseParams(steps=2, rise=0.2, run=0.27, x=0.3).treads()
PLACES = {
    "floor": (0.0, 0.0),
    "step 1": (0.40, 0.2),
    "step 2": (0.67, 0.4),
}


def motion_of(left: list[str], right: list[str], base: float = 0.85) -> TrueMotion:
    """A robot whose feet are at these places, a sample each."""
    poses = {
        foot: np.stack(
            [
                RigidTransform(np.array([PLACES[p][0], y, PLACES[p][1]])).GetAsMatrix4()
                for p in places
            ]
        )
        for foot, places, y in (("left", left, 0.1), ("right", right, -0.1))
    }
    middle = (poses["left"][:, :3, 3] + poses["right"][:, :3, 3]) / 2.0
    count = len(left)
    corners_F = sole_corners_F(JVRC1.sole)
    return TrueMotion(
        time=np.arange(count, dtype=float),
        com=middle + np.array([0.0, 0.0, 0.8]),
        base=middle + np.array([0.0, 0.0, base]),
        torso_up=np.ones(count),
        sole_corners={
            foot: poses[foot][:, None, :3, 3] + corners_F[None] for foot in FEET
        },
        X_WF=poses,
    )


def frame(columns: np.ndarray) -> pd.DataFrame:
    """A signal sampled once a second."""
    data = np.column_stack([np.arange(len(columns), dtype=float), columns])
    return pd.DataFrame(data)


def wrenches(left: list[float], right: list[float]) -> pd.DataFrame:
    """Normal forces, in weights, at the soles' origins."""
    both = np.zeros((len(left), 12))
    both[:, 2], both[:, 8] = np.array(left) * WEIGHT, np.array(right) * WEIGHT
    return frame(both)


LEFT = ["floor", "floor", "step 1", "step 1", "step 2", "step 2", "step 2"]
RIGHT = ["floor", "floor", "floor", "floor", "floor", "step 2", "step 2"]


def climb_evidence() -> Evidence:
    """Two steps climbed: the left foot by one, then by two, the right one follows."""
    loads = wrenches(
        [0.5, 0.0, 0.5, 0.0, 1.0, 0.5, 0.5], [0.5, 1.0, 0.5, 1.0, 0.0, 0.5, 0.5]
    )
    torque = np.zeros((7, 2))
    torque[3, 1] = -80.0
    return Evidence(
        stop="finished",
        stop_reason="at the top",
        motion=motion_of(LEFT, RIGHT),
        joint_velocities={"HIP": np.full(7, 1.0), "KNEE": np.full(7, -6.0)},
        frames={"station.foot_wrenches": loads, "plant.net_actuation": frame(torque)},
        treads=TREADS,
        limits=Limits(
            torque={"HIP": 100.0, "KNEE": 100.0},
            speed={"HIP": 10.0, "KNEE": 10.0},
            weight=WEIGHT,
        ),
        touches=(),
        activities=((0.0, "scan"), (1.0, "move"), (2.0, "scan"), (2.5, "move")),
    )
