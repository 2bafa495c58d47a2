"""Words that a scenario may say in place of fields: an ideal sensor, the true state."""

from copy import deepcopy
from typing import Any

from footfall.diagrams.schema import Mapping

IDEAL: dict[str, dict[str, Any]] = {
    "imu": {
        "gyroscope_noise": 0.0,
        "accelerometer_noise": 0.0,
        "gyroscope_bias": 0.0,
        "accelerometer_bias": 0.0,
        "gyroscope_walk": 0.0,
        "accelerometer_walk": 0.0,
        "latency": 0.0,
    },
    "encoders": {"resolution": 0.0, "bandwidth": 1e5, "latency": 0.0},
    "ankles": {
        "force_noise": 0.0,
        "moment_noise": 0.0,
        "force_offset": 0.0,
        "moment_offset": 0.0,
        "latency": 0.0,
    },
    "lidar": {"noise": 0.0, "relative_noise": 0.0},
    "camera": {"noise_near": 0.0, "noise_far": 0.0},
}
"""By sensor, what `ideal` stands for."""


def expand_words(data: Mapping) -> None:
    """Writes `sensors.NAME: ideal`, and `robot.state: true` or false, as fields.

    Args:
        data: of a scenario; changed in place.
    """
    sensors = data.get("sensors")
    for name, fields in IDEAL.items():
        if isinstance(sensors, dict) and sensors.get(name) == "ideal":
            sensors[name] = deepcopy(fields)
    robot = data.get("robot")
    if isinstance(robot, dict) and isinstance(robot.get("state"), bool):
        robot["state"] = "true" if robot["state"] else "estimated"
