"""`footfall estimate`: estimates again from a run's sensors where the robot was."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import RunArgument, SetOption
from footfall.diagrams.cli.errors import bad_input_in_one_line


def estimate(
    run_folder: RunArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write the estimate's signals to, new or empty.",
            show_default=False,
        ),
    ] = None,
    overrides: SetOption = None,
) -> None:
    """Estimate again, from a run's sensors alone, where the robot was.

    Prints the errors against the run's truth; with --set as other parameters of
    parameters.base_estimator or parameters.contact would have had them.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.estimating import estimate_run, print_estimate
        from footfall.diagrams.run_folder import require_usable

        if out is not None:
            require_usable(out)
        frames, errors = estimate_run(run_folder, overrides or ())
        print_estimate(frames, errors, out)
