"""Who passes first where one robot of a plan has a new path: the rest is as it was."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.execution.fleet_orders import laws_order
from viaspline.fleet.execution.grown_fleet import GrownFleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import (
    Precedence,
    drive_both,
    precedences_among,
    precedences_of,
    waits_at,
)
from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.crossing_leaders import UNSETTLED
from viaspline.kernels.fleet.packed_crossings import PackedCrossings


def renewed_precedences(
    before: FleetPlan, grown: GrownFleet, alone: FleetLaws
) -> tuple[FleetCrossings, tuple[Precedence, ...]]:
    """The crossings of a plan with a new path, each with one order, and who passes it first.

    Only a robot that is crossed by the new path, or was by the one before it, may wait at another
    crossing than it did: what it is late by may be told of the new one.

    Args:
        before: The plan without that path.
        grown: With it and its law.
        alone: When each would be where if it were alone.
    """
    fleet, packed = grown.fleet, grown.fleet.crossings.packed
    leaders, _ = laws_order(replace(fleet, crossings=FleetCrossings(grown.fresh)))
    is_fresh = np.ones(len(packed.robots), np.bool_)
    is_fresh[grown.number[grown.number >= 0]] = False
    drove = np.flatnonzero(drive_both(before.courses, before.crossings, before.laws))
    if (leaders == UNSETTLED)[is_fresh].any() or len(drove) != len(before.precedences):
        crossings = ordered_crossings(fleet.courses, fleet.crossings, fleet.laws)
        return crossings, precedences_of(fleet.courses, crossings, fleet.laws, alone)
    changed = _looked_at_again(before, grown)
    own = FleetCrossings(_boxes_of_robots(packed, changed))
    robots = np.flatnonzero(changed)
    waits = waits_at(fleet.courses, own, fleet.laws, alone, robots)
    drives = drive_both(fleet.courses, fleet.crossings, fleet.laws)
    told = np.empty(len(packed.robots), object)
    stays = grown.number[drove] >= 0
    told[grown.number[drove[stays]]] = _as_objects(before.precedences)[stays]
    fresh = np.flatnonzero(is_fresh & drives)
    told[fresh] = _as_objects(precedences_among(fleet.courses.names, packed, leaders, waits, fresh))
    names = {fleet.courses.names[robot] for robot in robots.tolist()}
    for c in np.flatnonzero(changed[packed.robots].any(axis=1) & drives & ~is_fresh).tolist():
        if told[c].second in names and told[c].waits_s != waits[c]:
            told[c] = replace(told[c], waits_s=float(waits[c]))
    return fleet.crossings, tuple(told[drives].tolist())


def _looked_at_again(before: FleetPlan, grown: GrownFleet) -> Flags:
    """The robot with the new path, those that it crosses, and those that it did before, (n,)."""
    changed = np.zeros(len(grown.fleet.names), np.bool_)
    changed[grown.robot] = True
    changed[grown.crossed()[0]] = True
    changed[before.crossings.packed.robots[grown.number < 0].ravel()] = True
    return changed


def _boxes_of_robots(crossings: PackedCrossings, chosen: Flags) -> PackedCrossings:
    """Crossings without the boxes of any but some robots, (n,)."""
    counts = np.diff(crossings.box_first)
    boxes: Ints = np.flatnonzero(np.repeat(chosen, counts))
    return crossings._replace(
        box_first=np.concatenate(([0], np.cumsum(np.where(chosen, counts, 0)))).astype(np.int64),
        cell=crossings.cell[boxes], crossing=crossings.crossing[boxes],
        other=crossings.other[boxes], low=crossings.low[boxes], high=crossings.high[boxes],
    )  # fmt: skip


def _as_objects(
    precedences: tuple[Precedence, ...],
) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """Precedences that can be put into rows."""
    found = np.empty(len(precedences), object)
    found[:] = precedences
    return found
