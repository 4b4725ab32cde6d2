"""QGroundControl's ``.plan`` files, version 1, and the ``.mission`` files that came before.

Format: https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar, Final

from viaspline.errors import MissionError
from viaspline.formats.items import (
    FenceArea,
    Home,
    Itinerary,
    LatLon,
    Place,
)
from viaspline.formats.json_tree import Tree, json_tree
from viaspline.formats.mission_format import Whereabouts, Written
from viaspline.formats.named_files import world_data
from viaspline.formats.outgoing import itinerary_of, lost_of
from viaspline.formats.plan_items import plan_items
from viaspline.formats.plan_parts import plan_document
from viaspline.formats.waypoint_format import WaypointFormat
from viaspline.mission.model import Mission
from viaspline.mission.unplaced_faults import describe

_ROTORCRAFT: Final = frozenset({2, 3, 4, 13, 14, 15, 29, 35})
"""MAV_TYPEs that fly at hoverSpeed; all others go at cruiseSpeed."""

ARDUPILOT: Final = 3
GROUND_ROVER: Final = 10
QUADROTOR: Final = 2


class QgcPlan(WaypointFormat):
    """QGroundControl's plans.

    The robot's greatest speed is ``hoverSpeed`` for rotorcraft and ``cruiseSpeed`` for all other
    vehicles. Surveys and corridor scans are the way points that they were resolved to.
    """

    description: ClassVar[str] = "QGroundControl's plans (.plan, and .mission in JSON)"
    endings: ClassVar[tuple[str, ...]] = (".plan", ".mission")
    saved_endings: ClassVar[tuple[str, ...]] = (".plan",)

    def sniff(self, path: Path, text: str) -> bool:
        """Whether it is JSON, or called a plan and no table of QGroundControl's."""
        start = text.lstrip()[:7]
        is_called_so = path.suffix.lower() == ".plan" and start != "QGC WPL"
        return start.startswith("{") or is_called_so

    def parse(self, text: str, source: str) -> Itinerary:
        """The items, home and fences of a plan.

        Raises:
            MissionError: It isn't JSON, no plan, or a plan with faults: all of them.
        """
        root = json_tree(text, source)
        # Before there were plans, the file was what is now its mission.
        is_plan = "fileType" in root or "mission" in root
        mission = root["mission"] if is_plan else root
        if is_plan:
            _check_versions(root, mission)
        elif "items" not in root:
            root.fault(
                "isn't a plan of QGroundControl: it has neither mission nor items",
                'it should have "fileType": "Plan" and a mission',
            )
        notes: dict[str, list[str]] = {}
        items = tuple(plan_items(mission["items"], notes))
        fences = tuple(_fences(root["geoFence"], notes))
        for point in root["rallyPoints"]["points"].items():
            notes.setdefault("rally point", []).append(point.key)
        itinerary = Itinerary(
            source=source,
            items=items,
            home=_home(mission["plannedHomePosition"]),
            fences=fences,
            speed=_speed(mission),
            notes=tuple((kind, ", ".join(where)) for kind, where in notes.items()),
            origin=_origin(root["viaspline"]["origin"]),
            is_flat=root["viaspline"]["heights"].value is False,
            ground=_ground(root["viaspline"]["ground"], source),
        )
        if root.faults.found:
            raise MissionError(root.faults.found)
        return itinerary

    def write(self, mission: Mission, where: Whereabouts) -> Written:
        """A mission as a plan: for a rover, and for a multirotor if it is one in space.

        Start, via points and goal are way points with their dwells as hold times; obstacles are
        exclusion fences, fences and bounds inclusion fences; the greatest speed is both of the
        plan's speeds. In space, heights above ground are altitudes above terrain, others are above
        home; take-off, landing and what is looked at are items. The origin, the ground, and whether
        heights are meant, stand under a key of viaspline's own, which others pass over, so that
        reading the plan gives the same metres.

        Args:
            mission: The mission.
            where: With the latitude and longitude of its 0, 0, where they aren't those that the
                mission says.

        Raises:
            OutputError: There is no origin, or the mission reaches too far from it.

        >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [90, 0]}})
        >>> text, lost = QgcPlan().write(mission, Whereabouts(origin=(47.0, 8.0)))
        >>> QgcPlan().origin(text, "x.plan"), lost
        ((47.0, 8.0), ())
        """
        itinerary = itinerary_of(mission, where.origin or mission.world.origin_deg)
        own: dict[str, Any] = {"origin": itinerary.origin, "heights": not itinerary.is_flat}
        if itinerary.ground is not None:
            data = {"ground": itinerary.ground}
            own |= {"ground": world_data(mission.world, data, where.folder)["ground"]}
        return Written(plan_text(itinerary, own, rotors=mission.is_spatial), lost_of(itinerary))


def plan_text(itinerary: Itinerary, own: Mapping[str, Any], *, rotors: bool) -> str:
    """The text of a plan.

    Args:
        itinerary: Home, items and fences.
        own: What stands under viaspline's own key.
        rotors: Whether it is for a multirotor; else for a rover.
    """
    home = itinerary.home
    assert home is not None
    vehicle = {
        "firmwareType": ARDUPILOT,
        "vehicleType": QUADROTOR if rotors else GROUND_ROVER,
        "cruiseSpeed": itinerary.speed,
        "hoverSpeed": itinerary.speed,
        "plannedHomePosition": [home.latitude, home.longitude, home.altitude],
    }
    return plan_document(itinerary, vehicle, (), {"viaspline": own})


def _check_versions(root: Tree, mission: Tree) -> None:
    if "fileType" in root and root["fileType"].value != "Plan":
        root["fileType"].fault(f"found {describe(root['fileType'].value)}", 'it should be "Plan"')
    _check_version(root["version"], (1,))
    if not isinstance(mission.value, dict):
        mission.fault(
            "is missing" if mission.value is None else f"found {describe(mission.value)}",
            "a plan needs a mission with items",
        )
    else:
        _check_version(mission["version"], (2, 1))


def _check_version(version: Tree, known: tuple[int, ...]) -> None:
    """Refuse versions of the format that aren't known, the first of which is the newest."""
    remedy = f"it should be {known[0]}"
    if version.value is None:
        version.fault("is missing", remedy)
    elif version.value not in known:
        version.fault(f"version {describe(version.value)} of the format isn't known", remedy)


def _home(tree: Tree) -> Home | None:
    if tree.value is None:
        return None
    position = tree["coordinate"] if isinstance(tree.value, dict) else tree
    numbers = position.numbers(2, "[latitude, longitude, altitude]")
    if not numbers:
        return None
    altitude = numbers[2] if len(numbers) > 2 else math.nan
    return Home(numbers[0], numbers[1], altitude, Place(tree.key))


def _origin(tree: Tree) -> LatLon | None:
    """The origin that viaspline has written beside the plan."""
    numbers = tree.numbers(2, "[latitude, longitude]") if tree.value is not None else ()
    if not numbers:
        return None
    if not (abs(numbers[0]) <= 90 and abs(numbers[1]) <= 180):
        tree.fault("isn't a latitude and a longitude", "correct it, or leave it out")
    return numbers[0], numbers[1]


def _ground(tree: Tree, source: str) -> dict[str, Any] | None:
    """The ground that viaspline has written beside the plan; its file is beside it as well."""
    if tree.value is None:
        return None
    if not isinstance(tree.value, dict):
        tree.fault(f"found {describe(tree.value)}", "give {flat_m: 0} or {terrain: dem.tif}")
        return None
    terrain = tree.value.get("terrain")
    if not isinstance(terrain, str):
        return dict(tree.value)
    return {**tree.value, "terrain": (Path(source).parent / terrain).as_posix()}


def _speed(mission: Tree) -> float | None:
    """The speed that goes with the vehicle [m/s]; None if none is given that can be meant."""
    hover, cruise = mission["hoverSpeed"].number(), mission["cruiseSpeed"].number()
    # Plans without a vehicle are for QGroundControl's default, a multirotor.
    vehicle = mission["vehicleType"].value
    is_rotorcraft = vehicle is None or (isinstance(vehicle, int) and vehicle in _ROTORCRAFT)
    speed = hover if is_rotorcraft else cruise
    return speed if math.isfinite(speed) and speed > 0 else None


def _fences(tree: Tree, notes: dict[str, list[str]]) -> Iterator[FenceArea]:
    if isinstance(tree["polygon"].value, list) and tree["polygon"].value:
        yield FenceArea(True, _corners(tree["polygon"]), None, 0.0, Place(tree["polygon"].key))
    for area in tree["polygons"].items():
        corners = _corners(area["polygon"])
        yield FenceArea(_is_inclusion(area), corners, None, 0.0, Place(area.key))
    for area in tree["circles"].items():
        center = area["circle"]["center"].numbers(2, "[latitude, longitude]")
        radius = area["circle"]["radius"].number()
        if center:
            middle = (center[0], center[1])
            yield FenceArea(_is_inclusion(area), (), middle, radius, Place(area.key))
    if "breachReturn" in tree:
        notes.setdefault("breach return point", []).append(tree["breachReturn"].key)


def _is_inclusion(area: Tree) -> bool:
    inclusion = area["inclusion"]
    if inclusion.value is not None and not isinstance(inclusion.value, bool):
        inclusion.fault(f"found {describe(inclusion.value)}", "it should be true or false")
    return inclusion.value is not False


def _corners(tree: Tree) -> tuple[tuple[float, float], ...]:
    pairs = [corner.numbers(2, "[latitude, longitude]") for corner in tree.items()]
    return tuple((pair[0], pair[1]) for pair in pairs if pair)
