"""What every exchange with a vehicle says, how long it waits for answers, and why it fails.

Tested through ``links/mavlink/test_mission_upload`` and ``links/mavlink/test_mission_download``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from viaspline.links.mavlink.mav_words import mission_result
from viaspline.links.mavlink.message import MavlinkMessage

TIMEOUT_S: Final = 1.5
"""After so long without an answer something is said again."""

RETRIES: Final = 5
"""So often."""

Said = tuple[MavlinkMessage, ...]


class Failure(NamedTuple):
    """Why an exchange has failed.

    Attributes:
        item: The item that it was about; None: the whole list.
        result: The MAV_MISSION_RESULT that the vehicle gave; None: it said nothing any more.
    """

    item: int | None
    result: int | None

    def words(self, count: int, name: str) -> str:
        """What has happened, in words.

        Args:
            count: How many items there are.
            name: What the list is called.

        >>> Failure(37, 10).words(51, "mission")
        'it refused item 37 (of 0 to 50) of the mission: x is invalid'
        >>> Failure(None, None).words(51, "fence")
        'it gave no answer about the fence, asked 6 times in 9 s'
        """
        what = f"the {name}" if self.item is None else f"item {self.item} (of 0 to {count - 1})"
        if self.result is None:
            asked = f"asked {RETRIES + 1} times in {TIMEOUT_S * (RETRIES + 1):g} s"
            return f"it gave no answer about {what}, {asked}"
        of = "" if self.item is None else f" of the {name}"
        return f"it refused {what}{of}: {mission_result(self.result)}"
