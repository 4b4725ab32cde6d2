"""From a document to a plan, or to what is wrong with it.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

from viaspline.errors import Change, GaveUpError, MissionError, PlanningError, ViasplineError
from viaspline.mission.model import Mission
from viaspline.mission.world_spec import WorldSpec
from viaspline.planner import Plan, plan
from viaspline.studio.document import Document
from viaspline.studio.key_paths import Path as Keys
from viaspline.studio.key_paths import path_of
from viaspline.studio.map_cache import ExpandedDocument, MapCache


@dataclass(frozen=True)
class PlanFault:
    """One reason why there is no plan.

    Attributes:
        text: What is wrong.
        remedy: What would be right, in words.
        path: Where in the document.
        where: The place [m], if it has one.
        changes: What would help, each with its place in the document.
    """

    text: str
    remedy: str = ""
    path: Keys = ()
    where: tuple[float, ...] | None = None
    changes: tuple[tuple[Keys, object], ...] = ()


@dataclass(frozen=True)
class PlannedDocument:
    """What came of a document.

    Attributes:
        document: That was planned.
        unfolded: The document with the obstacles of its maps in their places.
        mission: If it is sound.
        plan: If there is a path.
        problems: If there is none.
        seconds: How long it took [s].
        gave_up: Whether it isn't known that there is no path: a budget ran out.
    """

    document: Document
    unfolded: ExpandedDocument | None
    mission: Mission | None
    plan: Plan | None
    problems: tuple[PlanFault, ...]
    seconds: float
    gave_up: bool = False

    @property
    def world(self) -> WorldSpec | None:
        """The world of the mission, if that is sound."""
        return None if self.mission is None else self.mission.world


def planned(document: Document, maps: MapCache, base: Path) -> PlannedDocument:
    """Plan a document.

    Args:
        document: Sound or not.
        maps: The maps of the studio's folder.
        base: The folder of the mission's file.
    """
    start = time.perf_counter()
    unfolded: ExpandedDocument | None = None
    mission: Mission | None = None
    found: Plan | None = None
    problems: tuple[PlanFault, ...] = ()
    gave_up = False
    try:
        unfolded = maps.unfold(document, base)
        mission = Mission.model_validate(unfolded.data)
        found = plan(mission)
    except MissionError as error:
        problems = faults_of(error, unfolded)
    except PlanningError as error:
        problems = (blocked_fault(error, unfolded, mission),)
        gave_up = isinstance(error, GaveUpError)
    except ViasplineError as error:
        problems = (PlanFault(str(error)),)
    seconds = time.perf_counter() - start
    return PlannedDocument(document, unfolded, mission, found, problems, seconds, gave_up)


def faults_of(error: MissionError, unfolded: ExpandedDocument | None) -> tuple[PlanFault, ...]:
    """What is wrong with a document, each fault with its place in it."""
    return tuple(
        PlanFault(
            text=fault.problem,
            remedy=fault.remedy,
            path=_original(fault.key, unfolded),
            changes=_changes(fault.changes, unfolded),
        )
        for fault in error.faults
    )


def blocked_fault(
    error: PlanningError, unfolded: ExpandedDocument | None, mission: Mission | None
) -> PlanFault:
    """Why there is no path, or why none was found, each change with its place in the document."""
    changes = tuple(_as_given(change, error, mission) for change in error.changes)
    text = error.reason
    if isinstance(error, GaveUpError):
        text = f"gave up: {text} (tried: {'; '.join(error.tried)})"
    return PlanFault(
        text=text,
        remedy=error.remedy,
        where=error.where,
        changes=_changes(changes, unfolded),
    )


def _as_given(change: Change, error: PlanningError, mission: Mission | None) -> Change:
    """The change with the via point's place in the file, if the planner has put them in order."""
    if mission is None or mission.route.order == "given":
        return change
    if not change.key.startswith("route.via["):
        return change
    names = [via.name or f"via {i + 1}" for i, via in enumerate(mission.route.via)]
    if error.via not in names:
        return change
    return Change(f"route.via[{names.index(error.via)}].at", change.value)


def _changes(
    changes: tuple[Change, ...], unfolded: ExpandedDocument | None
) -> tuple[tuple[Keys, object], ...]:
    return tuple((_original(change.key, unfolded), change.value) for change in changes)


def _original(key: str, unfolded: ExpandedDocument | None) -> Keys:
    path = path_of(key)
    return path if unfolded is None else unfolded.original(path)
