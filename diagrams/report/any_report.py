"""The page of a folder, whatever it holds."""

from pathlib import Path

from footfall.diagrams.report.run_report import report_run
from footfall.diagrams.report.sweep_report import report_sweep
from footfall.diagrams.signals import SCENARIO_FILE, RunError
from footfall.diagrams.sweep.runner import DEFINITION_FILE


def write_report(folder: Path) -> tuple[Path, list[str]]:
    """Writes the page of a run or a sweep into its folder.

    Returns:
        The page, and a line for each picture that could not be drawn.

    Raises:
        RunError: the folder holds neither, or a run that cannot be read.
        SweepError: it holds a sweep that has not come to a table, or is damaged.
        ScenarioError: the run's scenario cannot be read.
        OSError: the page cannot be written.
    """
    if not folder.is_dir():
        raise RunError(f"{folder}: no such folder")
    if (folder / DEFINITION_FILE).exists():
        return report_sweep(folder), []
    if not (folder / SCENARIO_FILE).exists():
        raise RunError(
            f"{folder}: neither a run's folder nor a sweep's: it has no "
            f"{SCENARIO_FILE} and no {DEFINITION_FILE}"
        )
    return report_run(folder)
