"""The clearance certificate: a proven lower bound over the whole continuous curve."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Certificate:
    """What is proven of a curve's clearance.

    Attributes:
        clearance: Proven lower bound of the distance between the robot's body and every obstacle
            and the bounds [m]; never above the true one, and within 1 mm of it. Infinite when
            there is nothing to keep clear of.
        required: The clearance that was asked for [m].
        tightest_at: Where it is tightest [m], shape (d,).
        tightest_u: The same as a parameter of the curve.
        tightest_distance: The same as a distance along the curve [m].
        obstacle: The name of the obstacle that is nearest there; None when there is none.
    """

    clearance: float
    required: float
    tightest_at: tuple[float, ...]
    tightest_u: float
    tightest_distance: float
    obstacle: str | None

    @property
    def holds(self) -> bool:
        """Whether the proven clearance is at least the one that was asked for."""
        return self.clearance >= self.required
