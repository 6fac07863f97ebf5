"""Yaw tables as files: FLORIS's columns, degrees and watts."""

import csv
import json

import numpy as np
import pytest
from scipy.io import netcdf_file

from windopt.domain.farm import Farm
from windopt.domain.steering import Steering
from windopt.domain.turbine import Turbine
from windopt.domain.yaw_table import YawTable
from windopt.errors import InvalidInput
from windopt.io.yaw_tables import COLUMNS, write_yaw_table

TABLE = YawTable(
    Farm("Two", (Turbine("A1", 0.0, 0.0), Turbine("Ø2", 900.0, 0.0))),
    np.radians([265.0, 270.0]),
    np.array([8.0, 10.0]),
    np.radians([[[20.0, 0.0], [15.0, -0.0]], [[-25.0, 1 / 3], [0.0, 0.0]]]),
    np.array([[4e6, 8e6], [3e6, 7e6]]),
    np.array([[3.9e6, 8e6], [2.5e6, 7e6]]),
    np.full((2, 2), 9e6),
    Steering(turbulence=0.08),
    1.225,
)


def test_a_csv_file_has_floriss_columns_and_a_row_for_each_wind(tmp_path):
    path = write_yaw_table(TABLE, tmp_path / "table.csv")
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == COLUMNS
    winds = [(float(row["wind_direction"]), float(row["wind_speed"])) for row in rows]
    assert winds == [(265.0, 8.0), (265.0, 10.0), (270.0, 8.0), (270.0, 10.0)]
    assert json.loads(rows[2]["yaw_angles_opt"]) == pytest.approx([-25.0, 1 / 3])
    assert "-0.0" not in path.read_text()
    assert float(rows[0]["farm_power_opt"]) == 4e6
    assert float(rows[0]["farm_power_baseline"]) == 3.9e6
    assert {row["turbulence_intensity"] for row in rows} == {"0.08"}


def test_a_netcdf_file_has_the_same_on_three_axes(tmp_path):
    path = write_yaw_table(TABLE, tmp_path / "table.nc")
    with netcdf_file(path, mmap=False) as file:
        assert file.variables["yaw_angles_opt"].dimensions == (
            "wind_direction",
            "wind_speed",
            "turbine",
        )
        yaw = file.variables["yaw_angles_opt"].data.copy()
        power = file.variables["farm_power_opt"].data.copy()
        assert json.loads(file.turbines) == ["A1", "Ø2"]
        assert file.turbulence_intensity == 0.08
    assert yaw == pytest.approx(np.degrees(TABLE.yaw))
    assert power == pytest.approx(TABLE.power)


def test_nothing_is_overwritten_and_other_endings_are_refused(tmp_path):
    write_yaw_table(TABLE, tmp_path / "table.csv")
    with pytest.raises(InvalidInput, match="--force"):
        write_yaw_table(TABLE, tmp_path / "table.csv")
    with pytest.raises(InvalidInput, match=r"--out to end in \.csv or \.nc"):
        write_yaw_table(TABLE, tmp_path / "table.xlsx")


def test_a_table_of_another_shape_is_refused():
    with pytest.raises(InvalidInput, match="yaw of shape"):
        YawTable(TABLE.farm, TABLE.directions, TABLE.speeds, TABLE.yaw[:1], *([TABLE.power] * 3),
                 TABLE.steering, 1.225)  # fmt: skip
