"""Obstacles that move as somebody recorded it: a file of places, one moving disc for each id.

Tested through ``mission/test_tracks``.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator

from viaspline.mission.annotations import Expects
from viaspline.mission.fields import Length, Name, as_text
from viaspline.mission.motion_spec import After, MotionError
from viaspline.mission.value import Value


class TracksSpec(
    Value,
    examples=(
        {
            "tracks": "tracks/dynabarn_44.csv",
            "radius_m": 0.3,
            "name": "person",
            "after": "vanish",
            "error": {"position_m": 0.1},
        },
    ),
):
    """Moving discs that have a file of their own, as a mission asks for them.

    Attributes:
        tracks: The file, relative to the mission's: rows id, t, x, y in seconds and metres, by
            the mission's clock. Each id becomes one disc.
        radius_m: The radius of the discs [m].
        name: What they are called in reports and errors, with their ids. None: by their ids.
        after: What a disc does where its rows are over; before the first one it isn't there.
            None: ``stay``, as where somebody was last isn't known to be free.
        error: How far from there a disc may be.
    """

    tracks: Annotated[
        Name, BeforeValidator(as_text), Expects("the path of a file such as people.csv")
    ]
    radius_m: Length
    name: Name | None = None
    after: After | None = None
    error: MotionError = MotionError()
