"""The paper's tables with ours beside its own; its figures are printed in it, ours are measured."""

from collections.abc import Callable, Mapping, Sequence

from benchmarks.case import Record
from benchmarks.report.lines import Rows

ERRORS = "speed MAE", "speed RMSE", "direction MAE", "direction RMSE"
FIELDS = "speed_mae", "speed_rmse", "direction_mae", "direction_rmse"

PAPER_FORECASTS = {
    "LSTM, every 5 minutes": (0.0403, 0.0573, 0.0596, 0.1151),
    "LSTM, hour ahead": (0.0719, 0.0972, 0.1051, 0.1687),
}
PAPER_BITS = {
    "32": (0.0403, 0.0573, 0.0596, 0.1151),
    "16": (0.0396, 0.0554, 0.0609, 0.1192),
    "8": (0.0392, 0.0579, 0.0608, 0.1191),
    "4": (0.0401, 0.0571, 0.0598, 0.1183),
    "2": (0.0431, 0.0614, 0.0807, 0.1308),
}
PAPER_YAW = {
    "true wind": ("129", "10", "19861.2"),
    "every 5 minutes": ("127", "16", "17952.1"),
    "hour ahead": ("44", "49", "12428.0"),
}
PAPER_ROUTING = {
    "without reassignment": (40.5051, "B110-C214-A106-B110, B110-E105-A411-B110, A213-D101-A213"),
    "algorithm-2": (30.0741, "B110-C214-A106-A411-B110, A213-D101-E105-A213"),
}
FORECASTERS = {
    "persistence": "persistence",
    "autoregression": "autoregression",
    "lstm-32": "LSTM",
    "hour-ahead-persistence": "hour ahead, persistence",
    "hour-ahead-autoregression": "hour ahead, autoregression",
    "hour-ahead-lstm": "hour ahead, LSTM",
}


def rows_of(records: Sequence[Record], table: str) -> Mapping[str, Record]:
    """Return the rows of a table that were made, by name."""
    return {
        record["instance"].partition("/")[2]: record
        for record in records
        if record["problem"] == "paper"
        and record["instance"].startswith(f"{table}/")
        and record["status"] != "failed"
    }


def forecasting(records: Sequence[Record]) -> Rows:
    """Return the errors, normalised as the paper does, over all steps ahead."""
    ours = rows_of(records, "forecast")
    rows = [["forecast", *ERRORS]]
    rows += [[f"paper: {name}", *map(str, errors)] for name, errors in PAPER_FORECASTS.items()]
    for method, name in FORECASTERS.items():
        if method in ours:
            rows.append([f"ours: {name}", *_errors(ours[method])])
    return rows


def bits(records: Sequence[Record]) -> Rows:
    """Return the errors of the LSTM by the bits of its weights."""
    ours = rows_of(records, "forecast")
    rows = [["bits", *(f"{error}, {whose}" for whose in ("paper", "ours") for error in ERRORS)]]
    for width, errors in PAPER_BITS.items():
        found = ours.get(f"lstm-{width}")
        rows.append([width, *map(str, errors), *(_errors(found) if found else ["-"] * 4)])
    return rows


def _errors(record: Record) -> list[str]:
    return [f"{record['normalised'][field]:.4f}" for field in FIELDS]


def yaw(records: Sequence[Record]) -> Rows:
    """Return the energy of one turbine that turns to what is expected [kWh]."""
    rows = [["nacelle turned to", "one hour", "yaw error deg", "one day", "day lost"]]
    best = float(PAPER_YAW["true wind"][2])
    for name, (hour, yaw_angle, day) in PAPER_YAW.items():
        lost = f"{1 - float(day) / best:.2%}"
        rows.append([f"paper: {name}", hour, f"(yaw {yaw_angle})", day, lost])
    ours = rows_of(records, "yaw")
    for name, record in ours.items():
        best = ours["true wind"]["day_kwh"] if "true wind" in ours else record["day_kwh"]
        rows.append(
            [f"ours: {name}", f"{record['hour_kwh']:.1f}", f"{record['hour_degrees_off']:.1f}",
             f"{record['day_kwh']:.1f}", f"{1 - record['day_kwh'] / best:.2%}"]
        )  # fmt: skip
    return rows


def routing(records: Sequence[Record]) -> Rows:
    """Return the total flight times [min] and the flights."""
    rows = [["plan", "minutes", "no plan below", "flights"]]
    for name, (minutes, flights) in PAPER_ROUTING.items():
        rows.append([f"paper: {name}", f"{minutes:.4f}", "-", flights])
    for where in "reconstructed", "walney":
        for name, record in rows_of(records, f"routing on {where}").items():
            flights = ", ".join(record["flights"])
            left = ", ".join(record["unreachable"])
            rows.append(
                [f"{where}: {name}", f"{record['minutes']:.4f}", f"{record['bound_minutes']:.4f}",
                 f"{flights}; out of reach: {left}" if left else flights]
            )  # fmt: skip
    return rows


TABLES: Mapping[str, Callable[[Sequence[Record]], Rows]] = {
    "Forecasting: errors, normalised": forecasting,
    "Bits of the weights": bits,
    "Yaw: energy of one turbine, kWh": yaw,
    "Routing: seven turbines, 10 m/s from the east": routing,
}
"""The four tables by title."""
