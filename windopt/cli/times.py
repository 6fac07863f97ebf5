"""Times as a user writes them."""

from datetime import datetime

import numpy as np

from windopt.errors import InvalidInput


def parsed(time: str | None) -> np.datetime64 | None:
    """Return a time given in ISO 8601, without a zone.

    Raises
    ------
    InvalidInput
        If it is not one, or names a zone: the series may be on another clock.
    """
    if time is None:
        return None
    try:
        stamp = datetime.fromisoformat(time)
    except ValueError:
        raise InvalidInput("--time", "like 2011-04-13T22:00", repr(time)) from None
    if stamp.tzinfo is not None:
        raise InvalidInput("--time", "on the series' own clock, without a zone", repr(time))
    return np.datetime64(stamp.isoformat())
