"""What the simulation looks at of the true robot while it goes on."""

from pydrake.multibody.plant import ContactResults
from pydrake.systems.framework import Context

from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.judge.evidence import robot_limits
from footfall.diagrams.judge.evidence_signals import CLIMBING
from footfall.diagrams.judge.falls import base_height, fall_sign
from footfall.diagrams.judge.ground import end_ground
from footfall.diagrams.judge.rest import REST_TIME, at_rest, rest_figures
from footfall.diagrams.judge.true_motion import TrueMotion, true_motion
from footfall.models.robots.contact_geometry import is_sole
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector
from footfall.systems.sensing.robot_contacts import (
    robot_contacts,
    scene_forces,
    watched_geometry,
)

LOOK = 0.005
"""Between two looks at whether a robot that has finished is at rest, s."""
LIES_STILL = 0.05
"""A robot that has fallen lies when its CoM is slower than this, m/s."""
LIES_ON = 0.5
"""And something else than its soles bears this share of its weight."""
LIE_TIME = 0.3
"""For so long on end, s: a body that strikes the ground may stop for a moment."""
WATCHED_REST = REST_TIME + 2.0 * LOOK
"""For so long rest is watched, s: the log ends a little before the simulation."""


class RobotWatch:
    """Says of the true robot, at the context's time, whether it fell, lies or rests."""

    def __init__(self, task: TaskDiagram, context: Context) -> None:
        """Remembers how high the robot stands now.

        Args:
            task: the closed loop.
            context: the diagram's, where it starts.
        """
        self._task = task
        plant = task.plant
        self._context = plant.GetMyContextFromRoot(context)
        self._watched = watched_geometry(
            plant,
            task.scene_graph.model_inspector(),
            task.robot_instance,
            tuple(task.robot.foot_bodies[foot] for foot in FEET),
            is_sole,
            task.scene.ground_names(),
        )
        self._weight = robot_limits(plant, task.robot_instance).weight
        treads = task.scene.treads() if task.kind == CLIMBING else ()
        self._ground = end_ground(treads)
        self._initial = float(base_height(self._motion())[0])

    def _motion(self) -> TrueMotion:
        """Reads the robot's pose now, one sample."""
        task, context = self._task, self._context
        state = task.plant.GetPositionsAndVelocities(context, task.robot_instance)
        time: Vector = state[:1] * 0.0 + context.get_time()
        return true_motion(
            task.plant, task.robot_instance, task.robot, time, state[None]
        )

    def _upward(self) -> Vector:
        """Share of the weight on the left foot, the right foot, and all but soles."""
        port = self._task.plant.get_contact_results_output_port()
        results = port.Eval(self._context)
        assert isinstance(results, ContactResults)
        contacts = robot_contacts(results, self._watched)
        share: Vector = scene_forces(contacts, self._watched)[:, 2] / self._weight
        return share

    def fall(self) -> str | None:
        """Says in a few words by what the robot has fallen; None where it has not."""
        motion = self._motion()
        return fall_sign(
            float(base_height(motion)[0]),
            self._initial,
            float(motion.torso_up[0]),
            float(self._upward()[2]),
        )

    def lies(self) -> bool:
        """Tells whether a robot that has fallen has come to lie."""
        speed = rest_figures(self._motion(), None, self._weight, self._ground).speed
        return bool(speed[0] < LIES_STILL and self._upward()[2] > LIES_ON)

    def rests(self) -> bool:
        """Tells whether the robot is at rest where its task ends."""
        upward = self._upward() * self._weight
        loads: dict[Foot, Vector] = {"left": upward[:1], "right": upward[1:2]}
        figures = rest_figures(self._motion(), loads, self._weight, self._ground)
        return bool(at_rest(figures)[0])


class HoldClock:
    """For how long on end something has held, at rest or lying."""

    def __init__(self, duration: float) -> None:
        """It has not yet held.

        Args:
            duration: for how long it must, s.
        """
        self._duration = duration
        self._since: float | None = None
        self._now = 0.0

    def look(self, time: float, holds: bool) -> None:
        """Notes whether it holds at a time, s."""
        self._now = time
        if not holds:
            self._since = None
        elif self._since is None:
            self._since = time

    def done(self) -> bool:
        """Tells whether it has held long enough."""
        held = 0.0 if self._since is None else self._now - self._since
        return held >= self._duration - 1e-9
