"""What a farm is steered under, from options in the units people use."""

from math import inf, radians

from windopt.domain.steering import Steering


def given_steering(
    turbulence: float | None = None,
    bounds: tuple[float, float] | None = None,
    direction_std: float | None = None,
    farm_cap: float | None = None,
) -> Steering:
    """Return the steering that the options ask for; ``None`` stands for the usual.

    Parameters
    ----------
    turbulence
        Intensity [-].
    bounds
        Least and largest misalignment [deg].
    direction_std
        Standard deviation of the wind's direction [deg].
    farm_cap
        The most the grid takes [MW].
    """
    usual = Steering()
    lower, upper = (usual.lower, usual.upper) if bounds is None else map(radians, bounds)
    return Steering(
        usual.turbulence if turbulence is None else turbulence,
        lower,
        upper,
        radians(direction_std or 0.0),
        farm_cap=inf if farm_cap is None else 1e6 * farm_cap,
    )
