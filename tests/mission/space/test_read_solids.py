"""Voxels and terrain that a mission has from files."""

from pathlib import Path

import numpy as np
import pytest

from viaspline.errors import MissionError, OutputError
from viaspline.formats.load import load
from viaspline.formats.mission_yaml import yaml_text
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.model import Mission

ROUTE = "route: {start: [0, 0, 10], goal: [9, 0, 10]}\n"
CUBES = np.zeros((2, 2, 2), bool)
CUBES[1, 0, 1] = True


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "a.3dmap").write_text("voxel 2 2 2\n1 0 1\n")
    header = "ncols 2\nnrows 2\nxllcenter 490\nyllcenter 990\ncellsize 40\n"
    (tmp_path / "maps" / "dem.asc").write_text(header + "3 4\n1 2\n")
    return tmp_path


def loaded(folder: Path, text: str) -> Mission:
    file = folder / "m.yaml"
    file.write_text(text + ROUTE)
    mission = load(file)
    assert isinstance(mission, Mission)
    return mission


FOUR = "ncols 2\nnrows 2\n1 2\n3 4\n"
WORLD = """world:
  ground: {terrain: maps/dem.asc, nodata: free, origin_m: [500, 1000]}
  known:
    - {voxels: {file: maps/a.3dmap, cell_m: 0.5, origin_m: [20, 30, 40]}, name: plant}
"""


def test_files_are_read_beside_the_mission_and_named_when_it_is_written(folder: Path) -> None:
    mission = loaded(folder, WORLD)
    ground = mission.world.ground
    assert ground is not None
    assert ground.terrain == Terrain([[1, 2], [3, 4]], 40, (-10, -10))
    assert mission.world.known[0].voxels == Voxels(CUBES, 0.5, (20, 30, 40))
    (folder / "below").mkdir()
    (folder / "below" / "n.yaml").write_text(yaml_text(mission, folder / "below"), "utf-8")
    text = (folder / "below" / "n.yaml").read_text()
    assert "terrain: ../maps/dem.asc" in text.replace('"', "")
    assert load(folder / "below" / "n.yaml") == mission


def test_values_stand_for_files_in_python(tmp_path: Path) -> None:
    data = {
        "world": {
            "ground": {"terrain": Terrain(np.zeros((2, 2)), 40, (-10, -10))},
            "known": [{"voxels": Voxels(CUBES, 0.5, (20, 30, 40))}, {"voxels": CUBES}],
        },
        "route": {"start": [5, 0, 10], "goal": [9, 0, 10]},
    }
    mission = Mission.model_validate(data)
    assert mission.world.known[1].voxels == Voxels(CUBES, 1.0)
    assert Mission.model_validate(mission.model_dump(by_alias=True)) == mission
    with pytest.raises(OutputError, match=r"(terrain|voxels) made in memory"):
        yaml_text(mission)


@pytest.mark.parametrize(
    ("world", "key", "words"),
    [
        ("ground: {terrain: no.asc}", "world.ground.terrain", "no.asc: there is no such file"),
        ("ground: {terrain: dem.xyz}", "world.ground.terrain", "kind of terrain"),
        ("ground: {terrain: maps/a.3dmap}", "world.ground.terrain", "kind of terrain"),
        ("ground: {terrain: 5}", "world.ground.terrain", "found 5; it should be the path"),
        ("ground: {terrain: maps/dem.asc, flat_m: 0}", "world.ground.flat_m", "exclude each other"),
        ("ground: {}", "world.ground", "has none of flat_m and terrain"),
        ("known: [{voxels: {file: no.bt}}]", "world.known[0].voxels.file", "no such file"),
        ("known: [{voxels: {file: a.vox}}]", "world.known[0].voxels.file", "kind of voxels"),
        ("known: [{voxels: {fil: a.bt}}]", "world.known[0].voxels.fil", "did you mean 'file'?"),
        ("known: [{voxels: plant.bt}]", "world.known[0].voxels", "found the text"),
        (
            "known: [{voxels: {file: maps/a.3dmap, unknown: free}}]",
            "world.known[0].voxels.unknown",
            "nothing is unknown in it",
        ),
        (
            "known: [{voxels: {file: a.bt, cell_m: 2}}]",
            "world.known[0].voxels.cell_m",
            "has its own resolution",
        ),
        (
            "known: [{voxels: {file: maps/a.3dmap}, height_m: [0, 5]}]",
            "world.known[0].height_m",
            "heights of its own",
        ),
    ],
)
def test_a_file_that_cannot_be_read_is_one_fault_with_its_place(
    world: str, key: str, words: str, folder: Path
) -> None:
    with pytest.raises(MissionError) as caught:
        loaded(folder, f"world:\n  {world}\n")
    (fault,) = caught.value.faults
    assert fault.key == key
    assert words in str(fault)
    assert (fault.line, fault.source) == (2, str(folder / "m.yaml"))


def test_a_broken_row_of_voxels_is_told_by_its_own_line(folder: Path) -> None:
    (folder / "maps" / "a.3dmap").write_text("voxel 2 2 2\n1 0 7\n")
    with pytest.raises(MissionError, match=r"m.yaml:4:.*known\[0\].voxels.file: .*a.3dmap:2:1: "):
        loaded(folder, WORLD)


@pytest.mark.parametrize(
    ("name", "text", "wrong"),
    [
        (
            "dem.asc",
            "ncols 2\nnrows 2\nxllcorner 1e308\nyllcorner 0\ncellsize 9\n1 2\n3 4\n",
            "1e+308",
        ),
        (
            "dem.asc",
            "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1e-320\n1 2\n3 4\n",
            "cells",
        ),
        ("a.3dmap", "voxel 4000 1 1\n1 0 0\n", "4e+09"),
    ],
)
def test_a_file_of_what_lies_out_of_this_world_is_named(
    folder: Path, name: str, text: str, wrong: str
) -> None:
    (folder / "maps" / name).write_text(text)
    asked = {
        "dem.asc": "world: {ground: {terrain: maps/dem.asc}}\n",
        "a.3dmap": "world: {known: [{voxels: {file: maps/a.3dmap, cell_m: 1e6}}]}\n",
    }
    with pytest.raises(MissionError) as raised:
        loaded(folder, asked[name])
    [fault] = raised.value.faults
    assert f"maps/{name}" in fault.problem
    assert wrong in fault.problem
    assert fault.remedy
