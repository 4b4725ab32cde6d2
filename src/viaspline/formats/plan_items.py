"""The items of a plan of QGroundControl's: simple ones, and complex ones as what they stand for.

Tested through ``formats/test_qgc_plan`` and ``formats/test_flights``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from types import MappingProxyType
from typing import Final

from viaspline.formats.items import ABSOLUTE, GLOBAL, RELATIVE, TERRAIN, Item, Place
from viaspline.formats.json_tree import Tree
from viaspline.formats.plan_parts import (
    ABOVE_TERRAIN,
    ABSOLUTE_ALTITUDE,
    ALTITUDE_MODES,
    RELATIVE_ALTITUDE,
    TERRAIN_FRAME,
)
from viaspline.mission.unplaced_faults import describe

_FRAMES: Final = MappingProxyType(
    {RELATIVE_ALTITUDE: RELATIVE, ABSOLUTE_ALTITUDE: ABSOLUTE, TERRAIN_FRAME: TERRAIN}
)
"""The frames in which QGroundControl writes what has an AltitudeMode."""

ABOVE_SEA: Final = 0


def plan_items(tree: Tree, notes: dict[str, list[str]]) -> Iterator[Item]:
    """The items in order, complex ones resolved; numbers count the simple items, from 1."""
    number = 0
    for entry in tree.items():
        for simple in _resolved(entry, notes):
            number += 1
            item = _item(simple, number, notes)
            if item is not None:
                yield item


def _resolved(entry: Tree, notes: dict[str, list[str]]) -> Iterator[Tree]:
    """The simple items that an item stands for."""
    if not isinstance(entry.value, dict):
        entry.fault(f"found {describe(entry.value)}", "it should be a mission item")
        return
    if entry["type"].value != "ComplexItem":
        yield entry
        return
    kind = entry["complexItemType"].value
    transects = entry["TransectStyleComplexItem"]["Items"]
    if isinstance(transects.value, list) and transects.value:
        yield from transects.items()
        return
    name = kind if isinstance(kind, str) else "complex item"
    notes.setdefault(f"{name} that isn't resolved to way points", []).append(entry.key)


def _item(tree: Tree, number: int, notes: dict[str, list[str]]) -> Item | None:
    command = tree["command"].whole()
    frame = tree["frame"].whole()
    values = _values(tree)
    if command is None or frame is None or values is None:
        return None
    *params, latitude, longitude, altitude = values
    over_terrain = altitude if frame in TERRAIN else math.nan
    mode = _altitude_mode(tree["AltitudeMode"])
    if mode == ABOVE_TERRAIN and frame in GLOBAL:
        # The altitude above sea level is what QGroundControl makes of it, once it has a terrain.
        over_terrain = tree["Altitude"].number()
        altitude = tree["AMSLAltAboveTerrain"].number()
        frame = ABOVE_SEA
    elif mode is not None and frame in GLOBAL and frame not in _FRAMES.get(mode, GLOBAL):
        kind = f"AltitudeMode {mode} ({ALTITUDE_MODES[mode]}), and frame {frame}, which counts"
        notes.setdefault(kind, []).append(tree.key)
    return Item(
        number=number,
        command=command,
        frame=frame,
        params=(params[0], params[1], params[2], params[3]),
        latitude=latitude,
        longitude=longitude,
        altitude=altitude,
        place=Place(tree.key),
        over_terrain=over_terrain,
    )


def _altitude_mode(tree: Tree) -> int | None:
    """What an altitude is above, where the item says so beside its frame."""
    mode = None if tree.value is None else tree.whole()
    if mode is not None and mode not in ALTITUDE_MODES:
        names = ", ".join(f"{number} ({words})" for number, words in ALTITUDE_MODES.items())
        tree.fault(f"there is no AltitudeMode {mode}", f"it should be one of {names}")
    return mode


def _values(tree: Tree) -> tuple[float, ...] | None:
    """The seven parameters, from any of the three ways in which they have been written."""
    if "coordinate" in tree:
        position = tree["coordinate"].numbers(3, "[latitude, longitude, altitude]")
        if "params" in tree:
            params = tree["params"].numbers(4, "a list of four parameters")
        else:
            params = tuple(tree[f"param{i}"].number() for i in range(1, 5))
        return (*params[:4], *position[:3]) if params and position else None
    params = tree["params"].numbers(7, "a list of seven parameters")
    return params[:7] if params else None
