"""Between itineraries and items: what goes out is what comes back."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import LinkError
from viaspline.formats.items import FenceArea, Home, Item, Itinerary, Place
from viaspline.links.mavlink.item_differences import differences, same_until
from viaspline.links.mavlink.mav_words import FENCE, MISSION, RALLY
from viaspline.links.mavlink.mission_items import addressed, itinerary_on_board, lists_of
from viaspline.links.mavlink.vehicle import Vehicle

ARDUPILOT, PX4 = Vehicle(1, 1, 3, 10), Vehicle(1, 1, 12, 2)
HOME = Home(47.1, 8.2, 400.0, Place("home"))
DEGREES = st.tuples(st.floats(-80, 80), st.floats(-179, 179)).filter(lambda p: abs(p[0]) > 1e-3)


def way_point(number: int, place: tuple[float, float], height: float, dwell: float) -> Item:
    params = (dwell, 0.0, 0.0, math.nan)
    return Item(number, 16, 3, params, *place, height, Place(f"item {number}"))


@given(
    places=st.lists(
        st.tuples(DEGREES, st.floats(-50, 500), st.floats(0, 60)), min_size=1, max_size=6
    ),
    polygon=st.lists(DEGREES, min_size=3, max_size=6),
    circle=st.tuples(DEGREES, st.floats(0.1, 1e3)),
    vehicle=st.sampled_from([ARDUPILOT, PX4]),
)
def test_what_goes_out_is_what_comes_back(
    places: list[tuple[tuple[float, float], float, float]],
    polygon: list[tuple[float, float]],
    circle: tuple[tuple[float, float], float],
    vehicle: Vehicle,
) -> None:
    items = tuple(way_point(k, *place) for k, place in enumerate(places, start=1))
    fences = (
        FenceArea(True, tuple(polygon), None, 0.0, Place("p")),
        FenceArea(False, (), circle[0], circle[1], Place("c")),
        FenceArea(False, tuple(reversed(polygon)), None, 0.0, Place("q")),
    )
    sent = lists_of(Itinerary("x", items, HOME, fences, 2.5), [(47.0, 8.0, 3.0)])
    board = {kind: addressed(one, kind, vehicle, HOME) for kind, one in sent.items()}
    back = itinerary_on_board(board, vehicle, "board")
    assert back.speed == 2.5
    assert [item.command for item in back.items] == [178, *(16 for _ in items)]
    for one, other in zip(items, back.items[1:], strict=True):
        assert other.latitude == pytest.approx(one.latitude, abs=1e-7)
        assert other.longitude == pytest.approx(one.longitude, abs=1e-7)
        stays = one.params[0] if vehicle is PX4 else math.ceil(one.params[0])  # in whole seconds
        assert (other.altitude, other.params[0]) == (one.altitude, stays)
    assert [area.inclusion for area in back.fences] == [True, False, False]
    assert [len(area.corners) for area in back.fences] == [len(polygon), 0, len(polygon)]
    assert back.fences[1].radius == circle[1]
    assert (back.home is None) == (vehicle is PX4)
    assert len(board[RALLY]) == 1


def test_items_are_numbered_and_the_first_is_the_current_one() -> None:
    items = tuple(way_point(k, (47.0, 8.0 + k), 0.0, 0.0) for k in (1, 2))
    lists = lists_of(Itinerary("x", items))
    sent = addressed(lists[MISSION], MISSION, ARDUPILOT, None)
    assert [item.seq for item in sent] == [0, 1, 2]
    assert [item.current for item in sent] == [1, 0, 0]
    assert {item.target_system for item in sent} == {1}
    assert RALLY not in lists
    assert lists[FENCE] == ()


def test_more_items_than_can_be_numbered_are_refused() -> None:
    items = (way_point(1, (47.0, 8.0), 0.0, 0.0),) * 65535
    with pytest.raises(LinkError, match="65534 are the most"):
        lists_of(Itinerary("x", items))


def test_an_autopilot_may_round_but_not_change() -> None:
    items = tuple(way_point(k, (47.0, 8.0 + k), 5.0, 2.0) for k in range(8))
    sent = addressed(lists_of(Itinerary("x", items))[MISSION], MISSION, PX4, None)
    rounded = [type(one)(**{**vars(one), "x": one.x + 1, "z": 5.005, "frame": 6}) for one in sent]
    assert differences(sent, rounded, skip_first=False) == ()
    moved = [type(one)(**{**vars(one), "y": one.y + 2}) for one in sent]
    found = differences(sent, moved, skip_first=False)
    assert len(found) == 6
    assert found[0].startswith("item 0: its place became 47.0000000, 8.0000002")
    assert found[-1] == "and 3 more"
    waits = [type(one)(**{**vars(one), "param1": 2.4}) for one in sent]
    assert differences(sent, waits, skip_first=True)[0].startswith("item 1: its first parameter 2 ")
    assert same_until(sent, [*sent[:3], *moved[3:]], skip_first=False) == 3
    assert differences(sent, sent[:-1], skip_first=False) == ("8 items were sent, 7 are on board",)
