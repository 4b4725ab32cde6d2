"""Heights that count from a ground which nobody knows, out of a mission and into one."""

import json
import math
import warnings
from pathlib import Path
from typing import Any

import pytest

import viaspline as vs
from viaspline.errors import MissionError, OutputError
from viaspline.formats.known_heights import check_known_home
from viaspline.formats.mission_format import MissionFormat, Whereabouts
from viaspline.formats.qgc_plan import QgcPlan
from viaspline.formats.qgc_wpl import QgcWpl

HOME = [47.0, 8.0, 400.0]
FAR = [47.01, 8.0, 400.0]
"""More than a kilometre north: beyond the terrain."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    header = "ncols 21\nnrows 21\nxllcenter -100\nyllcenter -100\ncellsize 10\n"
    (tmp_path / "dem.asc").write_text(header + "\n".join(["400 " * 21] * 21))
    return tmp_path


def item(command: int, frame: int, north: float, altitude: float | None, **more: Any) -> Any:
    params = [0, 0, 0, None, 47.0 + north, 8.0, altitude]
    return {"type": "SimpleItem", "command": command, "frame": frame, "params": params} | more


def read(folder: Path, home: list[float] | None, *items: Any) -> vs.Mission:
    flown = {"version": 2, "plannedHomePosition": home, "items": items}
    own = {"origin": HOME[:2], "ground": {"terrain": "dem.asc"}}
    plan = {"fileType": "Plan", "version": 1, "mission": flown, "viaspline": own}
    file = folder / "x.plan"
    file.write_text(json.dumps(plan))
    mission = vs.load(file)
    assert isinstance(mission, vs.Mission)
    return mission


LOW, HIGH = item(16, 3, 0.0002, 20), item(16, 3, 0.0006, 30)
LOW_SEA, HIGH_SEA = item(16, 0, 0.0002, 420), item(16, 0, 0.0006, 430)
NO_HOME = r"^\S+x.plan: mission.plannedHomePosition: heights count from here, but nobody knows"
NO_ALTITUDE = r"^\S+x.plan: mission.items\[0\]: has no altitude, or none that is a number; give"


@pytest.mark.parametrize(
    ("home", "items", "words"),
    [
        (FAR, [LOW, HIGH], NO_HOME),
        (FAR, [LOW_SEA, item(195, 3, 0, 3), HIGH_SEA], NO_HOME),
        (FAR, [item(22, 0, 0.01, 420), HIGH_SEA], NO_HOME),
        (HOME, [item(16, 3, 0.0002, None), HIGH], NO_ALTITUDE),
        (HOME, [item(16, 0, 0.0002, 420, AltitudeMode=3), HIGH], NO_ALTITUDE),
        (HOME, [item(195, 3, 0, None), LOW, HIGH], NO_ALTITUDE),
        (HOME, [LOW, item(195, 10, 0.01, 3), HIGH], r"items\[1\]: nobody knows how high the gr"),
    ],
)
def test_what_has_no_height_is_named(
    folder: Path, home: list[float], items: list[Any], words: str
) -> None:
    with pytest.raises(MissionError, match=words) as refused:
        read(folder, home, *items)
    assert "NaN" not in str(refused.value)


def test_heights_above_sea_level_need_no_home(folder: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mission = read(folder, FAR, LOW_SEA, item(195, 0, 0, 403), HIGH_SEA)
        read(folder, HOME[:2], LOW, HIGH_SEA)  # nor the altitude that the file gives it
    assert mission.route.start.at[2] == 420
    assert mission.route.goal is not None
    assert (mission.route.goal.at[2], mission.route.goal.look_at) == (430, (0, 0, 403))


def test_a_first_item_at_the_height_of_home_is_no_home(folder: Path) -> None:
    with pytest.raises(MissionError, match=r"items\[0\]: .* start lies 1 m inside .* the ground"):
        read(folder, None, item(16, 3, 0, 0), LOW, HIGH)


def flight(folder: Path, north: float) -> vs.Mission:
    ground = {"terrain": "dem.asc", "nodata": "free"}
    world = {"origin_deg": HOME[:2], "ground": ground}
    route = {"start": [0, north, 430], "goal": [0, 0, 430]}
    file = folder / "m.yaml"
    file.write_text(json.dumps({"world": world, "robot": {"radius_m": 0.3}, "route": route}))
    mission = vs.load(file)
    assert isinstance(mission, vs.Mission)
    return mission


@pytest.mark.parametrize("kind", [QgcPlan(), QgcWpl()])
def test_a_start_over_unknown_ground_is_no_home_to_count_from(
    kind: MissionFormat[vs.Mission], folder: Path
) -> None:
    assert kind.write(flight(folder, 90.0), Whereabouts(folder)).text
    with pytest.raises(OutputError, match=r"count from home.*nobody knows how high.*begin over kn"):
        kind.write(flight(folder, 150.0), Whereabouts(folder))


def test_neither_is_it_for_a_path(folder: Path) -> None:
    plan = vs.plan(flight(folder, 150.0))
    for name in ("x.plan", "x.waypoints"):
        with pytest.raises(OutputError, match=r"count from home.*as \.kml"):
            plan.save(folder / name)
        assert not (folder / name).exists()
    plan.save(folder / "x.kml")
    assert ",430" in (folder / "x.kml").read_text()


def test_a_known_home_is_fine() -> None:
    check_known_home(-3.0)
    with pytest.raises(OutputError):
        check_known_home(math.nan)
