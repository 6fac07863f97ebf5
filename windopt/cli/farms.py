"""``windopt farms``: the farms that go by a name."""

from json import dumps
from typing import Annotated

import typer

from windopt.cli.options import Json
from windopt.cli.outcome import DONE, FAILED
from windopt.cli.terminal import complain, counted, say
from windopt.io.optiwindnet import optiwindnet_farms

Like = Annotated[
    str, typer.Argument(metavar="[PART]", help="Only farms whose name or handle holds this.")
]


def farms(like: Like = "", json: Json = False) -> None:
    """List the farms of OptiWindNet, which other commands take by name or handle."""
    part = like.strip().casefold()
    found = [
        farm
        for farm in optiwindnet_farms()
        if part in farm.name.casefold() or part in farm.handle.casefold()
    ]
    if json:
        typer.echo(dumps([farm._asdict() for farm in found], indent=2, ensure_ascii=False))
    else:
        names = max((len(farm.name) for farm in found), default=0)
        handles = max((len(farm.handle) for farm in found), default=0)
        for farm in found:
            size = counted(farm.turbines, "turbine")
            say(f"{farm.name:{names}}  {farm.handle:{handles}}  {size}")
    if not found:
        complain(f"No farm's name or handle holds {like!r}.")
    raise typer.Exit(DONE if found else FAILED)
