"""Runs three scenarios at several time steps and with every contact solver and model.

    python tests/studies/solve_contact.py --out tests/studies/solve_contact.md

A figure that holds at one time step alone is not one: what a table of this project
tells must come out alike wherever the physics is solved well enough. The scanner has
half its lines, which changes none of it.
"""

import argparse
import multiprocessing
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.simulation import run_task

SCENARIOS = ("stairs-exp1", "obstacle-15cm", "room")
SOLVED = (
    (2.5, "lagged", "hydroelastic"),
    (0.5, "lagged", "hydroelastic"),
    (1.0, "lagged", "hydroelastic"),
    (5.0, "lagged", "hydroelastic"),
    (2.5, "similar", "hydroelastic"),
    (2.5, "sap", "hydroelastic"),
    (2.5, "lagged", "point"),
)
"""Time step, ms, approximation, contact model; the defaults first."""
FIGURES = (
    ("climb_time_s", "climb [s]", 1.0),
    ("crossing_time_s", "crossing [s]", 1.0),
    ("max_impact_body_weights", "impact [weights]", 1.0),
    ("max_friction_ratio", "friction", 1.0),
    ("max_foot_slip_m", "slip [mm]", 1e3),
    ("max_dcm_error_m", "DCM error [mm]", 1e3),
    ("com_rms_error_m", "CoM error [mm]", 1e3),
    ("min_zmp_margin_m", "ZMP margin [mm]", 1e3),
    ("min_clearance_m", "clearance [mm]", 1e3),
    ("min_self_distance_m", "own bodies [mm]", 1e3),
    ("max_wanted_torque_fraction", "wanted torque", 1.0),
    ("torque_limit_s", "at a limit [s]", 1.0),
    ("real_time_factor", "real time", 1.0),
)
"""Field of the summary, what the table calls it, and the factor of its unit."""


def run(case: tuple[str, tuple[float, str, str]]) -> dict[str, object]:
    """The summary of one scenario, solved in one way."""
    name, (step, approximation, model) = case
    scenario = load_scenario(
        name,
        [
            "sensors.lidar.tilt_step_deg=0.5",
            f"simulation.time_step={step / 1e3:g}",
            f"simulation.contact_approximation={approximation}",
            f"simulation.contact_model={model}",
        ],
    )
    with tempfile.TemporaryDirectory() as folder:
        summary = run_task(build_task(scenario), scenario, Path(folder) / "run")
    return summary.to_json()


def table(name: str, summaries: list[dict[str, object]]) -> list[str]:
    """The lines of one scenario's table; rows are figures, columns ways to solve."""
    heads = [f"{step:g} ms {how}, {model}" for step, how, model in SOLVED]
    lines = [
        f"## {name}",
        "",
        f"| figure | {' | '.join(heads)} | spread of the figure |",
        "|---" * (len(SOLVED) + 2) + "|",
        f"| outcome | {' | '.join(str(s['outcome']) for s in summaries)} | |",
    ]
    for field, called, factor in FIGURES:
        values = [s[field] for s in summaries]
        if all(value is None for value in values):
            continue
        shown = ["" if v is None else f"{float(v) * factor:.3g}" for v in values]
        numbers = np.array([np.nan if v is None else float(v) for v in values])
        middle = np.nanmedian(numbers)
        spread = np.nanmax(np.abs(numbers - middle)) / max(abs(middle), 1e-9)
        lines.append(f"| {called} | {' | '.join(shown)} | {100.0 * spread:.0f} % |")
    return [*lines, ""]


def main() -> None:
    """Runs all of it, two runs at a time, and writes the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, default=Path("solve_contact.md"))
    parser.add_argument("--workers", type=int, default=2)
    arguments = parser.parse_args()
    cases = [(name, solved) for name in SCENARIOS for solved in SOLVED]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(
        arguments.workers, mp_context=context, max_tasks_per_child=1
    ) as pool:
        summaries = list(pool.map(run, cases))
    lines = [
        "# Which figures depend on how contact is solved",
        "",
        "Written by `python tests/studies/solve_contact.py`: seed 0, half the scan "
        "lines. The spread is the largest deviation from the median of a row.",
        "",
    ]
    for k, name in enumerate(SCENARIOS):
        lines += table(name, summaries[k * len(SOLVED) : (k + 1) * len(SOLVED)])
    text = "\n".join(lines)
    print(text)
    arguments.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
