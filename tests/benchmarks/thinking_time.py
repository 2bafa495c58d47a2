"""Measures how long perception and planning take; sets the defaults of ThinkingParams.

    OMP_NUM_THREADS=1 python -m tests.benchmarks.thinking_time --write

Prints a table. With --write it also goes to `thinking_time.md` and `thinking_time.json`
beside this file, and the 95th percentiles, rounded up to 10 ms, become the defaults in
`systems/thinking.py`. On a machine that is busy with other things the wall clock tells
their time too: there, --clock cpu.
"""

import argparse
import json
import os
import platform
import re
from collections.abc import Sequence
from importlib.metadata import version
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from footfall.systems import thinking
from tests.benchmarks.thinking_cases import Sample, think

RESULT = Path(__file__).with_suffix(".json")
PACKAGES = ("drake", "numpy", "scipy", "small-gicp", "shapely", "ompl")


def machine() -> dict[str, Any]:
    """What the figures depend on."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        found = re.search(r"^model name\s*: (.+)$", cpuinfo.read_text(), re.MULTILINE)
        model = found.group(1) if found else model
    return {
        "cpu": model,
        "cores": os.cpu_count(),
        "omp_num_threads": os.environ.get("OMP_NUM_THREADS", "not set"),
        "system": platform.system(),
        "python": platform.python_version(),
        **{package: version(package) for package in PACKAGES},
    }


def figures(samples: Sequence[Sample], clock: str) -> dict[str, dict[str, float]]:
    """By field of `ThinkingParams`: samples, median, 95th percentile and default, s."""
    by_kind: dict[str, list[float]] = {}
    for sample in samples:
        by_kind.setdefault(sample.kind, []).append(getattr(sample, clock))
    found = {}
    for kind, seconds in by_kind.items():
        median, p95 = np.percentile(seconds, [50.0, 95.0])
        found[kind] = {
            "samples": len(seconds),
            "median": round(float(median), 4),
            "p95": round(float(p95), 4),
            "most": round(max(seconds), 4),
            "default": ceil(100.0 * p95) / 100.0,
        }
    return found


def table(result: dict[str, Any]) -> str:
    """The result as Markdown."""
    clock = {"wall": "wall", "cpu": "processor"}[result["clock"]]
    lines = [
        "# How long thinking takes",
        "",
        f"In seconds of {clock} time, by `python -m tests.benchmarks.thinking_time`.",
        "The 95th percentiles, rounded up, are the defaults of `ThinkingParams`.",
        "",
        "| thought | samples | median | 95th percentile | most | default |",
        "|---|---|---|---|---|---|",
    ]
    for kind, row in result["thoughts"].items():
        lines.append(
            f"| `{kind}` | {row['samples']} | {row['median']:.3f} | {row['p95']:.3f} "
            f"| {row['most']:.3f} | {row['default']:.2f} |"
        )
    lines += ["", "| machine | |", "|---|---|"]
    lines += [f"| {name} | {value} |" for name, value in result["machine"].items()]
    return "\n".join(lines) + "\n"


def set_defaults(source: str, thoughts: dict[str, dict[str, float]]) -> str:
    """The source of `ThinkingParams` with these defaults.

    Raises:
        ValueError: a thought is no field of it.
    """
    for kind, row in thoughts.items():
        source, count = re.subn(
            rf"(?m)^(    {kind}: float = number\()[^,]+",
            rf"\g<1>{row['default']}",
            source,
        )
        if count != 1:
            raise ValueError(f"{kind}: found {count} times in the source, expected 1")
    return source


def main() -> None:
    """Runs the benchmark."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall")
    parser.add_argument("--scenes", type=int, default=24, help="drawn a task")
    parser.add_argument("--quasi-static", type=int, default=10, help="and of these")
    parser.add_argument("--write", action="store_true", help="files and defaults too")
    arguments = parser.parse_args()
    samples = think(arguments.scenes, arguments.quasi_static)
    result = {
        "clock": arguments.clock,
        "machine": machine(),
        "thoughts": figures(samples, arguments.clock),
    }
    print(table(result))
    if arguments.write:
        RESULT.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
        RESULT.with_suffix(".md").write_text(table(result), encoding="utf-8")
        source = Path(thinking.__file__)
        text = set_defaults(source.read_text(encoding="utf-8"), result["thoughts"])
        source.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
