"""Plans in JSON files, in the format that ``plan.schema.json`` beside this file describes.

What the command line prints with ``--json`` is the same text.
"""

import json
from pathlib import Path
from typing import Any

from windopt.domain.plan import Plan, YawPlan
from windopt.errors import InvalidInput
from windopt.io.plan_reader import Recorded, plan_from_record
from windopt.io.plan_records import Record, inspection_record, plan_record, yaw_record
from windopt.io.whole_files import write_whole
from windopt.result import Result

__all__ = [
    "inspection_record",
    "json_text",
    "plan_record",
    "read_json",
    "read_plan",
    "record_of",
    "write_plan",
    "yaw_record",
]


def record_of(plan: Recorded) -> Record:
    """Record a plan of any kind.

    Parameters
    ----------
    plan
        A whole plan, or the result of planning an inspection or the yaw.

    Raises
    ------
    ValueError
        With the reason, if the result holds no plan.
    """
    if isinstance(plan, Plan):
        return plan_record(plan)
    result: Result[Any] = plan
    return yaw_record(result) if isinstance(plan.found(), YawPlan) else inspection_record(result)


def json_text(record: Record) -> str:
    """Return a record as JSON, in ASCII so that no terminal or pipe can garble it."""
    return json.dumps(record, indent=2, allow_nan=False) + "\n"


def write_plan(plan: Recorded, path: str | Path, *, force: bool = False) -> Path:
    """Write a plan of any kind, whole or not at all.

    Parameters
    ----------
    force
        Whether a file that is already there may be replaced.
    """
    return write_whole(path, json_text(record_of(plan)), force=force)


def read_plan(path: str | Path) -> Recorded:
    """Read back what :func:`write_plan` wrote.

    Returns
    -------
    Result or Plan
        What was written.

    Raises
    ------
    InvalidInput
        Naming the file, or the key that is missing or cannot be used.
    """
    return plan_from_record(read_json(path))


def read_json(path: str | Path) -> Any:
    """Read a JSON file that holds finite numbers only.

    Raises
    ------
    InvalidInput
        Naming the file.
    """
    path = Path(path)
    try:
        return json.loads(path.read_bytes(), parse_constant=_refuse_constant)
    except OSError as error:
        raise InvalidInput(str(path), "to be a readable file", error.strerror) from None
    except InvalidInput as error:
        raise InvalidInput(path.name, error.expected, error.got) from None
    except (ValueError, RecursionError) as error:
        raise InvalidInput(path.name, "to be JSON", error) from None


def _refuse_constant(name: str) -> Any:
    raise InvalidInput("the document", "to hold finite numbers only", name)
