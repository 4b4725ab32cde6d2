"""The plans of a fleet's robots, read and proven again one by one.

Tested through ``fleet/saved/test_load_fleet_plan``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from viaspline.bounded_file import is_there
from viaspline.errors import SavedPlanError
from viaspline.fleet.among_moving import proven_among
from viaspline.fleet.patrols.driven_laps import flown_stops_on_laps, law_of_laps, stops_on_laps
from viaspline.fleet.patrols.take_off_first import flown_headings_on_laps, law_of_patrol_in_space
from viaspline.fleet.saved.fleet_file import FleetFile
from viaspline.fleet.space.timed_past_moving import past_moving
from viaspline.fleet.still_world import without_motion
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.stated_tension import with_tension
from viaspline.planner import Plan
from viaspline.planning.routing.visit_order import ordered
from viaspline.saved_plans.law_within_limits import check_moving_proof
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.saved_plans.plan_in_space import flight_as_if_still
from viaspline.saved_plans.planar_plan import planar_plan
from viaspline.space.spatial_order import ordered_in_space
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.world.world import World


@dataclass(frozen=True)
class SavedRobots:
    """The robots of a fleet that was saved.

    Attributes:
        fleet: What was asked for.
        told: Its ``fleet.json``.
    """

    fleet: Fleet
    told: FleetFile

    def plans(self) -> dict[str, Plan | SpatialPlan]:
        """The plans of those that are served, by name, in the order of the fleet.

        Raises:
            MissionError: A file isn't there or can't be read.
            SavedPlanError: One is no plan of its robot, or says what isn't so.
        """
        return dict(self._each())

    def _each(self) -> Iterator[tuple[str, Plan | SpatialPlan]]:
        flies = self.fleet.is_spatial
        still = self.fleet if flies else without_motion(self.fleet)
        shared = None if flies else World.known(still.members[0].mission)
        for member in still.members:
            path = self.told.plan_of(member.name)
            if path is None:
                continue
            found = self._plan(member, PlanFile.read(path), shared)
            law = found.trajectory
            self.told.check_robot(
                member.name, length_m=found.path.length, departs_s=law.start_time,
                arrives_s=law.end_time,
            )  # fmt: skip
            yield member.name, found

    def _plan(
        self, member: FleetMember, file: PlanFile, shared: World | None
    ) -> Plan | SpatialPlan:
        """The plan of one robot.

        Args:
            member: The robot, in the plane in a world without what moves.
            file: Its plan.
            shared: That world, packed; None in space.
        """
        if shared is None:
            return self._flight(member, file)
        asked = member.mission
        world = shared if asked.route.corridor is None else World.known(asked)
        mission = self._as_planned(member, file, world)
        if asked.route.corridor is not None and mission.route.via != asked.route.via:
            world = World.known(mission)
        if asked.route.is_patrol:
            found = planar_plan(file, mission, world, stops_on_laps, law_of_laps)
        else:
            found = planar_plan(file, mission, world)
        if not self.fleet.world.moving:
            return found
        among = proven_among(self.fleet, found)
        assert among.moving_certificate is not None  # it was just proven
        check_moving_proof(file, among.moving_certificate)
        return among

    def _flight(self, member: FleetMember, file: PlanFile) -> SpatialPlan:
        """The plan of one robot in space."""
        mission = _with_told_tension(ordered_in_space(member.mission), file)
        if mission.route.is_patrol:
            found = flight_as_if_still(
                file, self._with_laps(mission, member.name), flown_stops_on_laps,
                flown_headings_on_laps, law_of_patrol_in_space, comes_again=True,
            )  # fmt: skip
        else:
            found = flight_as_if_still(file, mission)
        if not self.fleet.world.moving:
            return found
        among = past_moving(member, found)
        assert among.moving is not None  # it was just proven
        check_moving_proof(file, among.moving)
        return among

    def _with_laps(self, mission: Mission, name: str) -> Mission:
        """The mission of a patrol with the laps that are planned of it."""
        route = mission.route.model_copy(update={"laps": self.told.laps(name)})
        return mission.model_copy(update={"route": route})

    def _as_planned(self, member: FleetMember, file: PlanFile, world: World) -> Mission:
        """The mission of a robot as its path was laid: its order, tension and laps are settled.

        So is by how much its turns are wider than its steering allows, to correct with.
        """
        mission = ordered(member.mission, world)
        own = mission.robot.turn_radius
        if own is not None and (radius := file.number("mission", "turn_radius_m")) > own:
            robot = mission.robot.model_copy(update={"min_turn_radius_m": radius})
            mission = mission.model_copy(update={"robot": robot})
        mission = _with_told_tension(mission, file)
        return self._with_laps(mission, member.name) if mission.route.is_patrol else mission


def _with_told_tension(mission: Mission, file: PlanFile) -> Mission:
    """A mission with the tension that it was planned with, if it left that to the planner."""
    if mission.spline.tension != "auto":
        return mission
    if file.part("mission", "tension") is None:
        return with_tension(mission, None)
    said = file.numbers("mission", "tension").tolist()
    return with_tension(mission, tuple(said) if isinstance(said, list) else said)


def fleet_beside(file: Path, name: str) -> Path:
    """The file of the fleet that stands beside its plan.

    Args:
        file: ``fleet.json``.
        name: What it is called.

    Raises:
        SavedPlanError: It doesn't.
    """
    beside = file.with_name(name)
    if not is_there(beside):
        problem = f"there is no {name} beside it"
        raise SavedPlanError(file, f"{problem}; give load_fleet_plan the fleet of the plan")
    return beside
