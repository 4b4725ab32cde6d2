"""How far a fleet has come: all that a navigator of a fleet keeps from step to step.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_orders import FleetOrders
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.fleet.execution.judged_reports import KnownFleet
from viaspline.fleet.execution.no_ways import NoWay
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.dispatching import dispatch_at_start, dispatch_copy
from viaspline.kernels.fleet.order_flow import order_flow
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch


@dataclass(frozen=True, eq=False)
class FleetProgressState:
    """What is known of a fleet under way.

    Attributes:
        orders: Who waits for whom, as it was planned.
        packed: How far each robot has come and may go, and who passes each crossing first now.
        time: Of the last step [s]; minus infinity before the first one.
        speeds: As last reported [m/s], (n,).
        heard: When each robot was last believed [s], (n,).
        arrived: Whether each has arrived, (n,).
        silent: Whether it was said that a robot isn't heard of, (n,).
        out: Whether a robot doesn't drive any more: dead, taken out, or never had a law, (n,).
        driven: How far each patrol came in periods that are over; places count from there [m],
            (n,).
        places: How far along its path each said that it is [m], (n,).
        paths: Which of its paths each one drives, (n,).
        stations: Which of its stations each one comes to next, or stands at, (n,).
        stands: Since when it stands there [s]; infinite: it doesn't yet, (n,).
        stops_at: Where each was asked to stop [m]; infinite: nowhere, (n,).
        sets_out: Before when none may have set out [s], (n,).
        doubted: See ``KnownFleet``, (n, 2).
        events: What happened in the last step.
        no_ways: Robots for which no path was found where they stand, by name.
    """

    orders: FleetOrders
    packed: PackedDispatch
    time: float
    speeds: Floats
    heard: Floats
    arrived: Flags
    silent: Flags
    out: Flags
    driven: Floats
    places: Floats
    paths: Ints
    stations: Ints
    stands: Floats
    stops_at: Floats
    sets_out: Floats
    doubted: Floats
    events: tuple[FleetEvent, ...] = ()
    no_ways: Mapping[str, NoWay] = field(default_factory=dict)

    @classmethod
    def at_start(cls, fleet: DrivenFleet, orders: FleetOrders) -> FleetProgressState:
        """All robots stand at their starts."""
        count = len(fleet.names)
        packed = dispatch_at_start(orders.packed, orders.leaders, fleet.rides.depart)
        out = ~fleet.laws.packed.is_timed
        packed.fixed[:] = out
        return cls(
            orders, packed, -np.inf, np.zeros(count), np.full(count, -np.inf),
            np.zeros(count, np.bool_), np.zeros(count, np.bool_), out, np.zeros(count),
            np.zeros(count), np.zeros(count, np.int64), np.zeros(count, np.int64),
            np.full(count, np.inf), np.full(count, np.inf), fleet.rides.depart.copy(),
            np.full((count, 2), np.inf),
        )  # fmt: skip

    def copied(self, time: float) -> FleetProgressState:
        """A state of its own for the step at a time [s], in which nothing has happened yet."""
        return replace(
            self,
            packed=dispatch_copy(self.packed),
            time=time,
            speeds=self.speeds.copy(),
            heard=self.heard.copy(),
            arrived=self.arrived.copy(),
            silent=self.silent.copy(),
            out=self.out.copy(),
            driven=self.driven.copy(),
            places=self.places.copy(),
            paths=self.paths.copy(),
            stations=self.stations.copy(),
            stands=self.stands.copy(),
            stops_at=self.stops_at.copy(),
            sets_out=self.sets_out.copy(),
            doubted=self.doubted.copy(),
            events=(),
        )

    def delayed(self, robots: Sequence[int], seconds: float) -> FleetProgressState:
        """As if some robots went on so much later than they can [s]."""
        state = self.copied(self.time)
        state.packed.begin[list(robots)] += seconds
        return replace(state, events=self.events)

    def known(self, fleet: DrivenFleet) -> KnownFleet:
        """What reports are judged by."""
        return KnownFleet(
            names={name: robot for robot, name in enumerate(fleet.names)},
            lengths=fleet.lengths,
            fastest=fleet.fastest,
            progress=self.packed.progress.copy(),
            departs=self.sets_out,
            heard=self.heard,
            out=self.out,
            paths=self.paths,
            doubted=self.doubted,
        )

    def silences(self, longest: float, departs: Floats) -> list[FleetEvent]:
        """Robots that haven't been heard of for so long [s], told once."""
        if np.isinf(self.time):
            return []
        found = []
        names = self.orders.names
        late = self.time - np.maximum(self.heard, departs)
        for robot in np.flatnonzero((late > longest) & ~self.silent & ~self.out & ~self.arrived):
            self.silent[robot] = True
            words = f"{names[robot]} hasn't been heard of for {late[robot]:.1f} s"
            found.append(FleetEvent("silent", self.time, names[robot], words))
        return found

    def stuck(self, leaves: int | None = None) -> Ints:
        """For each robot the bar at which it will wait for ever, or -1, (n,).

        Args:
            leaves: A robot that is taken never to get on, as those that indeed don't.
        """
        packed, orders = self.packed, self.orders.packed
        fixed = packed.fixed.copy()
        if leaves is not None:
            fixed[leaves] = True
        if not fixed.any():  # the orders have no cycle
            return np.full(len(fixed), -1)
        stuck: Ints = order_flow(orders, packed.leaders, packed.progress, packed.head, fixed)[1]
        return stuck

    def taken_out(self, robot: int, event: FleetEvent) -> FleetProgressState:
        """A robot has left the world."""
        return replace(self.without_laps(robot), events=(*self.events, event))

    def without_laps(self, robot: int) -> FleetProgressState:
        """A robot is in nobody's way any more along the path that it has."""
        state = self.copied(self.time)
        state.packed.progress[robot] = np.inf
        state.packed.fixed[robot] = True
        state.out[robot] = True
        return replace(state, events=self.events)
