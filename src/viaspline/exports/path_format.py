"""What a format of paths is: an ending, what it carries, and a writer.

Tested through ``exports/test_export_path``.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import ClassVar, Final, Literal, Protocol, TypeAlias, cast

from viaspline.errors import OutputError
from viaspline.exports.path_table import PathTable

Carried: TypeAlias = Literal["speeds", "times", "dwells", "headings", "names", "curve", "fences"]
"""What of a plan a format may have a place for, beside the points."""


class PathFormat(Protocol):
    """A format: one file here, one line in ``PATH_FORMATS``.

    Attributes:
        description: What it is.
        endings: How its files end, in small letters.
        carries: What goes along with the points.
        is_geographic: Whether its places are latitudes and longitudes.
        is_cut_at_180: Whether its lines end at the meridian of 180°, and others go on from there.
        is_driven: Whether its readers drive from point to point, at a speed that is set and turning
            within an acceptance radius.
        spacing: The longest line, if nobody asks for another one [m]; None: as long as may be.
    """

    description: ClassVar[str]
    endings: ClassVar[tuple[str, ...]]
    carries: ClassVar[frozenset[Carried]]
    is_geographic: ClassVar[bool]
    is_cut_at_180: ClassVar[bool]
    is_driven: ClassVar[bool]
    spacing: ClassVar[float | None]

    @abstractmethod
    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        ...


PATH_FORMATS: Final = (
    "plan_of_path:PlanOfPath",
    "waypoints_of_path:WaypointsOfPath",
    "nav_path_yaml:NavPathYaml",
    "nav_path_mcap:NavPathMcap",
    "geojson_path:GeoJsonPath",
    "kml_path:KmlPath",
    "gpx_path:GpxPath",
    "csv_path:CsvPath",
    "json_path:JsonPath",
)
"""The file of each here, and its class."""


def path_formats() -> Iterator[PathFormat]:
    """All formats.

    >>> [each.endings[0] for each in path_formats()]
    ['.plan', '.waypoints', '.path.yaml', '.mcap', '.geojson', '.kml', '.gpx', '.csv', '.json']
    """
    for entry in PATH_FORMATS:
        module, _, name = entry.partition(":")
        yield cast("PathFormat", getattr(import_module(f"viaspline.exports.{module}"), name)())


def path_format_of(file: str | Path) -> PathFormat:
    """The format of a file that is to be written, by its ending.

    Raises:
        OutputError: There is none of such an ending.

    >>> path_format_of("round.path.yaml").is_geographic
    False
    >>> path_format_of("round.dxf")
    Traceback (most recent call last):
    ...
    viaspline.errors.OutputError: round.dxf: paths aren't exported to such a file; the endings ...
    """
    name = Path(file).name.lower()
    for each in path_formats():
        if name.endswith(each.endings):
            return each
    endings = ", ".join(ending for each in path_formats() for ending in each.endings)
    raise OutputError(file, f"paths aren't exported to such a file; the endings are {endings}")
