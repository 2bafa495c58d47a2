"""What the robot touches, and with what force it meets the ground."""

import math

import numpy as np
from pydrake.common.value import AbstractValue, Value
from pydrake.multibody.plant import ContactResults
from pydrake.systems.framework import (
    Context,
    DiscreteValues,
    LeafSystem,
)

from footfall.models.values.contact import Touch, Touches
from footfall.models.values.vector import Vector
from footfall.systems.ports import declare_state_output, eval_abstract, set_state
from footfall.systems.sensing.moving_mean import window_weights
from footfall.systems.sensing.robot_contacts import (
    RobotContact,
    WatchedGeometry,
    robot_contacts,
    scene_forces,
)
from footfall.systems.timing import timed

WINDOW = 0.01
"""Forces are averaged over this, s: of an impact a single step of the plant says what
its length and its solver make of it."""
LOADED = 0.20
"""Share of the weight above which a foot counts as loaded."""


class ContactMonitor(LeafSystem):
    """Remembers what the robot has touched that it must not, and what its feet felt.

    It looks at every step of the plant, so that a graze of one step is not missed. The
    state is discrete, because an unrestricted update at that rate would slow the whole
    run down. Means are over `WINDOW`.

    .. pydrake_system::

        name: ContactMonitor
        input_ports:
        - contact_results
        output_ports:
        - touching
        - foot_forces
        - other_support
        - impact
        - friction_ratio
        - touches

    - `contact_results`: the plant's contacts, ContactResults.
    - `touching`: how many forbidden contacts there were at the last step, (1,).
    - `touches`: every forbidden pair that has met since the start, `Touches`; a body of
      the robot with anything of the scene, but for its soles with the ground, or with
      another of its own bodies.
    - `foot_forces`: mean force of the scene on the left, then on the right foot, in W,
      (6,), N.
    - `other_support`: mean upward force of the scene on all but the soles, (1,), N.
    - `impact`: largest mean upward force on each foot since the start, (2,), N.
    - `friction_ratio`: largest ratio of the mean horizontal to the mean upward force on
      a foot that bears more than `LOADED`, since the start, (1,).
    """

    def __init__(self, watched: WatchedGeometry, period: float, weight: float) -> None:
        """Declares ports, state and the update.

        Args:
            watched: the geometries of the robot and of the scene.
            period: the plant's time step, s.
            weight: of the robot, N.

        Raises:
            ValueError: period or weight is not positive.
        """
        super().__init__()
        for name, value, unit in (("period", period, "s"), ("weight", weight, "N")):
            if not value > 0.0:
                raise ValueError(f"{name}: must be positive, got {value} {unit}")
        self._watched, self._period, self._weight = watched, period, weight
        self._weights = window_weights(WINDOW, period)
        pairs = len(watched.bodies) * len(watched.others)
        self._results = self.DeclareAbstractInputPort(
            "contact_results", Value(ContactResults())
        )

        self._durations = int(self.DeclareDiscreteState(pairs))
        self._forces = int(self.DeclareDiscreteState(pairs))
        self._window = int(self.DeclareDiscreteState(9 * len(self._weights)))
        self._touching, self._feet, self._support, self._impact, self._ratio = (
            declare_state_output(self, name, np.zeros(size))
            for name, size in (
                ("touching", 1),
                ("foot_forces", 6),
                ("other_support", 1),
                ("impact", 2),
                ("friction_ratio", 1),
            )
        )
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))
        self.DeclareAbstractOutputPort(
            "touches",
            lambda: Value[object](Touches()),
            timed(self, self._calc_touches),  # type: ignore[arg-type]
            prerequisites_of_calc={self.xd_ticket()},
        )

    def _update(self, context: Context, state: DiscreteValues) -> None:
        results = eval_abstract(self._results, context, ContactResults)
        contacts = robot_contacts(results, self._watched)
        before = context.get_discrete_state(self._window).value()
        now = scene_forces(contacts, self._watched).ravel()
        window = np.concatenate([now, before[:-9]])
        mean: Vector = self._weights @ window.reshape(-1, 9)
        set_state(state, self._window, window)
        set_state(state, self._feet, mean[:6])
        set_state(state, self._support, mean[8:])
        self._keep_largest(mean, state)
        forbidden = [contact for contact in contacts if not contact.allowed]
        set_state(state, self._touching, np.array([len(forbidden)], dtype=np.float64))
        if forbidden:
            self._keep_touches(forbidden, state)

    def _keep_largest(self, mean: Vector, state: DiscreteValues) -> None:
        impact, (ratio,) = state.value(self._impact).tolist(), state.value(self._ratio)
        before = (*impact, ratio)
        feet = mean[:6].tolist()
        for foot, (x, y, z) in enumerate((feet[:3], feet[3:])):
            if z > impact[foot]:
                impact[foot] = z
            if z > LOADED * self._weight:
                ratio = max(ratio, math.hypot(x, y) / z)
        if (*impact, ratio) != before:
            set_state(state, self._impact, np.array(impact))
            set_state(state, self._ratio, np.array([ratio]))

    def _keep_touches(
        self, contacts: list[RobotContact], state: DiscreteValues
    ) -> None:
        durations = state.get_mutable_value(self._durations)
        forces = state.get_mutable_value(self._forces)
        force_of: dict[int, Vector] = {}
        for contact in contacts:
            pair = contact.body * len(self._watched.others) + contact.other
            force_of[pair] = force_of.get(pair, 0.0) + contact.force
        for pair, force in force_of.items():
            durations[pair] += self._period
            forces[pair] = max(forces[pair], float(np.linalg.norm(force)))

    def _calc_touches(self, context: Context, touches: AbstractValue) -> None:
        durations: Vector = context.get_discrete_state(self._durations).value()
        forces: Vector = context.get_discrete_state(self._forces).value()
        others = self._watched.others
        met = [int(pair) for pair in np.flatnonzero(durations)]
        touches.set_value(
            Touches(
                tuple(
                    Touch(
                        self._watched.bodies[pair // len(others)],
                        others[pair % len(others)],
                        float(durations[pair]),
                        float(forces[pair]),
                    )
                    for pair in met
                )
            )
        )
