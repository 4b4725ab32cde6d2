"""Changes of a fleet under way: robots that join it, that are sent elsewhere, that go round others.

Tested through ``fleet/execution/test_replanned_fleets``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GaveUpError, GeometryError, NoPathError, PlanningError
from viaspline.fleet.execution.carried_over import carried_over, carried_with
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.dwells import STANDS_MPS, FleetStations
from viaspline.fleet.execution.expected_laws import expected_laws
from viaspline.fleet.execution.fleet_orders import index_of
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.fleet.execution.grown_fleet import GrownFleet, grown_fleet
from viaspline.fleet.execution.joined_fleet import LetIn, joined_fleet
from viaspline.fleet.execution.no_ways import NoWay, SoughtWay
from viaspline.fleet.execution.other_ways import around_now, laid_now, left_of_route, sent_from
from viaspline.fleet.execution.rolled_over import rolled_over
from viaspline.fleet.execution.ways_from_rest import FleetMissions
from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.dispatching import HELD_M
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import Route


@dataclass(frozen=True, eq=False)
class FleetUnderWay:
    """A fleet that is driven, at an instant.

    Attributes:
        fleet: What is driven.
        missions: What its robots are to do; None if it was planned by other means.
        state: How far it has come.
        short: How far before a bar robots may stand and be believed to be farther back still [m].
    """

    fleet: DrivenFleet
    missions: FleetMissions | None
    state: FleetProgressState
    short: float

    @property
    def now(self) -> float:
        """The time of the last step [s]; 0 before the first one."""
        return self.state.time if np.isfinite(self.state.time) else 0.0

    @property
    def known(self) -> FleetMissions:
        """What its robots are to do.

        Raises:
            GeometryError: That isn't known.
        """
        if self.missions is None:
            raise GeometryError("this navigator has no FleetPlan; give one to FleetNavigator")
        return self.missions

    def along(self, fleet: DrivenFleet) -> FleetUnderWay:
        """With another plan; see ``carried_over``."""
        state = carried_over(self.state, self.fleet, fleet, self.short)
        return replace(self, fleet=fleet, state=state)

    def _grown(self, grown: GrownFleet) -> FleetUnderWay:
        """With a robot that has a new path and its law."""
        state = carried_with(self.state, self.fleet, grown, self.short)
        return replace(self, fleet=grown.fleet, state=state)

    @property
    def _patrols(self) -> Ints:
        """The robots that never end."""
        none = np.empty(0, np.int64)
        return none if self.fleet.rounds is None else np.flatnonzero(self.fleet.rounds)

    def told(self, *events: FleetEvent) -> FleetUnderWay:
        """With something more that happened."""
        return replace(self, state=replace(self.state, events=(*self.state.events, *events)))

    def stands(self, robot: int) -> bool:
        """Whether a robot stands, and isn't let any farther."""
        state = self.state
        left = state.packed.promised[robot] - state.places[robot]
        is_bound = left <= self.short + HELD_M
        return bool(is_bound and state.speeds[robot] <= STANDS_MPS and not state.out[robot])

    def stopping(self, name: str, period: float) -> FleetUnderWay:
        """With a robot that is asked to stop as soon as it can.

        It may be faster by now than it was when it was heard, for so long as two periods.
        """
        robot = index_of(self.fleet.names, name)
        state = self.state.copied(self.state.time)
        rides = self.fleet.rides
        faster = float(state.speeds[robot] + 2.0 * period * rides.accel[robot])
        speed = min(faster, max(float(self.fleet.fastest[robot]), float(state.speeds[robot])))
        ahead = 0.5 * speed * speed / float(rides.brake[robot]) + 2.0 * speed * period
        stops_at = min(float(state.places[robot]) + ahead, float(state.packed.promised[robot]))
        state.stops_at[robot] = state.packed.halt[robot] = stops_at
        state.packed.recalled_at[robot] = state.time
        along = stops_at + float(state.driven[robot])
        words = f"{name} is asked to stop at {along:.1f} m"
        event = FleetEvent("stops", self.now, name, words, None, along)
        return replace(self, state=replace(state, events=(*self.state.events, event)))

    def rerouted(self, name: str, route: Route) -> FleetUnderWay:
        """With a robot that is sent elsewhere, from where it stands."""
        robot, missions = index_of(self.fleet.names, name), self.known
        if not self.stands(robot):
            raise GeometryError(
                f"{name} drives, or may set out at any time; ask it to stop with stopping({name!r})"
            )
        place = float(self.state.places[robot])
        mission = sent_from(missions.members[name], missions.plans[name], route, place)
        along = place + float(self.state.driven[robot])
        return self._sent(name, mission, f"{name} is sent elsewhere from {along:.1f} m")

    def replanned(self) -> FleetUnderWay:
        """With other paths for those that wait for a dead robot, from where they stand.

        Each of them gets another path once: two that are in each other's way would take turns.
        """
        now, failed, laid = self, dict[str, FleetEvent](), set[str]()
        while name := now._next_of(failed, laid):
            try:
                now = now._laid_anew(name)
                laid.add(name)
                failed.clear()  # who found no way may find one now
            except (PlanningError, GeometryError) as error:
                failed[name] = FleetEvent("has no way", self.now, name, str(error))
                if isinstance(error, NoPathError):
                    now = now._without_way(name, error)
        return now.told(*failed.values())

    def _without_way(self, name: str, error: NoPathError) -> FleetUnderWay:
        """With a robot for which there is no path as long as nothing is otherwise round it."""
        found = NoWay(self._sought(name, self._anew(name)), error)
        no_ways = {**self.state.no_ways, name: found}
        return replace(self, state=replace(self.state, no_ways=no_ways))

    def _sought(self, name: str, mission: Mission) -> SoughtWay:
        """What the path of a robot is sought by."""
        around = around_now(self.fleet, self.state, self.known, name)
        return SoughtWay(mission.route, around, self._out)

    @property
    def _out(self) -> tuple[str, ...]:
        """Those that never get on any more."""
        return tuple(self.fleet.names[k] for k in np.flatnonzero(self.state.out).tolist())

    def _next_of(self, failed: Mapping[str, FleetEvent], laid: Set[str]) -> str | None:
        """Who is to be laid anew next: it waits for one that never gets on, or in another's way."""
        stuck, others = self.state.stuck(), self.state.orders.packed.other
        blocked = np.flatnonzero(stuck >= 0).tolist()
        names, members = self.fleet.names, self.known.members
        left = [r for r in blocked if names[r] not in failed and names[r] not in laid]
        ready = [r for r in left if self.stands(r)]
        direct = [r for r in ready if self.state.out[others[stuck[r]]]]
        chosen = direct or (ready if failed else [])
        if not chosen:
            return None
        return names[max(chosen, key=lambda r: (members[names[r]].priority, -r))]

    def joined(
        self, member: FleetMember, event: FleetEvent, off_start: float = 0.0,
        waiting: Sequence[int] = (),
    ) -> FleetUnderWay:  # fmt: skip
        """With a robot that begins a path of its own now, in place of one of its name.

        Args:
            member: The robot.
            event: What is told of it.
            off_start: How far from its start it may be [m].
            waiting: Who waits for it to set out, and goes on when it is gone.
        """
        missions, fleet = self.known, self.fleet
        member = _departing(member, max(member.mission.route.depart_s, self.now))
        plan = laid_now(fleet, member, self._sought(member.name, member.mission))
        delay = plan.trajectory.duration
        state = self.state.delayed(waiting, delay) if waiting else self.state
        let_in = LetIn(state.packed.progress, state.packed.promised, state.out)
        leaves = fleet.names.index(member.name) if member.name in fleet.names else None
        grown = grown_fleet(fleet, member, plan, off_start)
        met = np.union1d(grown.crossed()[0], self._patrols)
        laws = expected_laws(fleet, state, leaves, met)
        try:
            changed = self._grown(joined_fleet(grown, laws, let_in))
        except GeometryError:  # too tight for robots that stop short: it lets all others pass first
            laws = expected_laws(fleet, state, leaves)
            ends = laws.arrive[fleet.courses.packed.first[1:] - 1]
            last = float(ends[np.isfinite(ends)].max(initial=self.now))
            grown = grown_fleet(fleet, _departing(member, last), plan, off_start)
            changed = self._grown(joined_fleet(grown, laws, let_in))
        changed = replace(changed, missions=missions.with_way(member, plan))
        return changed._let_out(member).told(event)

    def _let_out(self, member: FleetMember) -> FleetUnderWay:
        """With a robot that may set out by what it is granted, before its law has it depart."""
        sets_out = self.state.sets_out.copy()
        sets_out[self.fleet.names.index(member.name)] = member.mission.route.depart_s
        return replace(self, state=replace(self.state, sets_out=sets_out))

    def _laid_anew(self, name: str) -> FleetUnderWay:
        """With another path for a robot that stands, to what is left of its route."""
        mission, known = self._anew(name), self.state.no_ways.get(name)
        if known is not None and known.sought == self._sought(name, mission):
            raise known.error.with_traceback(None)
        place = float(self.state.places[index_of(self.fleet.names, name)])
        return self._sent(name, mission, f"{name} goes another way from {place:.1f} m")

    def _anew(self, name: str) -> Mission:
        """What is left of the mission of a robot that stands.

        Raises:
            GeometryError: It never ends, or no route is left that could be planned.
        """
        robot, missions = index_of(self.fleet.names, name), self.known
        plan, place = missions.plans[name], float(self.state.places[robot])
        if missions.members[name].mission.route.is_patrol:
            raise GeometryError("it is a patrol that never ends; give it a route of its own")
        return sent_from(missions.members[name], plan, left_of_route(plan, place), place)

    def _sent(self, name: str, mission: Mission, words: str) -> FleetUnderWay:
        """With a robot that has another mission from now on.

        Until it hears of that it may go on to the end of what it was granted.
        """
        member = replace(self.known.members[name], mission=mission)
        robot = index_of(self.fleet.names, name)
        place, until = float(self.state.places[robot]), float(self.state.packed.promised[robot])
        along, creeps = place + float(self.state.driven[robot]), max(until - place, 0.0)
        event = FleetEvent("re-planned", self.now, name, words, None, along)
        try:
            return self.joined(member, event, creeps)
        except GaveUpError:
            if self.fleet.rounds is None or not self.fleet.rounds[robot]:
                raise
        waiting = self._waiting_for(robot)
        return self._without_its_laps(robot).joined(member, event, creeps, waiting)

    def _waiting_for(self, robot: int) -> list[int]:
        """Who stands at a bar that is shut until a robot has passed."""
        stuck, head = self.state.stuck(robot), self.state.packed.head
        at_it = self.state.orders.packed.other[stuck] == robot
        return np.flatnonzero((stuck >= 0) & (stuck == head) & at_it).tolist()

    def _without_its_laps(self, robot: int) -> FleetUnderWay:
        """With patrols counted back as if one that stands, and drives no more laps, weren't there.

        They stand at the end of the laps that are laid out when it hasn't driven its own for long:
        among what comes after them nobody could be timed.
        """
        fleet, state = self.fleet, self.state.without_laps(robot)
        while (later := rolled_over(state, fleet, FleetStations.of(fleet))) is not state:
            state = later
        out = state.out.copy()
        out[robot] = False
        return replace(self, state=replace(state, out=out))


def _departing(member: FleetMember, time: float) -> FleetMember:
    """A robot that may depart at a time [s]."""
    route = member.mission.route.model_copy(update={"depart_s": time})
    return replace(member, mission=member.mission.model_copy(update={"route": route}))
