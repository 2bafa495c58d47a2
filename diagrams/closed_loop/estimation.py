"""What the robot believes of itself: the station between sensors and controllers."""

from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.diagrams.scenario import ESTIMATED
from footfall.systems.estimation.base_estimator import BaseEstimator
from footfall.systems.estimation.com_observer import ComObserver
from footfall.systems.estimation.contact_detector import ContactDetector, SoleSize
from footfall.systems.sensing.body_poses import BodyPoses
from footfall.systems.sensing.kinematic_state import KinematicState


def build_estimation(setup: Setup) -> Station:
    """Builds contact detection, base estimator and the kinematics that follow.

    Takes `imu`, `joints`, `ankle_wrenches` and `footholds`, or in their place
    `true_state` and `true_wrenches`; gives `foot_poses`, `com`, `com_velocity`,
    `touching` and `body_poses`. Parts: `contact_detector`, `believed_state`,
    `believed_poses`, and unless the true state is used `base_estimator` and
    `com_observer`.
    """
    params, robot, model = setup.params, setup.robot, setup.model
    sole = SoleSize(robot.sole.heel, robot.sole.toe, robot.sole.half_width)
    station = StationBuilder("estimation", setup.parts)
    station.add("contact_detector", lambda: ContactDetector(params.contact, sole))
    station.add("believed_state", lambda: KinematicState(model, robot))
    station.add("believed_poses", lambda: BodyPoses(model))
    readers = ("believed_state.state", "believed_poses.state")
    if setup.scenario.robot.state == ESTIMATED:
        station.add(
            "base_estimator",
            lambda: BaseEstimator(
                model,
                robot,
                params.base_estimator,
                setup.stand.positions,
                params.control_period,
            ),
        )
        error = (
            setup.scenario.robot.com_error_ahead,
            setup.scenario.robot.com_error_left,
        )
        station.add("com_observer", lambda: ComObserver(params.com_observer, error))
        for signal in ("com", "com_velocity", "foot_poses"):
            station.connect(f"believed_state.{signal}", f"com_observer.{signal}")
        station.connect("contact_detector.bearing", "base_estimator.bearing")
        station.connect("base_estimator.state", *readers)
        station.take("footholds", "base_estimator.footholds")
        station.take("imu", "base_estimator.imu")
        station.take("joints", "base_estimator.joints")
        station.take(
            "ankle_wrenches",
            "contact_detector.foot_wrenches",
            "com_observer.foot_wrenches",
        )
        station.give("com", "com_observer.com")
    else:
        station.take("true_state", *readers)
        station.take("true_wrenches", "contact_detector.foot_wrenches")
        station.give("com", "believed_state.com")
    for signal in ("foot_poses", "com_velocity"):
        station.give(signal, f"believed_state.{signal}")
    station.give("touching", "contact_detector.touching")
    station.give("body_poses", "believed_poses.body_poses")
    return station.build()
