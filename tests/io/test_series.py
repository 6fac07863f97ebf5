"""Wind series: what files say, what is masked, and what is refused."""

import gzip
from contextlib import suppress
from math import radians
from time import process_time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.io.series import read_series

CLOCK_NOTE = "The time stamps name no time zone and are kept on their own clock."


@pytest.fixture
def write(tmp_path):
    def write(text, name="wind.csv"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def table(*rows, header="time,speed,direction"):
    """Return a table whose rows are ten minutes apart, unless they bring their own time."""
    stamps = (str(np.datetime64("2020-01-01T00:00") + 10 * i) for i in range(len(rows)))
    lines = (
        row if row.count(",") > 1 else f"{t},{row}" for t, row in zip(stamps, rows, strict=True)
    )
    return "\n".join([header, *lines, ""])


FOUR = ("5,0", "6,90", "7,180", "8,270")


def test_a_plain_table_is_read(write):
    series = read_series(write(table(*FOUR)))
    assert series.time[0] == np.datetime64("2020-01-01T00:00")
    assert series.step_seconds == 600
    np.testing.assert_array_equal(series.speed, [5, 6, 7, 8])
    np.testing.assert_allclose(series.theta_met, np.radians([0, 90, 180, 270]))
    assert (series.timezone, series.source, series.notes) == ("", "wind.csv", (CLOCK_NOTE,))


def test_the_door_of_the_domain_leads_here(write):
    assert len(WindSeries.read(write(table(*FOUR)))) == 4


@pytest.mark.parametrize(
    "header",
    ["time,ws,wd", "Timestamp,WindSpeed,WindDirection", "date_time,wind_speed_100m,wind_dir_100m",
     "UTC,wind speed at 100m (m/s),wind direction at 100m (deg)", "TIME,WS-100,WD-100",
     "datetime;Speed [m/s];Dir [°]", "Date/Time,ff,dd", "time_utc,wspd,wdir"],
)  # fmt: skip
def test_usual_names_are_recognised(write, header):
    text = table(*FOUR, header=header)
    if ";" in header:
        text = text.replace(",", ";")
    assert read_series(write(text)).speed.tolist() == [5, 6, 7, 8]


def test_columns_can_be_named(write):
    text = table(*(f"2020-01-01T00:0{i},9,5,0,7" for i in range(4)), header="when,ws-50,ws-90,a,b")
    series = read_series(write(text), time="when", speed="ws-90", direction="a")
    assert series.speed.tolist() == [5] * 4


def test_several_columns_that_fit_are_listed(write):
    text = table(*(f"2020-01-01T00:0{i},9,5,0" for i in range(4)), header="time,WS-50,WS-90,WD")
    with pytest.raises(InvalidInput, match=r"speed column to be chosen from WS-50, WS-90"):
        read_series(write(text))


@pytest.mark.parametrize(
    ("header", "complaint"),
    [
        ("time,gust,direction", "a column of speed in the file, got the columns time, gust"),
        ("a,speed,direction", "a column of time in the file"),
        ("time,speed (knots),direction", "speed column in m/s, got knots"),
        ("time,speed,direction (rad)", "direction column in deg, got rad"),
        ("1,2,3", "a column of time"),
    ],
)
def test_a_missing_or_foreign_column_is_named(write, header, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        read_series(write(table(*FOUR, header=header)))
    with pytest.raises(InvalidInput, match="a column wind in the file"):
        read_series(write(table(*FOUR)), speed="wind")


TOOLKIT = """SiteID, 53252.0
Longitude, -103.04
Latitude, 40.45
Year,Month,Day,Hour,Minute,density (kg/m^3),wind direction at 100m (deg),wind speed at 100m (m/s)
2011,2,28,23,50,1.1,318.1,11.8
2011,2,28,23,55,1.1,317.8,12.0
2011,3,1,0,0,1.1,318.2,12.1
2011,3,1,0,5,1.1,319.0,12.2
"""


def test_the_wind_toolkits_own_format_is_read(write):
    series = read_series(write(gzip.compress(TOOLKIT.encode()), "wtk.csv.gz"))
    assert series.time[2] == np.datetime64("2011-03-01T00:00")
    assert series.step_seconds == 300
    assert series.speed.tolist() == [11.8, 12.0, 12.1, 12.2]
    assert series.source == "wtk.csv.gz (SiteID 53252.0, Longitude -103.04, Latitude 40.45)"
    assert series.timezone == ""


def test_the_wind_toolkits_api_says_when_it_is_utc(write):
    lines = TOOLKIT.splitlines()[3:]
    site = "SiteID,53252,Site Timezone,-7,Data Timezone,0,Longitude,-103.04,Latitude,40.45"
    series = read_series(write("\n".join([site, *lines])))
    assert (series.timezone, series.notes) == ("UTC", ())


@pytest.mark.parametrize("bad", ["2011,2,30,0,0", "2011,13,1,0,0", "2011,3,1,24,0", "2011,3,1,0,x"])
def test_parts_of_a_time_are_checked(write, bad):
    with pytest.raises(InvalidInput, match="line 8"):
        read_series(write(TOOLKIT.replace("2011,3,1,0,5", bad)))


def test_offsets_are_brought_to_utc(write):
    rows = [f"2020-06-01T0{hour}:00:00{offset},5,0" for hour, offset in
            [(1, "+02:00"), (2, "+02:00"), (2, "+01:00"), (2, "Z")]]  # fmt: skip
    series = read_series(write(table(*rows)))
    assert series.timezone == "UTC"
    assert (
        series.time.astype("datetime64[h]").tolist()
        == np.arange("2020-05-31T23", "2020-06-01T03", dtype="datetime64[h]").tolist()
    )
    assert CLOCK_NOTE not in series.notes


@pytest.mark.parametrize("zone", ["UTC", " UTC", "GMT", " GMT", "Z", "+00:00"])
def test_stamps_may_name_their_zone(write, zone):
    rows = [f"2020-06-01 0{hour}:00{zone},5,0" for hour in range(4)]
    series = read_series(write(table(*rows)))
    assert series.timezone == "UTC"
    assert series.time[0] == np.datetime64("2020-06-01T00:00")


def test_zones_of_their_own_are_brought_to_utc_row_by_row(write):
    clocks = "00:00 UTC", "02:00+01:00", "04:00+02:00", "03:00 GMT"
    series = read_series(write(table(*(f"2020-06-01 {clock},5,0" for clock in clocks))))
    assert (np.diff(series.time) == np.timedelta64(1, "h")).all()


def test_stamps_with_and_without_a_zone_name_do_not_mix(write):
    rows = [f"2020-06-01 0{h}:00{zone},5,0" for h, zone in enumerate((" UTC", "", "", ""))]
    with pytest.raises(InvalidInput, match="to have an offset like the others"):
        read_series(write(table(*rows)))


def test_stamps_with_and_without_offset_do_not_mix(write):
    rows = [
        "2020-01-01T00:00Z,5,0",
        "2020-01-01T00:10,5,0",
        *(f"2020-01-01T00:{m}Z,5,0" for m in (20, 30)),
    ]
    with pytest.raises(InvalidInput, match="line 3 to have an offset like the others"):
        read_series(write(table(*rows)))


def test_what_cannot_be_true_is_masked_and_counted(write):
    rows = ("-999,-999", "5,9999", "9999,10", "-0.1,10", ",10", "5,", "nan,NA", "5,-90", "6,450")
    series = read_series(write(table(*rows)))
    np.testing.assert_array_equal(series.valid, [False] * 7 + [True, True])
    np.testing.assert_allclose(series.theta_met[-2:], [radians(270), radians(90)])
    assert "Values of 'speed' beyond 0 to 100, masked: 3." in series.notes
    assert "Values of 'direction' beyond -360 to 720, masked: 2." in series.notes
    assert "Rows without a valid speed or direction: 7 of 9." in series.notes


def test_gaps_are_filled_with_missing_values(write):
    rows = [f"2020-01-01T00:{m:02},{m},0" for m in (0, 5, 10, 30, 35)]
    series = read_series(write(table(*rows)))
    assert series.step_seconds == 300
    np.testing.assert_array_equal(series.speed, [0, 5, 10, np.nan, np.nan, np.nan, 30, 35])
    assert "Steps without a row, kept as missing values: 3 of 8." in series.notes


def test_rows_off_the_grid_move_to_the_nearest_step(write):
    stamps = ("00:00", "00:10", "00:20", "00:31", "00:40", "00:42", "00:50")
    series = read_series(write(table(*(f"2020-01-01T{t},{i},0" for i, t in enumerate(stamps)))))
    assert series.speed.tolist() == [0, 1, 2, 3, 5, 6]
    assert "Rows between two steps, moved to the nearest: 2." in series.notes
    assert "Rows that share a step with a later one, left out: 1." in series.notes


def test_a_clock_that_trembles_has_the_step_it_means(write):
    late = np.random.default_rng(0).integers(0, 40, 200).astype("m8[s]")
    stamps = np.datetime64("2020-01-01T00:00:00") + np.arange(200) * np.timedelta64(5, "m") + late
    series = read_series(write(table(*(f"{t},{i % 20},0" for i, t in enumerate(stamps)))))
    assert series.step_seconds == 300
    assert len(series) == 200


def test_a_reversed_file_is_turned_round(write):
    text = table(*FOUR).splitlines()
    series = read_series(write("\n".join([text[0], *reversed(text[1:])])))
    assert series.speed.tolist() == [5, 6, 7, 8]
    assert "The rows run backwards in time and were turned round." in series.notes


@pytest.mark.parametrize(
    ("stamps", "complaint"),
    [
        (("00:00", "00:10", "00:10", "00:20"), "repeats at line 4"),
        (("00:00", "00:20", "00:10", "00:30"), "turns back at line 4"),
        (("00:00", "00:10", "yesterday", "00:30"), "'time' in line 4 to be an ISO 8601 time"),
        (("00:00", "00:10", "", "00:30"), "'time' in line 4"),
    ],
)
def test_times_that_do_not_advance_are_refused(write, stamps, complaint):
    rows = [f"2020-01-01T{t},5,0" if ":" in t else f"{t},5,0" for t in stamps]
    with pytest.raises(InvalidInput, match=complaint):
        read_series(write(table(*rows)))


def test_scattered_rows_are_refused(write):
    rows = [
        f"{t},5,0"
        for t in ("2020-01-01T00:00:00", "2020-01-01T00:00:01", "2021-01-01", "2022-02-02")
    ]
    with pytest.raises(InvalidInput, match="one step with few gaps"):
        read_series(write(table(*rows)))


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "an empty file"),
        (table(*FOUR[:3]), "at least 4 rows"),
        (table("5,x", *FOUR), "'direction' in line 2 to be a number, got 'x'"),
        (table(*FOUR, "inf,0"), "'speed' in line 6 to be a finite number"),
        (table(*("-999,0",) * 5), "known in some row, got none"),
        (table(*FOUR) + "2020-01-01T00:40,5", "line 6 to have 3 cells, got 2"),
        (b"\x89PNG\r\n\x1a\n\x00\x00", "a text file"),
        (b"\x89PNG\r\n\x1a\n\xff\xfe", "a column of time"),
        (gzip.compress(table(*FOUR).encode(), mtime=0)[:40], "readable file"),
        (gzip.compress(b"", mtime=0)[:5], "readable file"),
        (b"\x1f\x8b" + b"x" * 30, "readable file"),
    ],
)
def test_what_cannot_be_used_is_named(write, text, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        read_series(write(text))


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    for path in (tmp_path / "none.csv", tmp_path):
        with pytest.raises(InvalidInput, match="readable file"):
            read_series(path)


def test_a_degree_sign_in_an_old_encoding_is_no_obstacle(write):
    text = table(*FOUR, header="time,speed,direction (°)")
    assert len(read_series(write(text.encode("latin-1")))) == 4


@pytest.mark.slow
def test_a_million_rows_are_read_in_seconds(write):
    times = np.datetime64("2000-01-01T00:00") + np.arange(10**6)
    rows = (f"{time},{i % 25},{i % 360}" for i, time in enumerate(times.astype(str).tolist()))
    path = write("\n".join(["time,speed,direction", *rows]))
    start = process_time()
    assert len(read_series(path)) == 10**6
    assert process_time() - start < 30  # 5 s on a laptop


CELLS = st.sampled_from(
    ["time", "speed", "direction", "2020-01-01", "2020-01-02T00:00Z", "0001-01-01", "9999-12-31",
     "5", "-999", "1e308", "nan", "", '"', "Year", "#"]
)  # fmt: skip
LINES = st.lists(CELLS | st.text(max_size=4), max_size=4).map(",".join)


@given(lines=st.lists(LINES, max_size=8), header=st.booleans())
def test_no_table_makes_the_reader_stumble(tmp_path_factory, lines, header):
    path = tmp_path_factory.mktemp("series") / "wind.csv"
    text = "\n".join(["time,speed,direction"] * header + lines)
    path.write_text(text, encoding="utf-8", newline="")
    with suppress(InvalidInput):
        assert len(read_series(path)) >= 4


@given(content=st.binary(max_size=60), zipped=st.booleans())
def test_no_bytes_make_the_reader_stumble(tmp_path_factory, content, zipped):
    path = tmp_path_factory.mktemp("series") / "wind.csv"
    path.write_bytes(b"\x1f\x8b\x08" + content if zipped else content)
    with pytest.raises(InvalidInput):
        read_series(path)
