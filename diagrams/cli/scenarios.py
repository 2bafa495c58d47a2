"""`footfall list` and `footfall fields`: what there is to run, and what to change."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.errors import OptionError, bad_input_in_one_line


def list_shipped() -> None:
    """List the shipped scenarios, a line each."""
    from footfall.diagrams.shipped import list_scenarios

    scenarios = list_scenarios()
    width = max(len(name) for name, _ in scenarios)
    for name, description in scenarios:
        typer.echo(f"{name:<{width}}  {description}")


def fields(
    key: Annotated[
        str,
        typer.Argument(
            metavar="KEY",
            help="A field or a group, e.g. parameters.stabilizer; all by default.",
            show_default=False,
        ),
    ] = "",
    task: Annotated[
        str,
        typer.Option(
            metavar="KIND",
            help="Leave out what never acts in this task.kind, e.g. stair_climbing.",
            show_default=False,
        ),
    ] = "",
    schema: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write a JSON schema of scenario files instead, from which editors "
            "complete.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Print the fields of a scenario: default, unit, bounds, meaning.

    Of an interval ( and ) exclude the bound; what is null is absent unless given.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.fields_command import fields_text, write_schema

        if schema is not None and (key or task):
            raise OptionError("--schema: holds all fields, give neither KEY nor --task")
        text = fields_text(key, task) if schema is None else str(schema)
        if schema is not None:
            write_schema(schema)
    typer.echo(text)
