"""What more clearance than required would cost, and how much of it is taken.

Tested through ``planning/test_roomy_path``.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class TriedClearance:
    """A path that was to keep more than is required.

    Attributes:
        clearance: How much more [m].
        duration: The time in which it is driven, as far as its shape tells [s]; None where no path
            was found.
        taken: Whether the plan takes it.
    """

    clearance: float
    duration: float | None
    taken: bool


@dataclass(frozen=True)
class PreferredClearance:
    """What was weighed.

    Attributes:
        asked: Free space beyond what is required that the mission likes to be kept [m].
        duration: The time of the path that keeps what is required alone [s].
        most_duration: The most that a path may take that keeps more [s].
        tried: From the most clearance to the least.
    """

    asked: float
    duration: float
    most_duration: float
    tried: tuple[TriedClearance, ...]

    @property
    def taken(self) -> float:
        """How much more than required is kept, where there is room for it [m]."""
        return next((one.clearance for one in self.tried if one.taken), 0.0)
