"""``windopt yaw-table``: misalignments by wind direction and speed."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from windopt.cli import options as opt
from windopt.cli.farm_options import RotorOptions, SteeringOptions
from windopt.cli.terminal import counter, note, say
from windopt.cli.unfolded import unfolded
from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY
from windopt.errors import InvalidInput
from windopt.io.whole_files import require_absent
from windopt.io.yaw_tables import require_table_name, write_yaw_table
from windopt.planning.yaw import DEFAULT_METHOD
from windopt.planning.yaw_table import LARGEST, TableOptions, plan_yaw_table
from windopt.result import Status

RANGE = "numbers with commas, or FROM:TO:STEP with TO included"
Speeds = Annotated[str, typer.Option(metavar="LIST", help=f"Wind speeds [m/s]: {RANGE}.")]
Directions = Annotated[
    str, typer.Option(metavar="LIST", help=f"Where the wind blows from [deg]: {RANGE}.")
]
TableFile = Annotated[Path, typer.Option("--out", help="File to write, .csv or .nc.")]
Jobs = Annotated[int, typer.Option(help="Processors at work; -1 for all.")]


@unfolded
def yaw_table(
    farm: opt.FarmName,
    out: TableFile,
    speeds: Speeds = "8",
    directions: Directions = "0:355:5",
    method: opt.YawMethod = DEFAULT_METHOD,
    air_density: opt.AirDensity = STANDARD_AIR_DENSITY,
    jobs: Jobs = -1,
    time_limit: opt.TimeLimit = 3600.0,
    seed: opt.Seed = 0,
    force: opt.Force = False,
    *,
    rotors: RotorOptions,
    steered: SteeringOptions,
) -> None:
    """Tabulate the best misalignments over wind directions and speeds, in FLORIS's columns."""
    require_table_name(out)
    require_absent(out, force=force)
    v = parsed_range("--speeds", speeds)
    theta = np.radians(np.unique(parsed_range("--directions", directions) % 360.0))
    site = rotors.equipped(Farm.load(farm))
    note(site.notes)
    with counter(f"Tabulating {len(v) * len(theta)} winds over {site.name} by {method}") as done:
        result = plan_yaw_table(
            site,
            v,
            theta,
            method=method,
            steering=steered.steering,
            air_density=air_density,
            options=TableOptions(jobs, time_limit, seed),
            done=done,
        )
    table = result.found()
    write_yaw_table(table, out, force=force)
    say(
        f"{site.name}: {result.objective / 1e6:.3f} MW in the mean over {table.power.size} winds, "
        f"{table.gain:+.2%} over facing them; bound {result.bound / 1e6:.3f} MW, "
        f"{result.runtime:.1f} s. Written to {out}."
    )
    if result.status is Status.INTERRUPTED:
        say(result.sentence)


def parsed_range(option: str, text: str) -> NDArray[np.float64]:
    """Return the numbers of a list, ``6,8,10``, or of a range, ``0:355:5``.

    Raises
    ------
    InvalidInput
        Naming the option, if the text is neither.
    """
    refusal = InvalidInput(option, f"to be {RANGE}", repr(text))
    try:
        numbers = [float(part) for part in text.replace(":", ",").split(",")]
    except ValueError:
        raise refusal from None
    if not np.isfinite(numbers).all():
        raise refusal
    if ":" not in text:
        return np.array(numbers)
    if len(numbers) != 3 or "," in text:
        raise refusal
    first, last, step = numbers
    if not (step > 0 and first <= last and (last - first) / step < LARGEST):
        raise refusal
    steps: NDArray[np.float64] = np.arange(int((last - first) / step + 1e-9) + 1.0)
    return first + step * steps
