"""What is asked for when a vehicle is driven, and how that has ended.

Tested through ``links/mavlink/test_vehicle_drive``.
"""

from __future__ import annotations

from typing import NamedTuple


class DriveOrders(NamedTuple):
    """What is asked for.

    Attributes:
        arms: Whether the vehicle is to be armed.
        patience: How long it may take to be taken over and armed [s].
    """

    arms: bool
    patience: float


class Ended(NamedTuple):
    """How a drive has ended.

    Attributes:
        reached: Whether at its goal.
        words: How, in words.
    """

    reached: bool
    words: str
