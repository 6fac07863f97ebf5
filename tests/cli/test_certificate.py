"""Certificates at the command line: proved, written, verified, and refused when touched."""

import json

import pytest

from windopt.checking import tails


@pytest.fixture(autouse=True)
def beside_a_farm(folder):
    """Run every command in a folder with a farm and a station."""


def inspect(windopt, *options):
    flights = "--stations", "stations.csv", "--wind-speed", "10", "--wind-direction", "90"
    certified = "--method", "exact", "--certificate", "proof.json", "--out", "plan"
    return windopt("inspect", "farm.csv", *flights, *certified, *options)


def check(windopt, *options):
    return windopt("check", "plan/plan.json", "--certificate", "proof.json", *options)


def test_a_plan_and_its_certificate_pass(windopt, tmp_path):
    code, _, err = inspect(windopt)
    assert code == 0
    assert "Certificate written to proof.json" in err
    copy = tmp_path / "plan" / "certificate.json"
    assert copy.read_bytes() == (tmp_path / "proof.json").read_bytes()
    code, out, _ = check(windopt)
    assert code == 0
    assert "no plan costs less than" in out
    assert "passed (1 flight" in out
    code, out, _ = check(windopt, "--json")
    told = json.loads(out)
    assert code == 0
    assert told["passed"]
    assert told["proved"]
    assert told["unverified"] == []


def test_a_certificate_that_is_there_is_not_overwritten(windopt, tmp_path):
    (tmp_path / "proof.json").write_text("mine", encoding="utf-8")
    code, _, err = inspect(windopt)
    assert code == 2
    assert "--certificate" in err
    assert not (tmp_path / "plan").exists()
    assert inspect(windopt, "--force")[0] == 0


def test_a_certificate_cannot_be_a_folder(windopt, tmp_path):
    (tmp_path / "proof.json").mkdir()
    code, out, err = inspect(windopt, "--force")
    assert (code, out) == (2, "")
    assert "Expected --certificate to be a file" in err


def test_a_folder_cannot_be_within_a_file(windopt):
    code, out, err = windopt(
        "inspect", "farm.csv", "--wind-speed", "10", "--wind-direction", "90", "--out", "farm.csv/x"
    )
    assert (code, out) == (2, "")
    assert "Expected --out to be a folder, got the file farm.csv." in err


def test_a_certificate_with_another_number_fails(windopt, tmp_path):
    inspect(windopt)
    file = tmp_path / "proof.json"
    record = json.loads(file.read_text(encoding="utf-8"))
    record["prices"][0] += 5.0
    file.write_text(json.dumps(record), encoding="utf-8")
    code, out, err = check(windopt)
    assert code == 1
    assert "certificate: at the first prices" in err
    assert "failed, 1 violation" in out


def test_what_cannot_be_verified_has_an_exit_code_of_its_own(windopt, monkeypatch):
    inspect(windopt)
    monkeypatch.setattr(tails, "MOST", 5)
    code, out, err = check(windopt)
    assert code == 3
    assert "too many" in err
    assert "could not be verified" in out
    assert "passed" not in out


def test_a_damaged_certificate_is_named(windopt, tmp_path):
    inspect(windopt)
    file = tmp_path / "proof.json"
    file.write_bytes(file.read_bytes()[:50])
    code, _, err = check(windopt)
    assert code == 2
    assert "proof.json" in err
