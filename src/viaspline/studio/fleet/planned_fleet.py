"""From a fleet document to the plan of the fleet, or to what is wrong with it.

What an earlier plan of it has laid isn't laid again: while one robot's route is dragged, the paths
of the others stay, and only when they are driven is found anew.

Tested through ``studio/fleet/test_fleet_server``.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from viaspline.errors import MissionError, ViasplineError
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import is_settled_by_priority, plan_by_priority, plan_fleet
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.world_spec import WorldSpec
from viaspline.studio.document import Document
from viaspline.studio.fleet.unfold_fleet import MemberMission, unfold_fleet
from viaspline.studio.map_cache import ExpandedDocument, MapCache
from viaspline.studio.plan_document import PlanFault, faults_of


@dataclass(frozen=True)
class PlannedFleet:
    """What came of a fleet document.

    Attributes:
        document: That was planned.
        unfolded: The document with what its files hold in their places.
        fleet: If it is sound.
        plan: If it is.
        problems: If it isn't.
        seconds: How long it took [s].
        missions: Of the robots that have files, by the files' names.
        is_whole: Whether everything was tried to serve the robots: see ``wholly_planned``.
        paths: The newest paths, of this document or of one before it.
        drawn: The newest plan, of this document or of one before it: what the page has.
    """

    document: Document
    unfolded: ExpandedDocument | None
    fleet: Fleet | None
    plan: FleetPlan | None
    problems: tuple[PlanFault, ...]
    seconds: float
    missions: Mapping[str, MemberMission] = field(default_factory=dict)
    is_whole: bool = True
    paths: CrossingPaths | None = None
    drawn: FleetPlan | None = None

    @property
    def world(self) -> WorldSpec | None:
        """The world of the fleet, if that is sound."""
        return None if self.fleet is None else self.fleet.world


def planned_fleet(
    document: Document, maps: MapCache, base: Path, before: PlannedFleet | None
) -> PlannedFleet:
    """Plan a fleet document.

    Args:
        document: Sound or not.
        maps: The maps of the studio's folder.
        base: The folder of the fleet's file.
        before: What came of an earlier state of the document.
    """
    start = time.perf_counter()
    unfolded: ExpandedDocument | None = None
    fleet: Fleet | None = None
    plan: FleetPlan | None = None
    problems: tuple[PlanFault, ...] = ()
    missions = {} if before is None else before.missions
    paths = None if before is None else before.paths
    try:
        found = unfold_fleet(document, base, maps, missions)
        unfolded, missions = found.expanded, found.missions
        fleet = Fleet.model_validate(_with_same_world(unfolded.data, before))
        paths = crossing_paths(fleet, before=paths)
        plan = plan_by_priority(fleet, paths)
    except MissionError as error:
        problems = faults_of(error, unfolded)
    except ViasplineError as error:
        problems = (PlanFault(str(error)),)
    drawn = plan if plan is not None or before is None else before.drawn
    seconds = time.perf_counter() - start
    is_whole = plan is None or paths is None or is_settled_by_priority(plan, paths)
    return PlannedFleet(
        document, unfolded, fleet, plan, problems, seconds, missions, is_whole, paths, drawn
    )


def wholly_planned(planned: PlannedFleet) -> PlannedFleet:
    """Try everything for robots that priority alone leaves without a law, or serves badly.

    That is the plan of the command line; it may take longer than a frame.
    """
    if planned.is_whole or planned.fleet is None:
        return planned
    start = time.perf_counter()
    plan = plan_fleet(planned.fleet, paths=planned.paths)
    seconds = time.perf_counter() - start
    return replace(planned, plan=plan, drawn=plan, seconds=seconds, is_whole=True)


def _with_same_world(data: Document, before: PlannedFleet | None) -> Document:
    """The data with the world that is known to be sound, if it is that of an earlier state.

    Parts of documents that haven't changed are the same objects: they are compared at once.
    """
    if before is None or before.fleet is None or before.unfolded is None:
        return data
    if "world" not in data or data["world"] != before.unfolded.data.get("world"):
        return data
    return {**data, "world": before.fleet.world}
