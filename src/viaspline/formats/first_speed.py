"""The speed that a file sets before its vehicle sets off, and no other after it.

Tested through ``formats/test_qgc_wpl``.
"""

from __future__ import annotations

from viaspline.formats.commands import CHANGE_SPEED, PLACES
from viaspline.formats.items import Item, Itinerary

_OVER_GROUND_OR_AIR = (0.0, 1.0)  # what else changes are speeds of climbs and descents
_SLOWEST_MPS, _FASTEST_MPS = 1e-3, 1e4


def first_speed(itinerary: Itinerary) -> Item | None:
    """The one change of speed of a file that holds for the whole way.

    Args:
        itinerary: The whole file.

    Returns:
        The item; None if there is none, if there are several, or if the vehicle is under way by
        then.
    """
    changes = [item for item in itinerary.items if item.command == CHANGE_SPEED]
    if len(changes) != 1 or changes[0].params[0] not in _OVER_GROUND_OR_AIR:
        return None
    change = changes[0]
    if not _SLOWEST_MPS <= change.params[1] <= _FASTEST_MPS:
        return None
    before = itinerary.items[: itinerary.items.index(change)]
    places = {(i.latitude, i.longitude) for i in before if i.command in PLACES and i.has_position}
    home = itinerary.home
    if home is not None and home.is_plausible:
        places.add((home.latitude, home.longitude))
    return change if len(places) <= 1 else None


def speed_of(itinerary: Itinerary) -> float | None:
    """How fast the vehicle is meant to go [m/s]; None if the file doesn't say."""
    change = first_speed(itinerary)
    return itinerary.speed if change is None else change.params[1]
