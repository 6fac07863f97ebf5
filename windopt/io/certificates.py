"""Certificates in JSON files, in the format that ``certificate.schema.json`` describes."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from windopt.domain.certificate import Case, Certificate, Proof, Question, Round, Sent, Together
from windopt.errors import InvalidInput
from windopt.io.entries import Entry
from windopt.io.plan_records import Record
from windopt.io.plans import read_json
from windopt.io.whole_files import write_whole

SCHEMA = "windopt/certificate"
VERSION = 1

DEEPEST = 200
"""Cases within cases that are read; proofs have some ten."""


def write_certificate(certificate: Certificate, path: str | Path, *, force: bool = False) -> Path:
    """Write a certificate, whole or not at all.

    Parameters
    ----------
    force
        Whether a file that is already there may be replaced.
    """
    record = certificate_record(certificate)
    text = json.dumps(record, separators=(",", ":"), allow_nan=False) + "\n"
    return write_whole(path, text, force=force)


def read_certificate(path: str | Path) -> Certificate:
    """Read back what :func:`write_certificate` wrote.

    Raises
    ------
    InvalidInput
        Naming the file, or the key that is missing or cannot be used.
    """
    return certificate_from_record(read_json(path))


def certificate_record(certificate: Certificate) -> Record:
    """Record a certificate; equal ones give equal records."""
    proof = certificate.proof
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "bound": float(proof.bound),
        "turbines": list(certificate.turbines),
        "stations": list(certificate.stations),
        "prices": proof.prices.tolist(),
        "tolls": proof.tolls.tolist(),
        "neighbours": [list(near) for near in proof.neighbours],
        "case": _case_record(proof.case, len(certificate.stations)),
    }


def _case_record(case: Case, k: int) -> Record:
    rounds = [
        {
            "prices": each.prices.tolist(),
            "tolls": each.tolls.tolist(),
            "triples": each.triples.tolist(),
            "penalties": each.penalties.tolist(),
        }
        for each in case.rounds
    ]
    if case.question is None or case.yes is None or case.no is None:
        return {"rounds": rounds}
    return {
        "rounds": rounds,
        "question": _question_record(case.question, k),
        "yes": _case_record(case.yes, k),
        "no": _case_record(case.no, k),
    }


def _question_record(question: Question, k: int) -> Record:
    if isinstance(question, Together):
        return {"together": [question.first, question.second]}
    station = None if question.station == k else question.station
    return {"station": station, "sends_at_most": question.most}


def certificate_from_record(document: Any) -> Certificate:
    """Rebuild a certificate from parsed JSON.

    Raises
    ------
    InvalidInput
        Naming the key that is missing or cannot be used.
    """
    record = Entry(document)
    if record["schema"].value != SCHEMA:
        raise record["schema"].refuse(f"to be {SCHEMA!r}")
    if record["version"].value != VERSION:
        raise record["version"].refuse(f"to be {VERSION}")
    stations = tuple(record["stations"].texts)
    proof = Proof(
        record["bound"].number,
        np.array(record["prices"].numbers),
        np.array(record["tolls"].numbers),
        tuple(tuple(_whole(i) for i in near) for near in record["neighbours"]),
        _case(record["case"], len(stations)),
    )
    return Certificate(tuple(record["turbines"].texts), stations, proof)


def _case(entry: Entry, k: int, depth: int = 0) -> Case:
    if depth > DEEPEST:
        raise InvalidInput("case", f"to hold cases within cases {DEEPEST} deep", "deeper ones")
    rounds = tuple(_round(each) for each in entry["rounds"])
    if "question" not in entry:
        return Case(rounds)
    question = _question(entry["question"], k)
    yes, no = (_case(entry[answer], k, depth + 1) for answer in ("yes", "no"))
    return Case(rounds, question, yes, no)


def _round(entry: Entry) -> Round:
    triples = [_triple(each) for each in entry["triples"]]
    return Round(
        np.array(entry["prices"].numbers),
        np.array(entry["tolls"].numbers),
        np.array(triples, np.int64).reshape(-1, 3),
        np.array(entry["penalties"].numbers),
    )


def _triple(entry: Entry) -> list[int]:
    triple = [_whole(each) for each in entry]
    if len(triple) != 3:
        raise entry.refuse("to be three turbines")
    return triple


def _question(entry: Entry, k: int) -> Question:
    if "together" in entry:
        pair = [_whole(each) for each in entry["together"]]
        if len(pair) != 2:
            raise entry["together"].refuse("to be two turbines")
        return Together(*pair)
    station = entry.nullable("station")
    return Sent(k if station is None else _whole(station), _whole(entry["sends_at_most"]))


def _whole(entry: Entry) -> int:
    if type(entry.value) is not int or not 0 <= entry.value < 2**31:
        raise entry.refuse("to be a whole number >= 0")
    return entry.value
