"""How well the robot knows where it is by its own senses: standing, walking, climbing.

    python tests/studies/know_itself.py --out tests/studies/know_itself.md

Standing for a minute; walking 20 m through a hall without looking; the shipped
scenarios; each with sensors at their defaults, and what they say of themselves against
the truth (`estimate` of the summary).
"""

import argparse
import os
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.judge.summary import Summary
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.shipped import shipped_scenarios
from footfall.diagrams.simulation import simulate, summarize

HALL = """<environment>
  <floor>
    <vertex x="-2.0" y="-3.0"/><vertex x="23.0" y="-3.0"/>
    <vertex x="23.0" y="3.0"/><vertex x="-2.0" y="3.0"/>
  </floor>
</environment>
"""
LENGTH = 20.0
"""Of the walk through the hall, m."""
FIRST_REST = 5.0
"""Standing before it, s, as one does who is to walk far by his gyroscope."""
COLUMNS = (
    "case",
    "seed",
    "outcome",
    "position rms, max [mm]",
    "tilt max [deg]",
    "yaw max [deg]",
    "CoM velocity rms [mm/s]",
    "DCM rms [mm]",
    "drift [% of the way]",
    "[% of the climb]",
    "misjudged contact [s]",
    "(error / deviation)^2",
    "impact [bw]",
)


def cases(hall: Path) -> dict[str, tuple[str, list[str]]]:
    """Lists the cases: by name the scenario and what is set in it."""
    walk = [
        "scene.room={length: 25.0, width: 6.0, height: 3.0, x: 10.5}",
        "scene.clutter=null",
        "robot.x=0.0",
        f"task.goal=[{LENGTH}, 0.0, 0.0]",
        f"task.environment={hall}",
        "simulation.max_time=400.0",
        f"parameters.path_executive.first_rest={FIRST_REST}",
    ]
    stands = {"stand for 60 s": ("stand", ["task.stand_time=60.0"])}
    walks = {f"walk {LENGTH:g} m without looking": ("room", walk)}
    shipped = {name: (name, []) for name in shipped_scenarios() if name != "stand"}
    return stands | walks | shipped


def run_case(scenario: str, changes: list[str], seed: int) -> Summary:
    """Runs a case once, in memory."""
    loaded = load_scenario(scenario, [*changes, f"simulation.seed={seed}"])
    task = build_task(loaded)
    return summarize(task, loaded, simulate(task, loaded.simulation.max_time))


def row(case: str, summary: Summary) -> tuple[str, ...]:
    """Formats a run as a row of the table."""
    told = summary.estimate or {}

    def shown(name: str, scale: float = 1.0, digits: int = 1) -> str:
        value = told.get(name)
        return "" if not isinstance(value, float) else f"{scale * value:.{digits}f}"

    misjudged = told.get("contact_misjudged_s")
    sides = misjudged if isinstance(misjudged, list) else []
    impact = summary.max_impact_body_weights
    return (
        case,
        str(summary.seed),
        summary.outcome,
        f"{shown('rms_position_m', 1e3)}, {shown('max_position_m', 1e3)}",
        shown("max_tilt_deg", 1.0, 2),
        shown("max_yaw_deg", 1.0, 2),
        shown("rms_com_velocity_m_s", 1e3),
        shown("rms_dcm_m", 1e3),
        shown("drift_percent_of_way", 1.0, 2),
        shown("drift_percent_of_climb", 1.0, 2),
        ", ".join(f"{side:.2f}" for side in sides),
        shown("squared_error", 1.0, 2),
        "" if impact is None else f"{impact:.2f}",
    )


def study(seeds: int, names: list[str], jobs: int) -> Iterator[tuple[str, ...]]:
    """Runs the cases with every seed; gives the rows in their order."""
    with (
        tempfile.TemporaryDirectory() as folder,
        ProcessPoolExecutor(jobs, max_tasks_per_child=1) as pool,
    ):
        hall = Path(folder) / "hall.xml"
        hall.write_text(HALL, encoding="utf-8")
        chosen = {k: v for k, v in cases(hall).items() if not names or k in names}
        futures = [
            (case, pool.submit(run_case, scenario, changes, seed))
            for case, (scenario, changes) in chosen.items()
            for seed in range(seeds)
        ]
        for case, future in futures:
            yield row(case, future.result())


def main() -> None:
    """Runs the study and writes its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="Markdown file")
    parser.add_argument("--seeds", type=int, default=5, help="of each case, from 0")
    parser.add_argument("--case", action="append", default=[], help="only this one")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at a time")
    arguments = parser.parse_args()
    lines = ["| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    for cells in study(arguments.seeds, arguments.case, arguments.jobs):
        lines.append("| " + " | ".join(cells) + " |")
        print(lines[-1], flush=True)
    title = "# How well the robot knows where it is\n\n"
    arguments.out.write_text(title + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
