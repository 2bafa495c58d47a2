"""The definition of a sweep: what is varied and how, read from a YAML file."""

import math
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, Literal, TypeAlias, cast

from footfall.diagrams.judge.summary import Summary
from footfall.diagrams.schema import FieldError, parse_yaml
from footfall.models.values.validation import MAX_SEED

Sampling: TypeAlias = Literal["grid", "random", "latin_hypercube"]
SAMPLINGS: tuple[Sampling, ...] = ("grid", "random", "latin_hypercube")
Keep: TypeAlias = Literal["all", "failures", "none"]
KEEPS: tuple[Keep, ...] = ("all", "failures", "none")
KNOWN = (
    *("scenario", "set", "fields", "sampling", "count", "seeds", "draw_seed"),
    *("cases", "group_by", "show", "timeout", "keep"),
)
MOST_RUNS = 100_000
FIGURES = frozenset(field.name for field in fields(Summary))
"""What a summary holds."""
CASE = "case"
"""The column that says which case a run is of; cases are grouped by under this name."""


class SweepError(ValueError):
    """A sweep cannot be run or read; the message is one line naming file and field."""


@dataclass(frozen=True)
class Range:
    """Numbers from one to another, both included."""

    low: float
    high: float
    levels: int | None = None
    """How many a grid takes, evenly spaced."""
    whole: bool = False
    """Whether only whole numbers are meant: both ends are given as such."""


Values: TypeAlias = Range | tuple[Any, ...]
"""What a field takes: a range, or one after the other."""


@dataclass(frozen=True)
class Sweep:
    """What is run."""

    name: str
    """Of the file, without its ending."""
    scenario: str
    """Name of a shipped scenario, or the path of a file in full."""
    changes: tuple[str, ...] = ()
    """"KEY=VALUE" each, the same in every run."""
    cases: tuple[tuple[str, tuple[str, ...]], ...] = ()
    """By name "KEY=VALUE"s that belong together; each is run with all that varies."""
    fields: tuple[tuple[str, Values], ...] = ()
    """By dotted path what each varied field takes."""
    sampling: Sampling = "grid"
    count: int = 1
    """How many are drawn where they are drawn."""
    seeds: tuple[int, ...] = (0,)
    """`simulation.seed` of the runs of each sample."""
    draw_seed: int = 0
    """Of the samples."""
    group_by: tuple[str, ...] = ()
    """Fields by whose values success is counted."""
    show: tuple[str, ...] = ()
    """Figures of the summary that the report lists run by run."""
    timeout: float = 1800.0
    """Wall time after which a run counts as hung, s."""
    keep: Keep = "failures"
    """Of which runs the signals are kept."""


def load_sweep_file(path: Path) -> Sweep:
    """Reads a sweep's definition.

    Raises:
        SweepError: it cannot be used, and why, in one line.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise SweepError(f"{path}: no such file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise SweepError(f"{path}: cannot be read: {error}") from None
    try:
        data = parse_yaml(text)
        if not isinstance(data, dict):
            raise FieldError("", "must hold the fields of a sweep")
        return _sweep(data, path)
    except FieldError as error:
        raise SweepError(f"{path}: {error}") from None


def sweep_to_json(sweep: Sweep) -> dict[str, Any]:
    """Writes a sweep as plain JSON data; `sweep_from_json` reads it back equal."""
    return asdict(sweep)


def sweep_from_json(data: dict[str, Any]) -> Sweep:
    """Reads what `sweep_to_json` has written.

    Raises:
        KeyError, TypeError: it is something else.
    """
    listed: dict[str, Any] = {
        name: tuple(data[name]) for name in ("changes", "seeds", "group_by", "show")
    }
    listed["cases"] = tuple((name, tuple(said)) for name, said in data["cases"])
    listed["fields"] = tuple(
        (path, Range(**values) if isinstance(values, dict) else tuple(values))
        for path, values in data["fields"]
    )
    return Sweep(**{**data, **listed})


def _sweep(data: dict[str, Any], path: Path) -> Sweep:
    for name in data:
        if name not in KNOWN:
            raise FieldError(str(name), f"no such field; there are {', '.join(KNOWN)}")
    scenario = data.get("scenario")
    if not isinstance(scenario, str) or not scenario:
        raise FieldError("scenario", "must name a scenario or a file")
    beside = path.absolute().parent / scenario
    varied = _fields(data.get("fields", {}))
    sampling = _choice("sampling", data.get("sampling", "grid"), SAMPLINGS)
    if sampling == "grid":
        if "count" in data:
            raise FieldError("count", "a grid has as many runs as it has points")
        for name, values in varied:
            if isinstance(values, Range) and not (values.levels or values.whole):
                raise FieldError(f"fields.{name}.levels", "must be given for a grid")
    cases = _cases(data.get("cases", {}))
    groups = _texts("group_by", data.get("group_by", []))
    for group in groups:
        if group not in dict(varied) and not (cases and group == CASE):
            raise FieldError("group_by", f"{group} is none of the fields varied")
    shown = _texts("show", data.get("show", []))
    for name in shown:
        if name not in FIGURES:
            raise FieldError("show", f"{name} is no figure of a summary")
    return Sweep(
        name=path.stem,
        scenario=str(beside) if beside.is_file() else scenario,
        changes=_texts("set", data.get("set", [])),
        cases=cases,
        fields=varied,
        sampling=cast(Sampling, sampling),
        count=_whole("count", data.get("count", 1), 1, MOST_RUNS),
        seeds=_seeds(data.get("seeds", [0])),
        draw_seed=_whole("draw_seed", data.get("draw_seed", 0), 0, MAX_SEED),
        group_by=groups,
        show=shown,
        timeout=_number("timeout", data.get("timeout", 1800.0), 1.0),
        keep=cast(Keep, _choice("keep", data.get("keep", "failures"), KEEPS)),
    )


def _cases(data: Any) -> tuple[tuple[str, tuple[str, ...]], ...]:
    if not isinstance(data, dict):
        raise FieldError("cases", "must hold names of cases and what is set in each")
    return tuple((str(name), _texts(f"cases.{name}", v)) for name, v in data.items())


def _fields(data: Any) -> tuple[tuple[str, Values], ...]:
    if not isinstance(data, dict):
        raise FieldError("fields", "must hold paths of fields and what they take")
    return tuple((str(name), _values(f"fields.{name}", v)) for name, v in data.items())


def _values(path: str, data: Any) -> Values:
    if isinstance(data, list):
        if not data:
            raise FieldError(path, "must have at least one element")
        return tuple(data)
    if not isinstance(data, dict):
        raise FieldError(path, "must be a list, or a range {from: ..., to: ...}")
    for name in data:
        if name not in ("from", "to", "levels"):
            raise FieldError(path, f"a range has from, to and levels, got {name!r}")
    for name in ("from", "to"):
        if name not in data:
            raise FieldError(f"{path}.{name}", "must be given")
    low, high = _number(f"{path}.from", data["from"]), _number(f"{path}.to", data["to"])
    if not low < high:
        raise FieldError(f"{path}.to", f"must exceed from, {low:g}, got {high:g}")
    whole = isinstance(data["from"], int) and isinstance(data["to"], int)
    levels = data.get("levels")
    if levels is not None:
        levels = _whole(f"{path}.levels", levels, 2, MOST_RUNS)
    return Range(low, high, levels, whole)


def _seeds(data: Any) -> tuple[int, ...]:
    if isinstance(data, int) and not isinstance(data, bool):
        return tuple(range(_whole("seeds", data, 1, MOST_RUNS)))
    if not isinstance(data, list) or not data:
        raise FieldError("seeds", "must be a list of seeds, or how many there are")
    return tuple(
        _whole(f"seeds[{i}]", seed, 0, MAX_SEED) for i, seed in enumerate(data)
    )


def _texts(path: str, data: Any) -> tuple[str, ...]:
    if not isinstance(data, list) or not all(isinstance(item, str) for item in data):
        raise FieldError(path, "must be a list of texts")
    return tuple(data)


def _choice(path: str, data: Any, choices: tuple[str, ...]) -> str:
    if data not in choices:
        raise FieldError(path, f"must be one of {', '.join(choices)}, got {data!r}")
    return str(data)


def _number(path: str, data: Any, least: float = -math.inf) -> float:
    if isinstance(data, bool) or not isinstance(data, int | float):
        raise FieldError(path, f"must be a number, got {data!r}")
    if not (math.isfinite(data) and data >= least):
        raise FieldError(path, f"must be finite and at least {least:g}, got {data}")
    return float(data)


def _whole(path: str, data: Any, least: int, most: int) -> int:
    number = _number(path, data)
    if number != int(number) or not least <= number <= most:
        raise FieldError(
            path, f"must be a whole number of {least} to {most}, got {data}"
        )
    return int(number)
