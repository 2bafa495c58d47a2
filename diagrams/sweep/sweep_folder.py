"""A sweep's folder, read back."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pandas as pd

from footfall.diagrams.sweep.definition import Sweep, SweepError, sweep_from_json
from footfall.diagrams.sweep.runner import DEFINITION_FILE
from footfall.diagrams.sweep.table import COST_FILE, REPORT_FILE, TABLE_FILE


@dataclass(frozen=True)
class SweepFolder:
    """A sweep's folder, read back."""

    folder: Path

    @cached_property
    def sweep(self) -> Sweep:
        """What was run.

        Raises:
            SweepError: the file that says it is damaged, or missing.
        """
        path = self.folder / DEFINITION_FILE
        try:
            return sweep_from_json(json.loads(path.read_text("utf-8"))["sweep"])
        except OSError as error:
            raise SweepError(f"{path}: cannot be read: {error.strerror}") from None
        except (KeyError, TypeError, ValueError) as error:
            raise SweepError(f"{path}: holds no sweep: {error}") from None

    @cached_property
    def table(self) -> pd.DataFrame:
        """A row a run: varied fields, seed, outcome, figures, the command again."""
        return pd.read_parquet(self.folder / TABLE_FILE)

    @cached_property
    def costs(self) -> pd.DataFrame:
        """What each run took: wall and processor time, s, and memory, MB."""
        return pd.read_parquet(self.folder / COST_FILE)

    @property
    def report(self) -> str:
        """The report, Markdown."""
        return (self.folder / REPORT_FILE).read_text(encoding="utf-8")


def load_sweep(folder: Path | str) -> SweepFolder:
    """Gives a sweep back: `.sweep`, `.table`, `.costs`, `.report`.

    Raises:
        SweepError: the folder holds no sweep that has come to a table.
    """
    path = Path(folder)
    if not (path / TABLE_FILE).is_file():
        raise SweepError(f"{path}: not a sweep's folder, it has no {TABLE_FILE}")
    return SweepFolder(path)
