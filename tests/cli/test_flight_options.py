"""What is asked of flights is refused before stations are placed for them."""

import pytest

WIND = "--wind-speed", "10", "--wind-direction", "90"
COMMANDS = {
    "inspect": ("inspect", "farm.csv", *WIND),
    "plan": ("plan", "farm.csv", "--wind", "wind.csv"),
}
REFUSED = [
    (("--assignment", "farthest"), "--assignment to be nearest or a file that exists"),
    (("--assignment", "stations.csv"), "one column 'turbine'"),
    (("--worth", "nowhere.csv"), "--worth to be a number or a file that exists"),
    (("--worth", "worth.csv"), "turbine of the farm and no other, got none for A2"),
    (("--worth", "9", "--method", "baseline"), "method exact where"),
    (("--priorities", "nowhere.csv"), "nowhere.csv to be a readable file"),
    (("--priorities", "worth.csv"), "one column 'priority'"),
    (("--start", "nowhere.json"), "nowhere.json to be a readable file"),
    (("--start", "yaw.json"), "start to hold inspection flights"),
    (("--start", "flights.json", "--method", "baseline"), "time-flow, route-indexed with a start"),
]


@pytest.fixture
def unplaced(windopt, folder, monkeypatch):
    """Let no command place stations, in a folder with a few files more."""

    def place(*_, **__):
        raise AssertionError("stations placed although the rest cannot be used")

    (folder / "worth.csv").write_text("turbine,worth\nA1,100\n", encoding="utf-8")
    record = windopt("yaw", "farm.csv", *WIND, "--method", "algorithm-1", "--json")[1]
    (folder / "yaw.json").write_text(record, encoding="utf-8")
    for way in "stations_by_cover", "stations_by_k_means":
        monkeypatch.setattr(f"windopt.cli.fleets.{way}", place)


@pytest.mark.usefixtures("unplaced")
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(("options", "sentence"), REFUSED)
def test_files_and_methods_are_refused_before_stations_are_placed(
    windopt, command, options, sentence
):
    code, out, err = windopt(*COMMANDS[command], *options)
    assert (code, out) == (2, "")
    assert sentence in err
