"""Turbine types where a source gives no more than rated powers, or not even those."""

from collections.abc import Sequence

from windopt.domain.turbine import SG_8_167, TurbineType

CURVE_NOTE = (
    "The source gives no thrust coefficients; power and thrust follow the C_p model slootweg."
)
DEFAULT_NOTE = f"The source names no turbine type; {SG_8_167.name} is assumed."
SCALED_NOTE = (
    "The source gives rated powers only; rotors are scaled from the "
    f"{SG_8_167.name} at equal power per swept area."
)
TYPE_NOTES = CURVE_NOTE, DEFAULT_NOTE, SCALED_NOTE
"""What no longer holds of a farm whose turbines are replaced."""


def types_by_rating(
    ratings: Sequence[float | None],
) -> tuple[list[TurbineType], tuple[str, ...]]:
    """Return a turbine type for each rated power, one object per power, and notes on them.

    Parameters
    ----------
    ratings
        Rated power of each turbine [W]; ``None`` where the source gives none, and then the
        SG 8.0-167 DD is assumed.
    """
    types = {
        p: SG_8_167.scaled_to(p) if p is not None else SG_8_167 for p in dict.fromkeys(ratings)
    }
    notes = []
    if None in types:
        notes.append(DEFAULT_NOTE)
    if set(types) - {None}:
        notes.append(SCALED_NOTE)
    return [types[rating] for rating in ratings], tuple(notes)
