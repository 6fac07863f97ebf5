"""What a check found."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Report:
    """What a check found.

    Parameters
    ----------
    violations
        Every way in which the plan breaks a promise, a sentence each.
    warnings
        What holds by the plan's own rules and should be known all the same.
    flights, set_points
        How many of each were recomputed.
    unverified
        What could not be verified here, and may hold all the same, a sentence each.
    proved
        What a certificate was found to prove.
    """

    violations: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    flights: int = 0
    set_points: int = 0
    unverified: tuple[str, ...] = ()
    proved: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether the plan keeps every promise, and none had to be left unverified."""
        return not (self.violations or self.unverified)

    def __add__(self, other: "Report") -> "Report":
        """Return both reports as one."""
        return Report(
            self.violations + other.violations,
            self.warnings + other.warnings,
            self.flights + other.flights,
            self.set_points + other.set_points,
            self.unverified + other.unverified,
            self.proved + other.proved,
        )

    def about(self, subject: str) -> "Report":
        """Return the same report with ``subject`` before each sentence."""
        return Report(
            tuple(f"{subject}: {sentence}" for sentence in self.violations),
            tuple(f"{subject}: {sentence}" for sentence in self.warnings),
            self.flights,
            self.set_points,
            tuple(f"{subject}: {sentence}" for sentence in self.unverified),
            tuple(f"{subject}: {sentence}" for sentence in self.proved),
        )
