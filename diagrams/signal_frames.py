"""The frames that the elements of a run's vector signals are in."""

from collections.abc import Mapping
from types import MappingProxyType

_TRUE = "W, true"
_BELIEVED = "W, as the robot believes"
_JOINT = "each joint's own"
_SOLE = "F, the frame of each sole; moments about its origin"

SIGNAL_FRAMES: Mapping[str, str] = MappingProxyType(
    {
        "plant.state": "W for the pelvis, true; each joint's own",
        "plant.net_actuation": _JOINT,
        "movers.state": _TRUE,
        "station.foot_wrenches": f"{_SOLE}; true",
        "station.torque_command": _JOINT,
        "station.torque_wanted": _JOINT,
        "speed_monitor.peak_speeds": _JOINT,
        "balance_state.com": _TRUE,
        "balance_state.dcm": _BELIEVED,
        "balance_state.zmp": _TRUE,
        "reference.com": _BELIEVED,
        "reference.dcm": _BELIEVED,
        "reference.zmp": _BELIEVED,
        "stabilizer.foot_wrenches": "W, as the robot believes; moments about the "
        "origin of each sole's F",
        "stabilizer.zmp_command": _BELIEVED,
        "feet.true": f"{_TRUE}; X_WF of each sole",
        "feet.wanted": f"{_BELIEVED}; X_WF of each sole, then its rates",
        "motion_player.contacts": "none",
        "landing_adaptor.contacts": "none",
        "static_stability.margin": "none",
        "contact_monitor.foot_forces": _TRUE,
        "contact_monitor.other_support": f"{_TRUE}; upward",
        "contact_monitor.impact": f"{_TRUE}; upward",
        "contact_monitor.friction_ratio": "none",
        "imu.integrals": "the inertial unit's own, at the pelvis' origin along its "
        "axes",
        "joint_encoders.joints": _JOINT,
        "ankle_force_sensors.foot_wrenches": f"{_SOLE}; measured",
        "contact_detector.bearing": "none",
        "contact_detector.touching": "none",
        "base_estimator.state": f"{_BELIEVED}, for the pelvis; each joint's own",
        "base_estimator.deviation": "W",
        "base_estimator.biases": "the inertial unit's own",
        "base_estimator.faults": "none",
        "com_observer.com": _BELIEVED,
        "com_observer.offset": "heading midway between the feet's",
        "motion_player.footholds": _BELIEVED,
        "believed_state.com_velocity": _BELIEVED,
    }
)
"""By signal what its positions, velocities, forces and turns are expressed in, and
whether they are the truth, a sensor's or the robot's own idea; "none" where turning the
frame changes nothing. W, F: see the README."""


def frame_of(signal: str) -> str:
    """Says what frame a vector signal is in; "" of one that is the user's own."""
    return SIGNAL_FRAMES.get(signal, "")
