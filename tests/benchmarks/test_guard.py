"""The guarded farms are planned as well, and proved as far, as when their lines were stored.

After a change of the instances or a better plan, ``python -m benchmarks run routing --set guard
--out benchmarks/results/guard`` stores new lines.
"""

import pytest

from benchmarks.__main__ import RESULTS
from benchmarks.case import Case
from benchmarks.records import ROOT, read_lines
from benchmarks.routing import measure

STORED = read_lines(ROOT / RESULTS / "guard" / "routing.jsonl")
FIELDS = "problem", "instance", "method", "time_limit", "seed"
ROUNDING = 1e-6
"""Relative; objectives are stored to a microsecond, of sums in another order."""


@pytest.mark.parametrize("stored", STORED, ids=lambda line: f"{line['instance']}-{line['method']}")
def test_plans_and_proofs_are_no_worse_than_stored(stored):
    found = measure(Case(*(stored[field] for field in FIELDS)))
    assert found["hash"] == stored["hash"], "the instance has changed"
    assert found["status"] == stored["status"]
    assert found["objective"] == pytest.approx(stored["objective"], rel=ROUNDING)
    if stored["status"] == "optimal":
        assert found["bound"] == pytest.approx(stored["bound"], rel=ROUNDING)


def test_the_guard_holds_proofs_of_every_farm():
    proved = {line["farm"] for line in STORED if line["status"] == "optimal"}
    assert proved == {line["farm"] for line in STORED}
    assert len(proved) >= 3
