"""The independent checker: recomputes plans from the domain types alone.

It imports no formulation and no solver, so that it cannot share a mistake with what it checks.
"""

from windopt.checking.check import check
from windopt.checking.report import Report

__all__ = ["Report", "check"]
