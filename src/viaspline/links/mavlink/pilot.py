"""Who steers: state and time in, what to do out.

Tested through ``links/mavlink/test_closed_loop``.
"""

from __future__ import annotations

from typing import Final, NamedTuple, Protocol, Self

from viaspline.links.mavlink.setpoints import VehicleMotion
from viaspline.links.mavlink.vehicle_state import VehicleState

FAR_OFF_M: Final = 3.0
"""A vehicle that is farther off its path isn't following it, whatever is proven clear."""


class Steering(NamedTuple):
    """What a pilot has decided.

    Attributes:
        motion: What the vehicle is to do.
        beside: How far it is off its path [m].
        is_over: Whether the drive is over.
        failed: Why it won't reach its goal; None if it will.
        news: What has happened, in words.
    """

    motion: VehicleMotion
    beside: float
    is_over: bool = False
    failed: str | None = None
    news: tuple[str, ...] = ()


class Pilot(Protocol):
    """Leads a vehicle along a path; immutable."""

    @property
    def allowed_m(self) -> float:
        """How far off its path a vehicle may be: beyond it nothing is proven [m]."""
        ...

    @property
    def takeoff_m(self) -> float | None:
        """How high it takes off before that [m]; None if it doesn't."""
        ...

    @property
    def lands(self) -> bool:
        """Whether it lands at the end."""
        ...

    def too_far(self, state: VehicleState) -> str | None:
        """Why it can't set off from where the vehicle is, in words; None if it can."""
        ...

    def steered(self, state: VehicleState, time: float) -> tuple[Self, Steering]:
        """What to do now.

        Args:
            state: Where the vehicle is.
            time: Since it has set off, stops of the link not counted [s].
        """
        ...
