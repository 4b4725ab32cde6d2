"""Who passes first where one robot of a plan has a new path: the rest is as it was."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.execution.fleet_orders import laws_order
from viaspline.fleet.execution.grown_fleet import GrownFleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import (
    TIGHT_S,
    Precedence,
    drive_both,
    precedences_among,
    precedences_of,
    waits_at,
)
from viaspline.kernels.arrays import Flags
from viaspline.kernels.fleet.crossing_leaders import UNSETTLED
from viaspline.kernels.fleet.passing_order import passing_gaps


def renewed_precedences(
    before: FleetPlan, grown: GrownFleet, alone: FleetLaws
) -> tuple[FleetCrossings, tuple[Precedence, ...]]:
    """The crossings of a plan with a new path, each with one order, and who passes it first.

    Only a robot that was crossed by the path before, or comes just after the one with the new path,
    may wait at another crossing than it did: what it is late by may be told of that one.

    Args:
        before: The plan without that path.
        grown: With it and its law.
        alone: When each would be where if it were alone.
    """
    fleet, crossings, own = grown.fleet, grown.fleet.crossings, FleetCrossings(grown.fresh)
    names, count = fleet.courses.names, len(crossings.robots)
    leaders, _ = laws_order(replace(fleet, crossings=own))
    is_fresh = np.ones(count, np.bool_)
    is_fresh[grown.number[grown.number >= 0]] = False
    drove = np.flatnonzero(drive_both(before.courses, before.crossings, before.laws))
    if (leaders == UNSETTLED)[is_fresh].any() or len(drove) != len(before.precedences):
        crossings = ordered_crossings(fleet.courses, crossings, fleet.laws)
        return crossings, precedences_of(fleet.courses, crossings, fleet.laws, alone)
    changed = _looked_at_again(before, grown)
    if np.count_nonzero(changed) > 1:
        own = FleetCrossings(crossings.boxes_of(changed))
    waits = waits_at(fleet.courses, own, fleet.laws, alone, np.flatnonzero(changed))
    drives = drive_both(fleet.courses, crossings, fleet.laws)
    told = np.empty(count, object)
    stays = grown.number[drove] >= 0
    told[grown.number[drove[stays]]] = _as_objects(before.precedences)[stays]
    fresh = np.flatnonzero(is_fresh & drives)
    told[fresh] = _as_objects(precedences_among(names, crossings, leaders, waits, fresh))
    changed[grown.robot] = False  # all of its crossings are fresh
    others = {names[robot] for robot in np.flatnonzero(changed).tolist()}
    again = changed[crossings.robots].any(axis=1) & drives & ~is_fresh if others else is_fresh[:0]
    for c in np.flatnonzero(again).tolist():
        if told[c].second in others and told[c].waits_s != waits[c]:
            told[c] = replace(told[c], waits_s=float(waits[c]))
    return crossings, tuple(told[drives].tolist())


def _looked_at_again(before: FleetPlan, grown: GrownFleet) -> Flags:
    """The robot with the new path, those that come just after it, and those that it crossed, (n,).

    The last ones along the path that it had before.
    """
    fleet, fresh = grown.fleet, grown.fresh
    changed = np.zeros(len(fleet.names), np.bool_)
    changed[grown.robot] = True
    gaps = passing_gaps(fleet.courses.packed, fresh, fleet.laws.packed)
    changed[box_owners(fresh)[(gaps >= 0.0) & (gaps < TIGHT_S)]] = True
    changed[before.crossings.robots[grown.number < 0].ravel()] = True
    return changed


def _as_objects(
    precedences: tuple[Precedence, ...],
) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """Precedences that can be put into rows."""
    return np.fromiter(precedences, object, len(precedences))
