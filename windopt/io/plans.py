"""Plans in JSON files, in the format that ``plan.schema.json`` beside this file describes.

What the command line prints with ``--json`` is the same text.
"""

import json
from pathlib import Path
from typing import Any

from windopt.domain.plan import InspectionPlan, Plan, YawPlan
from windopt.errors import InvalidInput
from windopt.io.plan_reader import Recorded, plan_from_record
from windopt.io.plan_records import Record, inspection_record, plan_record, yaw_record
from windopt.io.whole_files import write_whole
from windopt.result import Result

__all__ = [
    "inspection_record",
    "json_text",
    "plan_record",
    "read_plan",
    "record_of",
    "write_plan",
    "yaw_record",
]


def record_of(plan: Recorded, problem: InspectionPlan | YawPlan | None = None) -> Record:
    """Record a plan of any kind.

    Parameters
    ----------
    plan
        A whole plan, or the result of planning an inspection or the yaw.
    problem
        Stands in for the solution where there is none: the same kind of plan, empty.

    Raises
    ------
    ValueError
        If there is neither a solution nor a ``problem``.
    """
    if isinstance(plan, Plan):
        return plan_record(plan, problem if isinstance(problem, InspectionPlan) else None)
    solution: Any = plan.solution or problem or plan.found()
    result: Result[Any] = plan
    if isinstance(solution, YawPlan):
        return yaw_record(result, solution)
    return inspection_record(result, solution)


def json_text(record: Record) -> str:
    """Return a record as JSON, in ASCII so that no terminal or pipe can garble it."""
    return json.dumps(record, indent=2, allow_nan=False) + "\n"


def write_plan(
    plan: Recorded,
    path: str | Path,
    *,
    force: bool = False,
    problem: InspectionPlan | YawPlan | None = None,
) -> Path:
    """Write a plan of any kind, whole or not at all.

    Parameters
    ----------
    force
        Whether a file that is already there may be replaced.
    problem
        As in :func:`record_of`.
    """
    return write_whole(path, json_text(record_of(plan, problem)), force=force)


def read_plan(path: str | Path) -> Recorded:
    """Read back what :func:`write_plan` wrote.

    Returns
    -------
    Result or Plan
        What was written; its solution is ``None`` where the record has no objective.

    Raises
    ------
    InvalidInput
        Naming the file, or the key that is missing or cannot be used.
    """
    path = Path(path)
    try:
        document = json.loads(path.read_bytes(), parse_constant=_refuse_constant)
    except OSError as error:
        raise InvalidInput(str(path), "to be a readable file", error.strerror) from None
    except InvalidInput as error:
        raise InvalidInput(path.name, error.expected, error.got) from None
    except (ValueError, RecursionError) as error:
        raise InvalidInput(path.name, "to be JSON", error) from None
    return plan_from_record(document)


def _refuse_constant(name: str) -> Any:
    raise InvalidInput("the document", "to hold finite numbers only", name)
