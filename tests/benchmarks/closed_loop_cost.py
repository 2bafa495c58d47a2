"""Measures what the closed loop costs over its plant alone, in one process.

    OMP_NUM_THREADS=1 python -m tests.benchmarks.closed_loop_cost --write

Runs a closed loop, everything and the logs on, in turns with two plants: one as it was
before self-collisions were simulated (2.5 ms, lagged), its joints held, by which the
others are measured; and the loop's own, which begins every turn in the loop's state and
has its commands held. Only the time in which the robot steps counts. Prints a table;
with --write it also goes to `closed_loop_cost.md` and `closed_loop_cost.json` beside
this file.
"""

import argparse
import json
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np
from pydrake.geometry import CollisionFilterDeclaration, GeometrySet
from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context, DiagramBuilder

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.diagrams.closed_loop.parts import Parts
from footfall.diagrams.closed_loop.setup import set_up
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.solids import add_solids
from footfall.models.values.vector import Vector
from footfall.systems.timing import stopwatch
from tests.benchmarks.thinking_time import machine

SCENARIOS = ("stairs-exp1", "obstacle-15cm", "room")
SLICE = 0.05
"""Simulated time of a turn, s."""
FLUSH = 10
"""Turns between two flushes of the logs."""
CONTROL = (
    *("imu", "joint_encoders", "ankle_force_sensors", "contact_detector"),
    *("base_estimator", "believed_state", "motion_player", "zmp_preview"),
    *("com_reference", "landing_adaptor", "ik_tracker", "feedforward", "stabilizer"),
    *("static_stability", "executive"),
)
"""The Systems that make up sensing and control, by their names."""
WATCHING = (
    *("kinematic_state", "foot_wrench_sensor", "contact_monitor", "speed_monitor"),
    "wanted_torque",
)
"""Those that watch the truth for the judge."""
RESULT = Path(__file__).with_suffix(".json")


class HeldPlant:
    """Robot and scene with the joints held, stepped as far as it is told."""

    def __init__(self, scenario: Scenario, self_collision: bool) -> None:
        """Builds it, standing where the scenario starts.

        Args:
            scenario: its scene, time step and contact.
            self_collision: whether the robot's bodies can meet each other.
        """
        setup = set_up(scenario, Parts({}))
        builder = DiagramBuilder()
        simulation = scenario.simulation
        plant, scene_graph = AddMultibodyPlant(
            MultibodyPlantConfig(
                time_step=simulation.time_step if self_collision else 2.5e-3,
                contact_model="hydroelastic_with_fallback",
                discrete_contact_approximation=simulation.contact_approximation
                if self_collision
                else "lagged",
            ),
            builder,
        )
        instance = add_robot(plant, scene_graph, setup.robot)
        add_solids(plant, scenario.scene.solids())
        plant.Finalize()
        if not self_collision:
            shapes = GeometrySet(
                [
                    geometry
                    for index in plant.GetBodyIndices(instance)
                    for geometry in plant.GetCollisionGeometriesForBody(
                        plant.get_body(index)
                    )
                ]
            )
            scene_graph.collision_filter_manager().Apply(
                CollisionFilterDeclaration().ExcludeWithin(shapes)
            )
        plant.SetDefaultPositions(instance, setup.stand.positions)
        self._plant, self._instance = plant, instance
        self._simulator = Simulator(builder.Build())
        context = plant.GetMyMutableContextFromRoot(
            self._simulator.get_mutable_context()
        )
        count = plant.num_actuators(instance)
        joints = [
            plant.get_joint_actuator(index).joint()
            for index in plant.GetJointActuatorIndices(instance)
        ]
        held = np.array([joint.GetOnePosition(context) for joint in joints])
        desired = np.concatenate([held, np.zeros(count)])
        self._command(desired, np.zeros(count))
        self._simulator.Initialize()
        self._start = self._simulator.get_context().Clone()
        self._time = 0.0
        self._restarts = not self_collision

    def _command(self, desired: Vector, torque: Vector) -> None:
        plant, instance = self._plant, self._instance
        context = plant.GetMyContextFromRoot(self._simulator.get_context())
        plant.get_desired_state_input_port(instance).FixValue(context, desired)
        plant.get_actuation_input_port(instance).FixValue(context, torque)

    def follow(self, task: TaskDiagram, root: Context) -> None:
        """Takes state and commands of a closed loop over."""
        state = task.plant.GetPositionsAndVelocities(
            task.plant.GetMyContextFromRoot(root), task.robot_instance
        )
        context = self._plant.GetMyMutableContextFromRoot(
            self._simulator.get_mutable_context()
        )
        self._plant.SetPositionsAndVelocities(context, self._instance, state)
        self._command(
            task.output("ik_tracker.joint_references", root),
            task.output("torque_hold.y", root),
        )

    def advance(self, duration: float) -> float:
        """Steps it and gives the processor time that it took, s.

        The one that is held begins anew every second, before it can fall.
        """
        if self._time > 1.0 and self._restarts:
            context = self._simulator.get_mutable_context()
            context.SetTimeStateAndParametersFrom(self._start)
            self._simulator.Initialize()
            self._time = 0.0
        self._time += duration
        begin = process_time()
        self._simulator.AdvanceTo(self._time)
        return process_time() - begin


@dataclass
class Cost:
    """What was measured while a robot stepped."""

    simulated: float = 0.0
    """s."""
    loop: float = 0.0
    """Processor time of the closed loop, s, as all below."""
    wall: float = 0.0
    reference: float = 0.0
    """Of the plant alone as it was."""
    plant: float = 0.0
    """Of the loop's plant alone, in the loop's state."""
    control: float = 0.0
    watching: float = 0.0
    planning: float = 0.0
    """Of perception and planning."""


def measure(scenario: Scenario, limit: float) -> tuple[Cost, dict[str, float]]:
    """Measures one closed loop.

    Args:
        scenario: whose.
        limit: simulated time at the most, s.

    Returns:
        The cost while it steps, and of each System by its name the time, s.
    """
    task = build_task(scenario)
    reference, plant = HeldPlant(scenario, False), HeldPlant(scenario, True)
    simulator = Simulator(task.diagram)
    context = simulator.get_mutable_context()
    cost, by_system = Cost(), {}
    with tempfile.TemporaryDirectory() as folder:
        stream = task.signals.stream(context, Path(folder) / "signals")
        simulator.Initialize()
        for turn in range(1, round(limit / SLICE) + 1):
            before = times(task)
            plant.follow(task, context)
            begin, wall = process_time(), perf_counter()
            simulator.AdvanceTo(turn * SLICE)
            if turn % FLUSH == 0:
                stream.flush()
            spent, walled = process_time() - begin, perf_counter() - wall
            status = task.task_status(context)
            if status.state != "running":
                break
            if status.activity != "move":
                continue
            after = times(task)
            taken = {name: after[name] - before.get(name, 0.0) for name in after}
            for name, seconds in taken.items():
                by_system[name] = by_system.get(name, 0.0) + seconds
            cost.simulated += SLICE
            cost.loop += spent
            cost.wall += walled
            cost.control += sum(taken.get(name, 0.0) for name in CONTROL)
            cost.watching += sum(taken.get(name, 0.0) for name in WATCHING)
            known = (*CONTROL, *WATCHING)
            cost.planning += sum(
                seconds
                for name, seconds in taken.items()
                if name not in known and not name.startswith(("log(", "signal_log"))
            )
            cost.reference += reference.advance(SLICE)
            cost.plant += plant.advance(SLICE)
    return cost, by_system


def times(task: TaskDiagram) -> dict[str, float]:
    """How long the callbacks of every System have taken so far, s."""
    return {
        leaf.get_name(): watch.total
        for _, leaf in leaf_systems(task.diagram)
        if (watch := stopwatch(leaf)) is not None
    }


def figures(cost: Cost, by_system: dict[str, float]) -> dict[str, Any]:
    """The cost as ratios to the plant alone as it was."""
    unit = cost.reference
    rest = cost.loop - cost.plant - cost.control - cost.watching - cost.planning
    ticks = cost.simulated / 0.005
    return {
        "simulated_s": round(cost.simulated, 2),
        "reference_cpu_per_s": round(unit / cost.simulated, 3),
        "loop": round(cost.loop / unit, 3),
        "loop_without_planning": round((cost.loop - cost.planning) / unit, 3),
        "plant": round(cost.plant / unit, 3),
        "control": round(cost.control / unit, 3),
        "watching": round(cost.watching / unit, 3),
        "bookkeeping_and_logs": round(rest / unit, 3),
        "planning": round(cost.planning / unit, 3),
        "real_time_factor": round(cost.simulated / cost.wall, 2),
        "us_a_tick": {
            name: round(1e6 * seconds / ticks)
            for name, seconds in sorted(by_system.items(), key=lambda item: -item[1])
            if 1e6 * seconds / ticks >= 1.0
        },
    }


def table(result: dict[str, Any]) -> str:
    """The result as Markdown."""
    scenarios = result["scenarios"]
    rows = [name for name in next(iter(scenarios.values())) if name != "us_a_tick"]
    lines = [
        "# What the closed loop costs",
        "",
        "Processor time while the robot steps, by `python -m",
        "tests.benchmarks.closed_loop_cost`; all but the first two rows and the last",
        "in multiples of the plant alone as it was, its joints held (2.5 ms, lagged,",
        "no self-collision).",
        "",
        "| | " + " | ".join(scenarios) + " |",
        "|---|" + "---|" * len(scenarios),
    ]
    for row in rows:
        cells = " | ".join(str(figure[row]) for figure in scenarios.values())
        lines.append(f"| `{row}` | {cells} |")
    lines += ["", "Microseconds of a tick of 5 ms:", ""]
    lines += ["| | " + " | ".join(scenarios) + " |", "|---|" + "---|" * len(scenarios)]
    names = {n: None for s in scenarios.values() for n in s["us_a_tick"]}
    for name in names:
        cells = " | ".join(
            str(figure["us_a_tick"].get(name, "")) for figure in scenarios.values()
        )
        lines.append(f"| `{name}` | {cells} |")
    lines += ["", "| machine | |", "|---|---|"]
    lines += [f"| {name} | {value} |" for name, value in result["machine"].items()]
    return "\n".join(lines) + "\n"


def measured(names: Sequence[str], limit: float) -> Iterator[tuple[str, dict]]:
    """Measures scenarios one after the other."""
    for name in names:
        yield name, figures(*measure(load_scenario(name), limit))


def main() -> None:
    """Runs the benchmark."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenarios", nargs="*", default=SCENARIOS)
    parser.add_argument("--limit", type=float, default=40.0, help="simulated, s")
    parser.add_argument("--write", action="store_true", help="files too")
    arguments = parser.parse_args()
    result = {
        "machine": machine(),
        "scenarios": dict(measured(arguments.scenarios, arguments.limit)),
    }
    print(table(result))
    if arguments.write:
        RESULT.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
        RESULT.with_suffix(".md").write_text(table(result), encoding="utf-8")


if __name__ == "__main__":
    main()
