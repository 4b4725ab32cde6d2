"""A small flight among one of each shape in space, planned and flown.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from viaspline.errors import ViasplineError
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.model import Mission

Parts = dict[str, Any]

DRONE: Parts = {
    "radius_m": 0.3, "half_height_m": 0.12, "clearance_m": 0.3, "max_speed_mps": 4,
    "max_accel_mps2": 2, "max_climb_mps": 2, "max_descent_mps": 1.2, "max_yaw_rate_dps": 90,
    "sensor": {"range_m": 8},
}  # fmt: skip


def fly_small() -> None:
    """Plan and fly small missions in space."""
    from viaspline.plan_mission import plan
    from viaspline.space.online.fly import fly
    from viaspline.space.spatial_plan import SpatialPlan

    for mission in flights():
        with suppress(ViasplineError):
            planned = plan(mission)
            assert isinstance(planned, SpatialPlan)
            fly(planned)


def flights() -> Iterator[Mission]:
    """One over flat ground among single solids, two among voxels, one over hills."""
    flat: Parts = {"ground": {"flat_m": 0}}
    ball: Parts = {"ball": {"center": [9, 8, 4], "radius": 1}}
    yield _mission(flat | {"altitude": {"max_m": 20, "above": "home"}, "known": _solids()}, [ball])
    yield _mission(flat | {"known": [{"voxels": _voxels()}]})
    yield _among_voxels_alone()
    nodes = np.add.outer(np.sin(np.linspace(0, 3, 12)), np.cos(np.linspace(0, 3, 12)))
    hills: Parts = {"terrain": Terrain(nodes, 2.0, (-3.0, -3.0))}
    yield _mission({"ground": hills, "known": _solids()}, [ball])


def _mission(world: Parts, unseen: Sequence[Parts] = ()) -> Mission:
    route: Parts = {
        "start": {"at": [0, 0]},
        "takeoff": {"to_agl_m": 4},
        "via": [
            {"at": [6, 6, 4.5], "look_at": [10, 10, 4], "dwell_s": 1},
            {"gate": {"at": [12, 9, 4], "facing_deg": 0, "width_m": 2, "height_m": 3}},
            {"at": [14, 14, 5]},
        ],
        "land": {"at": [15, 15]},
    }
    return Mission.model_validate(
        {"world": {**world, "unseen": list(unseen)}, "robot": DRONE, "route": route}
    )


def _among_voxels_alone() -> Mission:
    """A ball behind a wall: cubes without ground are searched by kernels of their own."""
    cubes = np.zeros((12, 12, 8), np.bool_)
    cubes[5, :10] = True
    world: Parts = {"bounds": [0, 0, 12, 12], "altitude": {"min_m": 0.4, "max_m": 7.6}}
    ball = {key: value for key, value in DRONE.items() if key != "half_height_m"}
    return Mission.model_validate({
        "world": world | {"known": [{"voxels": Voxels(cubes, 1.0)}]},
        "robot": ball | {"clearance_m": 0.1},
        "route": {"start": [2.5, 2.5, 3.5], "goal": [9.5, 2.5, 3.5]},
    })  # fmt: skip


def _solids() -> list[Parts]:
    return [
        {"ball": {"center": [3, 3, 4], "radius": 0.8}},
        {"box": {"min": [8, 5, 0], "max": [9, 6, 6]}},
        {"capsule": {"from": [4, 9, 6], "to": [12, 12, 6], "radius": 0.1}},
        {"circle": {"center": [13, 12], "radius": 0.7}, "height_m": [0, 9]},
    ]


def _voxels() -> Voxels:
    cubes = np.zeros((24, 24, 16), np.bool_)
    cubes[5:9, 5:9, :13] = cubes[16:20, 8:12, 4:9] = cubes[10:14, 18:20, :11] = True
    return Voxels(cubes, 0.5, (-1.0, -1.0, 0.0))
