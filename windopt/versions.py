"""Which versions of what are at work: the first thing to paste into a report of a fault."""

import platform
import sys
from importlib.metadata import PackageNotFoundError, version

PACKAGES = (
    "windopt",
    "numpy",
    "scipy",
    "highspy",
    "casadi",
    "cvxpy",
    "numba",
    "torch",
    "optiwindnet",
    "matplotlib",
)


def versions() -> dict[str, str]:
    """Return the version of Python, the platform and each package windopt may use."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    return found


def show_versions() -> None:
    """Print :func:`versions`, one line each."""
    sys.stdout.writelines(f"{name:12} {value}\n" for name, value in versions().items())
