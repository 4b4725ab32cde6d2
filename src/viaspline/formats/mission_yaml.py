"""viaspline's own mission files: YAML, read with every fault in its place.

The document itself, with the place of everything in it, is in ``yaml_document``.
"""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar, Final

from viaspline.errors import OutputError
from viaspline.formats.mission_format import MissionFormat, Whereabouts, Written
from viaspline.formats.yaml_document import yaml_document
from viaspline.mission.map_edge import edge_of
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.validation import Context
from viaspline.mission.world_spec import WorldSpec

_WORD: Final = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_RESERVED: Final = frozenset({"true", "false", "null", "yes", "no", "on", "off", "y", "n"})
_ONE_PER_LINE: Final = frozenset({"known", "unseen", "fences", "speed_zones", "via"})


class MissionYaml(MissionFormat):
    """viaspline's own format."""

    description: ClassVar[str] = "viaspline's YAML (.yaml, .yml)"
    endings: ClassVar[tuple[str, ...]] = (".yaml", ".yml")
    saved_endings: ClassVar[tuple[str, ...]] = endings

    def sniff(self, path: Path, text: str) -> bool:
        """Whether the file is called so: what is wrong with a text is told as a fault of YAML."""
        return path.suffix.lower() in self.endings

    def read(self, text: str, source: str) -> Mission:
        """The mission that a text describes; each of its faults has its line and column."""
        document = yaml_document(text, source)
        return Mission.model_validate(document.data, context=Context(document))

    def origin(self, text: str, source: str) -> None:
        """Places are metres: where on earth they are isn't said."""

    def write(self, mission: Mission, where: Whereabouts) -> Written:
        """All of a mission; what has its default value is left out."""
        return Written(yaml_text(mission, where.folder), ())


def write_yaml(mission: Mission, path: str | Path) -> None:
    """Write a mission to a YAML file; reading it gives an equal mission.

    The file is there as a whole or not at all: it is written beside its place and then moved. Maps
    of squares are named, not written: they have to stay where they are.

    Args:
        mission: The mission.
        path: The file; an old one is replaced.

    Raises:
        OutputError: The file can't be written, or the mission has a grid that was made in memory.
    """
    target = Path(path)
    text = yaml_text(mission, target.parent)
    try:
        with _replacing(target) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise OutputError(path, (error.strerror or str(error)).lower()) from error


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
    data = {**data, "world": _world(mission.world, data.get("world", {}), Path(folder))}
    corridor = mission.route.corridor
    if corridor is not None and corridor.csv is not None:
        named = {"csv": _relative(Path(corridor.csv), Path(folder))}
        data["route"] = {**data["route"], "corridor": named}
    return (
        "\n".join(
            line for key, section in data.items() if section for line in _section(key, section)
        )
        + "\n"
    )


def _world(world: WorldSpec, data: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The world's data with maps named, without the bounds and the fence that they bring."""
    edge = edge_of([item.grid for item in world.known if item.grid is not None])
    written = dict(data)
    for key, items in (("known", world.known), ("unseen", world.unseen)):
        if items:
            pairs = zip(data[key], items, strict=True)
            written[key] = [_obstacle(plain, item, folder) for plain, item in pairs]
    if world.bounds is not None and world.bounds == edge.bounds:
        del written["bounds"]
    if world.bounds is None and edge.fence in world.fences:
        written["fences"] = [ring for ring in world.fences if ring != edge.fence]
    return {key: value for key, value in written.items() if value}


def _obstacle(plain: Mapping[str, Any], obstacle: Obstacle, folder: Path) -> Mapping[str, Any]:
    grid = obstacle.grid
    if grid is None:
        return plain
    if grid.reading is None or grid.source is None:
        name = f"obstacle '{obstacle.name}'" if obstacle.name else "an obstacle"
        problem = f"{name} is a grid made in memory, which can't be written; read it from a map"
        raise OutputError("<mission>", problem)
    reading = grid.reading
    asked = {
        "map": grid.source if Path(grid.source).is_absolute() else _relative(reading.path, folder),
        "unknown": "free" if reading.unknown == "free" else None,
        "resolution_m": reading.resolution,
        "name": obstacle.name,
    }
    return {key: value for key, value in asked.items() if value is not None}


def _relative(path: Path, folder: Path) -> str:
    return Path(os.path.relpath(path, folder)).as_posix()


def _section(name: str, section: Mapping[str, Any]) -> Iterator[str]:
    yield f"{name}:"
    for key, value in section.items():
        if key in _ONE_PER_LINE and value:
            yield f"  {key}:"
            yield from (f"    - {_flow(item)}" for item in value)
        else:
            yield f"  {key}: {_flow(value)}"


def _flow(value: Any) -> str:
    """A value on one line."""
    if isinstance(value, Mapping):
        if value.keys() == {"at"}:
            return _flow(value["at"])
        return "{" + ", ".join(f"{key}: {_flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_flow, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _number(value)
    return "null" if value is None else _text(str(value))


def _number(value: float) -> str:
    if value == int(value) and abs(value) < 1e15:
        return str(int(value))
    text = repr(value)
    # Readers of YAML 1.1 take an exponent without a point for a text.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _text(text: str) -> str:
    if _WORD.fullmatch(text) and text.lower() not in _RESERVED:
        return text
    return '"' + "".join(map(_escaped, text)) + '"'


def _escaped(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    return character if character.isprintable() else f"\\U{ord(character):08x}"


@contextlib.contextmanager
def _replacing(target: Path) -> Iterator[Path]:
    """A file beside the target that takes its place if all goes well, and goes away if not."""
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        # A temporary file is for its owner only; a mission is an ordinary file.
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(0o666 & ~mask)
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
