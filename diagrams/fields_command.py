"""What `footfall fields` does: prints the fields of a scenario, or writes a schema."""

import difflib
import json
from pathlib import Path

from footfall.diagrams.fields.acting import acts_in_task
from footfall.diagrams.fields.field_table import field_lines
from footfall.diagrams.fields.field_tree import select_fields, walk_fields
from footfall.diagrams.fields.json_schema import json_schema
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.schema import FieldError
from footfall.diagrams.task_params import TASKS


def fields_text(key: str = "", task: str = "") -> str:
    """The fields of a scenario as text.

    Args:
        key: dotted path of a field or a group; empty for all.
        task: a kind of task, to leave out what never acts in it; empty for all.

    Raises:
        FieldError: there is no such field or task; what comes nearest is named.
    """
    fields = tuple(walk_fields(Scenario))
    if task and task not in TASKS:
        alike = [kind for kind in TASKS if kind[:4] == task[:4]]
        close = alike or difflib.get_close_matches(task, TASKS, n=1, cutoff=0.5)
        hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(TASKS)}"
        raise FieldError(f"--task {task}", f"no such task; {hint}")
    chosen = select_fields(fields, key) if key else fields
    shown = (one for one in chosen if not one.item.shared)
    if task:
        shown = (one for one in shown if acts_in_task(one.key, task))
    lines = tuple(field_lines(shown))
    if not lines:
        raise FieldError(key, f"does not act in the task {task}")
    return "\n".join(lines)


def write_schema(path: Path) -> None:
    """Writes the JSON schema of scenario files.

    Raises:
        OSError: it cannot be written.
    """
    schema = json_schema(Scenario, "A scenario of footfall")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(schema, indent=1) + "\n", encoding="utf-8")
