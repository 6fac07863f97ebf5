"""The commands, gathered."""

from typing import Annotated

import typer

import windopt
from windopt.cli.check import check
from windopt.cli.demo import demo
from windopt.cli.farms import farms
from windopt.cli.forecast import app as forecast
from windopt.cli.inspect import inspect
from windopt.cli.plan import plan
from windopt.cli.stations import stations
from windopt.cli.yaw import yaw
from windopt.cli.yaw_table import yaw_table

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # units stand in brackets, which are markup to rich
    context_settings={"help_option_names": ["-h", "--help"]},
)
for command in demo, plan, inspect, yaw, yaw_table, stations, check, farms:
    app.command()(command)
app.add_typer(forecast, name="forecast", help="Train, ask and score forecasters of the wind.")


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"windopt {windopt.__version__}")
        raise typer.Exit


@app.callback()
def windopt_(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="The version.")
    ] = False,
) -> None:
    """Yaw set-points and UAV inspection flights for wind farms."""
