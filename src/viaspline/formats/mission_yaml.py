"""viaspline's own mission files: YAML, read with every fault in its place.

The document itself, with the place of everything in it, is in ``yaml_document``.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar, Final

from viaspline.formats.items import LatLon
from viaspline.formats.mission_format import MissionFormat, Whereabouts, Written
from viaspline.formats.named_files import route_data, world_data
from viaspline.formats.outermost_keys import PLAN_KEYS, outermost_keys
from viaspline.formats.said_origin import said_origin
from viaspline.formats.yaml_document import yaml_document
from viaspline.formats.yaml_lines import section
from viaspline.mission.model import Mission
from viaspline.mission.validation import Context

_LISTS: Final = frozenset({"known", "unseen", "fences", "speed_zones", "via"})


class MissionYaml(MissionFormat[Mission]):
    """viaspline's own format."""

    description: ClassVar[str] = "viaspline's YAML (.yaml, .yml, .json)"
    endings: ClassVar[tuple[str, ...]] = (".yaml", ".yml", ".json")
    saved_endings: ClassVar[tuple[str, ...]] = (".yaml", ".yml")

    def sniff(self, path: Path, text: str) -> bool:
        """Whether the file is called so: what is wrong with a text is told as a fault of YAML.

        JSON is YAML, too, but for what QGroundControl has written.
        """
        ending = path.suffix.lower()
        if ending == ".json":
            return not PLAN_KEYS.intersection(outermost_keys(text))
        return ending in self.endings

    def read(self, text: str, source: str) -> Mission:
        """The mission that a text describes; each of its faults has its line and column."""
        document = yaml_document(text, source)
        return Mission.model_validate(document.data, context=Context(document))

    def origin(self, text: str, source: str) -> LatLon | None:
        """Latitude and longitude of its 0, 0 [deg], if its world says them."""
        return said_origin(yaml_document(text, source).data)

    def write(self, mission: Mission, where: Whereabouts) -> Written:
        """All of a mission; what has its default value is left out."""
        return Written(yaml_text(mission, where.folder), ())


def yaml_text(mission: Mission, folder: str | Path = ".") -> str:
    """A mission as YAML; what has its default value is left out.

    Args:
        mission: The mission.
        folder: Where the text will stand: files of maps are named from there, unless the mission
            has them absolute.

    Raises:
        OutputError: The mission has a grid that was made in memory.

    >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [9.5, 0]}})
    >>> print(yaml_text(mission), end="")
    route:
      start: [0, 0]
      goal: [9.5, 0]
    """
    data = mission.model_dump(exclude_defaults=True, by_alias=True)
    data = {
        **data,
        "world": world_data(mission.world, data.get("world", {}), Path(folder)),
        "route": route_data(mission.route, data["route"], Path(folder)),
    }
    lines = (line for key, part in data.items() if part for line in section(key, part, _LISTS))
    return "\n".join(lines) + "\n"
