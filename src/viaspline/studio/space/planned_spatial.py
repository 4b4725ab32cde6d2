"""From a document of a mission in space to a plan, or to what is wrong with it.

While somebody drags, a leg that isn't clear takes the cheapest way past what stands there; the
other sides are weighed once nobody drags any more. Either is proven.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from viaspline.errors import GaveUpError, MissionError, PlanningError, ViasplineError
from viaspline.mission.model import Mission
from viaspline.mission.stated_tension import with_tension
from viaspline.mission.world_spec import WorldSpec
from viaspline.space.leg_router import LegRouter
from viaspline.space.plan_spatial import plan_by, plan_spatial
from viaspline.space.spatial_order import ordered_in_space
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.studio.document import Document
from viaspline.studio.map_cache import ExpandedDocument
from viaspline.studio.plan_document import PlanFault, blocked_fault, faults_of
from viaspline.studio.space.leg_memory import CheapestWays, KnownWays, RememberedWays
from viaspline.studio.space.solid_files import SolidFiles


@dataclass(frozen=True)
class PlannedSpatial:
    """What came of a document of a mission in space.

    Attributes:
        document: That was planned.
        unfolded: The document with its files read.
        mission: If it is sound.
        plan: If there is a path.
        problems: If there is none.
        seconds: How long it took [s].
        gave_up: Whether it isn't known that there is no path: a budget ran out.
        is_whole: Whether all ways were weighed; else some legs took the cheapest.
        known: The ways of its legs, for the plan after it.
    """

    document: Document
    unfolded: ExpandedDocument | None = None
    mission: Mission | None = None
    plan: SpatialPlan | None = None
    problems: tuple[PlanFault, ...] = ()
    seconds: float = 0.0
    gave_up: bool = False
    is_whole: bool = True
    known: KnownWays = field(default_factory=dict)

    @property
    def world(self) -> WorldSpec | None:
        """The world of the mission, if that is sound."""
        return None if self.mission is None else self.mission.world


def planned_in_space(
    document: Document, files: SolidFiles, base: Path, before: PlannedSpatial | None = None
) -> PlannedSpatial:
    """Plan a document soon: legs that aren't known from before take their cheapest ways.

    Args:
        document: Sound or not.
        files: The voxels, terrains and maps of the studio's folder.
        base: The folder of the mission's file.
        before: What was planned last: its ways hold as long as nothing but the route changes.
    """
    start = time.perf_counter()
    unfolded: ExpandedDocument | None = None
    try:
        unfolded = files.unfold(document, base)
        mission = Mission.model_validate(unfolded.data)
    except MissionError as error:
        problems = faults_of(error, unfolded)
        return PlannedSpatial(
            document, unfolded, problems=problems, seconds=time.perf_counter() - start
        )
    known: KnownWays = {}
    if before is not None and before.mission is not None and _is_as_known(before.mission, mission):
        known = before.known
    sound = PlannedSpatial(document, unfolded, mission, known=known)
    return _attempted(sound, start, _soon)


def wholly_planned_in_space(planned: PlannedSpatial) -> PlannedSpatial:
    """A plan for which all ways past things were weighed.

    Args:
        planned: What was planned soon, of a sound mission.
    """
    return _attempted(planned, time.perf_counter(), _whole)


_Planning = Callable[[Mission, SpatialProblem, KnownWays], "tuple[SpatialPlan, KnownWays, bool]"]


def _soon(
    mission: Mission, problem: SpatialProblem, known: KnownWays
) -> tuple[SpatialPlan, KnownWays, bool]:
    if mission.spline.tension == "auto":
        return _soon_by_any_tension(mission, known)
    ways = CheapestWays(LegRouter(problem, mission), known)
    try:
        return plan_by(mission, problem, ways), ways.known, not ways.alone
    except GaveUpError:
        if not ways.alone:
            raise
        return _whole(mission, problem, known)  # another way may be one that can be laid


def _soon_by_any_tension(mission: Mission, known: KnownWays) -> tuple[SpatialPlan, KnownWays, bool]:
    """As ``_soon`` with a tension of 0, where it is left to the planner: that takes whole plans."""
    stated = with_tension(mission, 0.0)
    plan, ways, _ = _soon(stated, spatial_problem_of(stated), known)
    return plan, ways, False


def _whole(
    mission: Mission, problem: SpatialProblem, known: KnownWays
) -> tuple[SpatialPlan, KnownWays, bool]:
    if mission.spline.tension == "auto":
        return plan_spatial(mission), known, True
    ways = RememberedWays(LegRouter(problem, mission), known)
    return plan_by(mission, problem, ways), ways.known, True


def _attempted(sound: PlannedSpatial, start: float, planning: _Planning) -> PlannedSpatial:
    """Plan a sound mission, or say why there is no plan."""
    mission = sound.mission
    assert mission is not None
    plan: SpatialPlan | None = None
    problems: tuple[PlanFault, ...] = ()
    gave_up, is_whole, known = False, True, sound.known
    try:
        asked = ordered_in_space(mission)
        plan, known, is_whole = planning(asked, spatial_problem_of(asked), sound.known)
    except PlanningError as error:
        problems = (blocked_fault(error, sound.unfolded, mission),)
        gave_up = isinstance(error, GaveUpError)
    except ViasplineError as error:
        problems = (PlanFault(str(error)),)
    return PlannedSpatial(
        sound.document, sound.unfolded, mission, plan, problems, time.perf_counter() - start,
        gave_up, is_whole, known,
    )  # fmt: skip


def _is_as_known(before: Mission, now: Mission) -> bool:
    """Whether the ways between two places are those of the mission before."""
    return (
        before.world == now.world
        and before.robot == now.robot
        and before.route.optimise == now.route.optimise
        and before.route.start == now.route.start  # heights may count from there
    )
