"""Fleet files: YAML with the world, the kinds of robots, and the robots with their routes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

from viaspline.errors import OutputError
from viaspline.formats.mission_format import MissionFormat, Whereabouts, Written
from viaspline.formats.named_files import relative, route_data, world_data
from viaspline.formats.outermost_keys import outermost_keys
from viaspline.formats.said_origin import said_origin
from viaspline.formats.yaml_document import yaml_document
from viaspline.formats.yaml_lines import flow, section
from viaspline.mission.validation import Context

if TYPE_CHECKING:
    from viaspline.formats.items import LatLon
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.fleet.member_spec import MemberSpec

_OWN_KEYS: Final = frozenset({"fleet", "robots", "separation_m"})
"""Those that a fleet has and a mission hasn't."""
_OWN_KEY: Final = re.compile(rf"""["']?(?:{"|".join(sorted(_OWN_KEYS))})["']?\s*:""")
"""What may be one of them, wherever it stands."""
_OWN_LINE: Final = re.compile(rf"^{_OWN_KEY.pattern}", re.MULTILINE)
"""At the beginning of a line: one of them for sure, in a text that isn't in braces."""
_LISTS: Final = frozenset({"known", "fences", "speed_zones"})


class FleetYaml(MissionFormat["Fleet"]):
    """Many robots in one world."""

    description: ClassVar[str] = "viaspline's YAML of a fleet (.yaml, .yml, .json)"
    endings: ClassVar[tuple[str, ...]] = (".yaml", ".yml", ".json")
    saved_endings: ClassVar[tuple[str, ...]] = ()

    def sniff(self, path: Path, text: str) -> bool:
        r"""Whether the file is called so, and has a key that only fleets have.

        >>> FleetYaml().sniff(Path("a.yaml"), "world: {}\nfleet:\n  - {name: r1}\n")
        True
        >>> FleetYaml().sniff(Path("a.yaml"), "route: {start: [0, 0]}  # no fleet: one robot")
        False
        >>> FleetYaml().sniff(Path("a.yaml"), '{"world": {"known": []}, "fleet": []}')
        True
        """
        if path.suffix.lower() not in self.endings or _OWN_KEY.search(text) is None:
            return False
        if _OWN_LINE.search(text) is not None:
            return True
        return any(key in _OWN_KEYS for key in outermost_keys(text))

    def read(self, text: str, source: str) -> Fleet:
        """The fleet that a text describes; each of its faults has its line and column."""
        from viaspline.mission.fleet.fleet import Fleet  # missions are read without it

        document = yaml_document(text, source)
        return Fleet.model_validate(document.data, context=Context(document))

    def origin(self, text: str, source: str) -> LatLon | None:
        """Latitude and longitude of its 0, 0 [deg], if its world says them."""
        return said_origin(yaml_document(text, source).data)

    def write(self, fleet: Fleet, where: Whereabouts) -> Written:
        """All of a fleet; what has its default value is left out."""
        return Written(fleet_text(fleet, where.folder), ())


def fleet_text(fleet: Fleet, folder: str | Path = ".") -> str:
    """A fleet as YAML, a line for each robot; what has its default value is left out.

    Args:
        fleet: The fleet.
        folder: Where the text will stand: other files are named from there.

    Raises:
        OutputError: The fleet has a grid or a robot's mission that was made in memory.

    >>> from viaspline.mission.fleet.fleet import Fleet
    >>> print(fleet_text(Fleet.model_validate({
    ...     "separation_m": 1, "robots": {"cart": {"radius_m": 0.4}},
    ...     "fleet": [{"name": "r1", "robot": "cart", "route": {"start": [0, 0], "goal": [9, 0]}}],
    ... })), end="")
    separation_m: 1
    robots:
      cart: {radius_m: 0.4}
    fleet:
      - {name: r1, robot: cart, route: {start: [0, 0], goal: [9, 0]}}
    """
    data = fleet.model_dump(exclude_defaults=True, by_alias=True)
    world = world_data(fleet.world, data.get("world", {}), Path(folder))
    lines = list(section("world", world, _LISTS)) if world else []
    if "separation_m" in data:
        lines.append(f"separation_m: {flow(data['separation_m'])}")
    for key in ("robots", "spline"):
        if key in data:
            lines += section(key, data[key], frozenset())
    lines.append("fleet:")
    for member, given in zip(fleet.fleet, data["fleet"], strict=True):
        lines.append(f"  - {flow(_member(member, given, Path(folder)))}")
    return "\n".join(lines) + "\n"


def _member(member: MemberSpec, data: dict[str, Any], folder: Path) -> dict[str, Any]:
    """A robot's data with its files named."""
    if member.mission is not None:
        return {**data, "mission": relative(Path(member.mission), folder)}
    if member.route is None:
        problem = f"the mission of robot '{member.name}' was made in memory"
        raise OutputError("<fleet>", f"{problem}; write it to a file and name that")
    route = route_data(member.route, data["route"], folder)
    if member.route.closed and not member.route.is_patrol:
        route = {**route, "laps": member.route.laps}  # of one lap as well: without it never ends
    return {**data, "route": route}
