from collections.abc import Mapping
from typing import Annotated

import pytest
from pydantic import Field

from viaspline.mission import others_words
from viaspline.mission.fields import DEGREES, Length, Number
from viaspline.mission.key_words import expectation, keys_at, suggestion
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.unplaced_faults import Path
from viaspline.mission.value import Value

RING = "at least three points [[x, y], [x, y], [x, y]] in metres"


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ((), "a mapping with the keys world, robot, route, spline and ros"),
        (
            ("world",),
            "a mapping with the keys bounds, fences, known, unseen, speed_zones, altitude, "
            "ground and origin_deg",
        ),
        (("world", "bounds", 2), "a number of metres"),
        (("world", "fences"), "a list of polygons, each " + RING),
        (("world", "fences", 0), RING),
        (("world", "fences", 0, 1), "[x, y] in metres"),
        (("world", "known", 4), "an obstacle such as {circle: {center: [x, y], radius: 5}}"),
        (("world", "known", 4, "map"), "the path of a map such as depot.yaml"),
        (("world", "known", 4, "unknown"), "blocked or free"),
        (("world", "known", 4, "polygon"), RING),
        (("world", "unseen", 4, "holes", 0, 1), "[x, y] in metres"),
        (("robot", "radius_m"), "a number of metres, 0 or more"),
        (("robot", "footprint", 0), "[x, y] in metres"),
        (("robot", "max_accel_mps2"), "a number of m/s², 0.0001 to 1000000"),
        (("robot", "drive", "delay_s"), "a number of seconds, 0 to 60"),
        (("robot", "sensor"), "{range_m: 40} or {lidar: {range_m: 5}}"),
        (("robot", "sensor", "lidar", "fov_deg"), "a number of degrees, 0.01 to 360"),
        (("robot", "sensor", "lidar", "beams"), "a whole number, 1 to 100000"),
        (("robot", "localization", "heading_noise_deg"), "a number of degrees, 0 to 180"),
        (("route", "via", 0), "[x, y] or {at: [x, y], name: ..., dwell_s: ...}"),
        (("route", "via", 0, "at"), "[x, y] or [x, y, z] in metres"),
        (
            ("route", "start", "heading_deg"),
            "a number of degrees, anticlockwise from x, -36000 to 36000",
        ),
        (("route", "closed"), "true or false"),
        (("route", "order"), "given or shortest"),
        (("route", "corridor", "line", 3), "a row [x, y, right, left] in metres"),
        (
            ("spline", "tension"),
            "one number from -199 to 1, a list with one for each span, or auto",
        ),
        (("spline", "tension", 0), "a number, -199 to 1"),
        (("spline", "slack", 0), "a number, 0 to 100"),
        (("nowhere",), "something else"),
    ],
)
def test_a_place_says_what_would_be_right_there(path: Path, words: str) -> None:
    assert expectation(path) == words


@pytest.mark.parametrize(
    ("path", "some"),
    [
        (("world", "known", 0), {"circle", "polygon", "map", "unknown", "pass_on"}),
        (("route", "goal"), {"at", "name", "dwell_s", "heading_deg"}),
        (("route", "via", 0), {"at", "name", "dwell_s"}),
        (("route", "closed"), set()),
    ],
)
def test_a_mapping_has_the_keys_of_its_models(path: Path, some: set[str]) -> None:
    keys = set(keys_at(path))
    assert some <= keys
    assert "grid" not in keys
    assert bool(some) == bool(keys)
    assert ("heading_deg" in keys) == ("heading_deg" in some)


@pytest.mark.parametrize(
    ("key", "path", "remedy"),
    [
        ("max_speed_mps", ("route",), "'max_speed_mps' belongs under robot"),
        ("Fov-Deg", ("robot",), "'fov_deg' belongs under lidar"),
        ("map", ("world",), "'map' belongs under known"),
        ("clear", ("robot",), "did you mean 'clearance_m'?"),
        ("radius", ("robot",), "did you mean 'radius_m'?"),  # it was sent to a circle
        ("radius_m", ("world", "known", 0, "circle"), "did you mean 'radius'?"),
        ("Height", ("world", "known", 0), "did you mean 'height_m'?"),
        ("waypoints", (), "did you mean 'route'?"),
        ("Via-Points", ("route",), "did you mean 'via'?"),
        (
            "lat",
            ("route", "start"),
            "write at: [x, y], in metres east and north of origin_deg; "
            ".plan and .waypoints files have latitudes",
        ),
        ("inflation_radius", ("robot",), "did you mean 'clearance_m'?"),  # it was a turning circle
        ("max_vel_x", ("robot",), "did you mean 'max_speed_mps'?"),  # it was max_replan_s
        ("zzz", ("robot", "sensor"), "the keys here are range_m, lidar, velocity_noise_mps"),
    ],
)
def test_a_key_in_the_wrong_place_is_sent_to_where_it_belongs(
    key: str, path: Path, remedy: str
) -> None:
    assert suggestion(key, path)[0] == remedy


@pytest.mark.parametrize(
    ("words", "path"),
    [
        (others_words.MISSION, ()),
        (others_words.ROUTE, ("route",)),
        (others_words.POINT, ("route", "goal")),
        (others_words.ROBOT, ("robot",)),
        (others_words.WORLD, ("world",)),
        (others_words.OBSTACLE, ("world", "known", 0)),
        (others_words.CIRCLE, ("world", "known", 0, "circle")),
    ],
)
def test_others_words_lead_to_keys_that_are_there_and_are_none_themselves(
    words: Mapping[str, str], path: Path
) -> None:
    known = set(keys_at(path))
    assert {ours.partition(":")[0] for ours in words.values()} <= known
    assert not set(words) & known
    assert all(suggestion(theirs, path)[1] in known for theirs in words)


class Beacon(
    Value,
    expected="a beacon",
):
    """A light.

    Attributes:
        height_m: Over the ground [m].
        turn_deg: How far it is turned [deg].
    """

    height_m: Length
    turn_deg: Annotated[Number, DEGREES, Field(gt=-90, lt=90)] = 0.0


class Harbour(MissionParts):
    """A mission with a key of its own.

    Attributes:
        beacons: Lights.
    """

    beacons: tuple[Beacon, ...] = ()


def test_a_new_model_needs_no_table_to_be_known_by_words_keys_and_schema() -> None:
    assert expectation(("beacons", 0), Harbour) == "a beacon"
    words = "a number of degrees greater than -90, less than 90"
    assert expectation(("beacons", 0, "turn_deg"), Harbour) == words
    home = "'height_m' belongs under beacons"
    assert suggestion("height_m", ("robot",), Harbour) == (home, None)
    schema = Harbour.model_json_schema()["$defs"]["Beacon"]
    assert schema["properties"]["height_m"]["description"] == "Over the ground [m]."
