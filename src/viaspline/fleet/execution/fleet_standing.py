"""What is known of a fleet that is driven: how far it has come, who waits, when all arrive.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.fleet.execution.fleet_under_way import FleetUnderWay
from viaspline.fleet.execution.ways_from_rest import FleetMissions
from viaspline.kernels.fleet.order_times import order_times


class FleetStanding:
    """What a navigator of a fleet tells of it between two steps; it changes nothing."""

    _fleet: DrivenFleet
    _missions: FleetMissions | None
    _state: FleetProgressState
    _margin: float
    _short: float

    def __repr__(self) -> str:
        state = self._state
        when = f"at {state.time:.1f} s" if np.isfinite(state.time) else "before the first step"
        arrived, out = int(state.arrived.sum()), int(state.out.sum())
        return (
            f"{type(self).__name__}({len(self.names)} robots {when}, {arrived} arrived, {out} out)"
        )

    @property
    def paths(self) -> Mapping[str, AnyPlan]:
        """The path that each robot drives, with the law that it would drive alone, by name.

        Raises:
            GeometryError: This navigator has no plan.
        """
        return self._under_way.known.plans

    @property
    def names(self) -> tuple[str, ...]:
        """All robots of the fleet, those that don't drive any more as well."""
        return self._fleet.names

    @property
    def time(self) -> float:
        """Of the last step [s]; minus infinity before the first one."""
        return self._state.time

    @property
    def events(self) -> tuple[FleetEvent, ...]:
        """What happened in the last step, or when the fleet was changed after it."""
        return self._state.events

    @property
    def progress(self) -> dict[str, float]:
        """How far each robot has come at least [m]; infinite: it has left the world."""
        come = self._state.packed.progress + self._state.driven
        return dict(zip(self.names, come.tolist(), strict=True))

    @property
    def reached(self) -> bool:
        """Whether all robots that drive have arrived."""
        return bool((self._state.arrived | self._state.out).all())

    @property
    def blocked(self) -> dict[str, str]:
        """Robots that will never get on for a dead one, and for whom each of them waits."""
        stuck = self._state.stuck()
        others = self._state.orders.packed.other
        return {self.names[r]: self.names[others[stuck[r]]] for r in np.flatnonzero(stuck >= 0)}

    def expected(self) -> dict[str, float]:
        """When each robot will arrive, if none is delayed any more [s]; infinite: never.

        Inertia is left out, so it is a little sooner than they will.
        """
        packed, orders = self._state.packed, self._state.orders.packed
        begin = np.where(packed.fixed, np.inf, packed.begin)
        times = order_times(
            orders, packed.leaders, packed.progress, packed.head, packed.fixed, begin
        )
        ends = self._fleet.courses.packed.first[1:] - 1
        arrive = times.last + self._fleet.alone.leave[ends]
        arrive[times.stuck >= 0] = np.inf
        if self._fleet.rounds is not None:
            arrive[self._fleet.rounds > 0.0] = np.inf
        return dict(zip(self.names, arrive.tolist(), strict=True))

    @property
    def _under_way(self) -> FleetUnderWay:
        short = self._margin + self._short
        return FleetUnderWay(self._fleet, self._missions, self._state, short)
