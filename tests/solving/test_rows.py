"""The rows of a model against a program small enough to see."""

import highspy
import numpy as np
import pytest

from windopt.solving.rows import matrix, rows


@pytest.fixture
def model():
    """Two binaries: 3 x + 2 y >= 4 and x - y = 0."""
    model = highspy.Highs()
    model.silent()
    x, y = model.addBinaries(2)
    model.addConstr(3 * x + 2 * y >= 4)
    model.addConstr(x - y == 0)
    return model


def test_the_matrix_holds_the_coefficients(model):
    assert matrix(model.getLp()).toarray().tolist() == [[3.0, 2.0], [1.0, -1.0]]


@pytest.mark.parametrize(
    ("values", "violation"),
    [
        ([1.0, 1.0], 0.0),
        ([0.0, 0.0], 4.0),
        ([1.0, 0.0], 1.0),
        ([2.0, 2.0], 1.0),  # beyond its bounds
    ],
)
def test_the_worst_row_or_bound_counts(model, values, violation):
    assert rows(model.getLp()).largest_violation(np.array(values)) == violation


def test_rows_stay_what_they_were_when_the_model_changes(model):
    before = rows(model.getLp())
    model.changeColsBounds(2, np.arange(2, dtype=np.int32), np.zeros(2), np.zeros(2))
    model.changeRowBounds(0, 10.0, 10.0)
    assert before.largest_violation(np.ones(2)) == 0.0
