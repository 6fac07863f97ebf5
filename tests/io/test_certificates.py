"""Certificates in files: read back as written, and refused with the key that is wrong."""

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import windopt.io.certificates
from windopt.domain.certificate import Case, Certificate, Proof, Round, Sent, Together
from windopt.errors import InvalidInput
from windopt.io.certificates import (
    certificate_from_record,
    certificate_record,
    read_certificate,
    write_certificate,
)

PLACE = Path(windopt.io.certificates.__file__)
SCHEMA = json.loads(PLACE.with_name("certificate.schema.json").read_text(encoding="utf-8"))


def certificate():
    """Return a certificate with a case of each kind; it proves nothing."""
    triple, penalty = np.array([[0, 1, 2]]), np.array([0.1])
    cut = Round(np.array([1.0, 2.0, 1 / 3]), np.array([0.0, -1.0, 0.0]), triple, penalty)
    plain = Round(np.ones(3), np.zeros(3), np.zeros((0, 3), np.int64), np.zeros(0))
    inner = Case((plain,), Sent(1, 2), Case(), Case((plain, cut)))
    root = Case((cut,), Together(0, 2), inner, Case((), Sent(2, 4), Case(), Case()))
    proof = Proof(100.0, np.array([30.0, -1e-9, 50.0]), np.zeros(3), ((0, 1), (), (2,)), root)
    return Certificate(("A", "B", "C"), ("S", "T"), proof)


def record():
    return certificate_record(certificate())


def test_a_certificate_is_read_back_as_it_was_written(tmp_path):
    path = write_certificate(certificate(), tmp_path / "certificate.json")
    assert certificate_record(read_certificate(path)) == record()
    assert json.loads(path.read_text(encoding="ascii")) == record()


def test_what_is_written_follows_the_schema():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    jsonschema.validate(record(), SCHEMA)


def test_a_file_is_not_overwritten_unless_forced(tmp_path):
    path = write_certificate(certificate(), tmp_path / "certificate.json")
    with pytest.raises(InvalidInput, match="new file"):
        write_certificate(certificate(), path)
    write_certificate(certificate(), path, force=True)


def put(*keys, value):
    """Return an edit of a record that puts ``value`` where ``keys`` lead."""

    def edit(record):
        for key in keys[:-1]:
            record = record[key]
        record[keys[-1]] = value

    return edit


@pytest.mark.parametrize(
    ("edit", "field"),
    [
        (put("schema", value="windopt/plan"), "schema"),
        (put("version", value=99), "version"),
        (put("bound", value="100"), "bound"),
        (put("bound", value=-1.0), "bound"),
        (put("prices", value=[1.0, 2.0]), "neighbours"),
        (put("prices", 0, value=None), r"prices\[0\]"),
        (put("tolls", value=[0.0]), "prices and tolls"),
        (put("stations", value=["S"]), "prices and tolls"),
        (put("neighbours", 0, value=[3]), "neighbours"),
        (put("neighbours", 0, value=[-1]), r"neighbours\[0\]\[0\]"),
        (put("case", "rounds", 0, "penalties", value=[-0.1]), "penalties"),
        (put("case", "rounds", 0, "penalties", value=[0.1, 0.1]), "triples"),
        (put("case", "rounds", 0, "triples", value=[[0, 1]]), r"triples\[0\]"),
        (put("case", "rounds", 0, "triples", value=[[0, 1, 1]]), "triples"),
        (put("case", "rounds", 0, "triples", value=[[0, 1, 3]]), "triples"),
        (put("case", "rounds", 0, "triples", value=[[0, 1, 1.5]]), r"triples\[0\]\[2\]"),
        (put("case", "question", "together", value=[0, 0]), "together"),
        (put("case", "question", "together", value=[0, 3]), "together"),
        (put("case", "question", "together", value=[0]), "together"),
        (put("case", "no", "question", "station", value=3), "station"),
        (put("case", "no", "question", "sends_at_most", value=2.5), "sends_at_most"),
        (put("case", "no", value=None), "case.no"),
        (lambda record: record["case"].pop("yes"), "case.yes"),
        (lambda record: record.pop("case"), "case"),
    ],
)
def test_what_cannot_be_used_is_named(edit, field):
    document = record()
    edit(document)
    with pytest.raises(InvalidInput, match=f"Expected .*{field}"):
        certificate_from_record(document)


def test_cases_nested_without_end_are_refused():
    document = record()
    for _ in range(2000):
        question, empty = {"together": [0, 1]}, {"rounds": []}
        document["case"] = {
            "rounds": [], "question": question, "yes": document["case"], "no": empty,
        }  # fmt: skip
    with pytest.raises(InvalidInput, match="case"):
        certificate_from_record(document)


@pytest.mark.parametrize("kept", [0, 1, 10, 200, -2])
def test_a_truncated_file_is_named(tmp_path, kept):
    path = write_certificate(certificate(), tmp_path / "certificate.json")
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(InvalidInput, match=r"certificate\.json"):
        read_certificate(path)
