"""Coordinate systems by their many names, and the way to degrees and back."""

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.io.coordinates import projected_crs, to_degrees, to_metres, utm_crs, utm_crs_of


@pytest.mark.parametrize(
    "given",
    [32630, "32630", "EPSG:32630", "epsg:32630", "30U", "UTM 30 U", "utm zone 30u",
     "+proj=utm +zone=30 +datum=WGS84 +units=m +no_defs"],
)  # fmt: skip
def test_one_zone_has_many_names(given):
    assert projected_crs(given) == "EPSG:32630"


def test_bands_below_n_lie_south_of_the_equator():
    assert utm_crs(19, "H") == "EPSG:32719"
    assert utm_crs(19, "N") == "EPSG:32619"


@pytest.mark.parametrize("given", [4326, "EPSG:4326", "here", 999999, -1, "", "61U", "30I", "2263"])
def test_what_is_no_projected_system_in_metres_is_refused(given):
    with pytest.raises(InvalidInput):
        projected_crs(given)


def test_the_middle_of_zone_31_is_easting_500_km():
    x, y = to_metres("EPSG:32631", np.array([3.0]), np.array([0.0]))
    assert (x[0], y[0]) == pytest.approx((500_000.0, 0.0), abs=1e-6)


@pytest.mark.parametrize(
    ("longitude", "latitude", "crs"),
    [(3.0, 54.0, "EPSG:32631"), (-3.5, 54.0, "EPSG:32630"), (-71, -30, "EPSG:32719"),
     (-180.0, 10.0, "EPSG:32601"), (180.0, 10.0, "EPSG:32601")],
)  # fmt: skip
def test_points_lie_in_their_zone(longitude, latitude, crs):
    assert utm_crs_of(np.array([longitude]), np.array([latitude])) == crs


def test_points_beyond_the_globe_are_refused():
    with pytest.raises(InvalidInput, match="180 and 84"):
        utm_crs_of(np.array([200.0]), np.array([0.0]))


def test_metres_and_degrees_are_one_place():
    x, y = np.array([461_000.0, 470_000.0]), np.array([5_988_000.0, 5_991_000.0])
    back = to_metres("EPSG:32630", *to_degrees("EPSG:32630", x, y))
    np.testing.assert_allclose(back, (x, y), atol=1e-6)
