"""What is kept of a fleet's plan beside its robots' plans: courses and laws at nodes, exactly.

It is one file of numpy's own, ``courses.npz``, an array for each column. What follows from these,
who comes near whom and who passes first, is found again.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides

NamedArrays: TypeAlias = Mapping[str, np.ndarray[Any, Any]]
"""Arrays by name."""

MOST_BYTES: Final = 4_000_000_000
"""Of the arrays of one file."""
BY_ROBOT: Final = frozenset(
    {
        "courses.reach", "laws.is_timed", "rides.accel", "rides.brake", "rides.depart",
        "rides.keeps_pace", "rides.vanishes", "alone.is_timed",
    }
)  # fmt: skip
"""NamedArrays with a row for each robot; the others have one for each node."""
FLAGS: Final = frozenset({"is_timed", "keeps_pace", "vanishes"})
PACKED: Final[Mapping[str, Any]] = {
    "courses": PackedCourses, "laws": PackedLaws, "rides": PackedRides, "alone": PackedLaws
}  # fmt: skip
"""What is kept, column by column."""


@dataclass(frozen=True, eq=False)
class CourseRecord:
    """The parts of a fleet's plan that its robots' plans don't tell exactly.

    Attributes:
        courses: As in `FleetPlan`.
        laws: As in `FleetPlan`.
        rides: As in `FleetPlan`.
    """

    courses: FleetCourses
    laws: FleetLaws
    rides: FleetRides

    @classmethod
    def of(cls, plan: FleetPlan) -> CourseRecord:
        """That of a plan."""
        return cls(plan.courses, plan.laws, plan.rides)

    def to_bytes(self) -> bytes:
        """The file: the same bytes every time."""
        columns: dict[str, Any] = {
            "names": np.array(self.courses.names, np.str_),
            "durations": self.rides.alone,
        }
        if self.courses.bodies is not None:
            columns["bodies"] = self.courses.bodies
        parts: tuple[Any, ...] = (
            self.courses.packed,
            self.laws.packed,
            self.rides.packed,
            self.rides.laws.packed,
        )
        for part, packed in zip(PACKED, parts, strict=True):
            columns |= {f"{part}.{name}": getattr(packed, name) for name in packed._fields}
        file = io.BytesIO()
        np.savez_compressed(file, **columns)
        return file.getvalue()

    @classmethod
    def from_bytes(cls, content: bytes) -> CourseRecord:
        """What a file holds.

        Raises:
            ValueError: It isn't one: says what is wrong with it.
        """
        columns = _columns_of(content)
        names = columns.get("names", np.empty(0))
        if names.ndim != 1 or (names.size and names.dtype.kind != "U"):
            raise ValueError("names no robots")
        robots, nodes = len(names), _checked_nodes(columns, len(names))
        packed: dict[str, Any] = {}
        for part, kind in PACKED.items():
            found = {}
            for name in kind._fields:
                rows = robots if f"{part}.{name}" in BY_ROBOT else nodes
                found[name] = _column(columns, f"{part}.{name}", rows)
            packed[part] = kind(**found)
        bodies = _column(columns, "bodies", robots) if "bodies" in columns else None
        if packed["courses"].place.shape != (nodes, 2 if bodies is None else 3):
            raise ValueError("courses.place has another shape than its robots")
        courses = FleetCourses(tuple(names.tolist()), packed["courses"], bodies)
        durations = _column(columns, "durations", robots)
        rides = FleetRides(packed["rides"], durations, FleetLaws(packed["alone"]))
        return cls(courses, FleetLaws(packed["laws"]), rides)


def _columns_of(content: bytes) -> NamedArrays:
    """All arrays of a file, if there is room for them.

    Raises:
        ValueError: It is no such file.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if sum(one.file_size for one in archive.infolist()) > MOST_BYTES:
                raise ValueError(f"holds more than {MOST_BYTES // 10**9} GB")
        with np.load(io.BytesIO(content), allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except (zipfile.BadZipFile, EOFError, KeyError, OSError, NotImplementedError) as error:
        raise ValueError(f"can't be read ({error})") from None


def _checked_nodes(columns: NamedArrays, robots: int) -> int:
    """How many nodes the courses have in all.

    Raises:
        ValueError: Some robot has none, or they aren't counted through.
    """
    first = columns.get("courses.first", np.empty(0))
    if first.shape != (robots + 1,) or first.dtype != np.int64:
        raise ValueError("courses.first isn't as long as it has to be")
    if first[0] != 0 or (np.diff(first) < 2).any():
        raise ValueError("some robot's course has no two nodes")
    return int(first[-1])


def _column(columns: NamedArrays, name: str, rows: int) -> np.ndarray[Any, Any]:
    """A column with so many rows.

    Raises:
        ValueError: There is none.
    """
    if name == "courses.first":
        return columns[name]
    found = columns.get(name)
    kind = np.bool_ if name.partition(".")[2] in FLAGS else np.float64
    if found is None or found.dtype != kind or found.shape[:1] != (rows,):
        raise ValueError(f"has no {name} of {rows} rows")
    wide = {"courses.place": 2, "bodies": 2}
    if found.ndim != wide.get(name, 1) or (found.dtype == np.float64 and np.isnan(found).any()):
        raise ValueError(f"{name} holds something else than numbers")
    return found
