"""Options out of their range, refused with their name and value before anything else is read."""

import pytest

NORTH = "--wind-speed", "10", "--wind-direction"
REFUSED = [
    (("inspect", "--time-limit", "-5"), "--time-limit >= 0, got -5.0"),
    (("inspect", "--time-limit", "nan"), "--time-limit >= 0, got nan"),
    (("stations", "--time-limit", "nan"), "--time-limit >= 0, got nan"),
    (("inspect", "--gap", "nan"), "--gap >= 0 and < 1, got nan"),
    (("inspect", "--gap", "2"), "--gap >= 0 and < 1, got 2.0"),
    (("plan", "--gap", "-1"), "--gap >= 0 and < 1, got -1.0"),
    (("inspect", "--memory", "nan"), "--memory of at least 0.1 GB, got nan"),
    (("inspect", "--memory", "0.05"), "--memory of at least 0.1 GB, got 0.05"),
    (("inspect", "--seed", "-1"), "--seed >= 0, got -1"),
    (("inspect", "--max-flights", "-1"), "--max-flights >= 0, got -1"),
    (("inspect", *NORTH, "400"), "--wind-direction from -360 to 360 deg, got 400.0"),
    (("yaw", *NORTH, "nan"), "--wind-direction from -360 to 360 deg, got nan"),
    (("yaw", "--nacelle", "-361"), "--nacelle from -360 to 360 deg, got -361.0"),
    (("forecast", "train", "--epochs", "0"), "--epochs >= 1, got 0"),
    (("forecast", "evaluate", "shipped", "--test", "1"), "--test from 0.01 to 0.99, got 1.0"),
]


@pytest.mark.parametrize(("words", "sentence"), REFUSED)
def test_a_number_out_of_range_is_named_with_its_value(windopt, words, sentence):
    code, out, err = windopt(*words, "nowhere.csv")
    assert (code, out, err) == (2, "", f"Expected {sentence}.\n")


@pytest.mark.parametrize(
    ("command", "option", "known"),
    [
        ("demo", "--method", "exact, time-flow"),
        ("inspect", "--method", "exact, time-flow"),
        ("plan", "--method", "exact, time-flow"),
        ("plan", "--yaw-method", "nlp, serial-refine"),
        ("yaw", "--method", "nlp, serial-refine"),
        ("stations", "--method", "cover, k-means"),
        ("inspect", "--rule", "exact, paper"),
        ("plan", "--rule", "exact, paper"),
        ("plan", "--forecaster", "lstm, autoregression"),
        ("yaw", "--power-coefficient", "slootweg"),
        ("stations", "--candidates", "grid, platforms"),
    ],
)
def test_an_unknown_name_is_refused_before_anything_is_read(windopt, command, option, known):
    code, out, err = windopt(command, option, "fast")
    assert (code, out) == (2, "")
    assert err.startswith(f"Expected {option} to be one of {known}")
    assert err.endswith(", got 'fast'.\n")


@pytest.mark.parametrize("direction", ["360", "-360", "-90"])
def test_a_direction_may_be_counted_either_way_round(windopt, folder, direction):
    options = "--stations", "stations.csv", "--method", "algorithm-2"
    assert windopt("inspect", "farm.csv", *NORTH, direction, *options)[0] == 0
