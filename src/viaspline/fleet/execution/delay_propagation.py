"""What one robot's delay does to the others, at once."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.fleet_orders import FleetOrders, index_of
from viaspline.handed_in import number_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.delay_links import PackedLinks, packed_links
from viaspline.kernels.fleet.delayed_arrivals import delayed_arrivals


@dataclass(frozen=True, eq=False)
class DelayPropagation:
    """The orders of a fleet, ready to say what a delay does: only what comes after it is touched.

    Robots drive as fast as they may, and inertia is left out.

    Attributes:
        orders: Who passes first where.
        links: Who opens whose bars.
    """

    orders: FleetOrders
    links: PackedLinks

    @classmethod
    def of(cls, orders: FleetOrders, begin: Floats | None = None) -> DelayPropagation:
        """Reckon once when all robots come where, if nobody is delayed.

        Args:
            orders: Of the fleet.
            begin: When robots set out [s], (n,); all at 0 s if it isn't given.
        """
        begin = np.zeros(len(orders.names)) if begin is None else begin
        return cls(orders, packed_links(orders.packed, orders.leaders, orders.sequence(), begin))

    def delays(self, name: str, seconds: float) -> Mapping[str, float]:
        """How much later robots arrive when one of them sets out later [s], by name.

        Those that are not named arrive when they would have.

        Args:
            name: Of that robot.
            seconds: By how much it sets out later.

        Raises:
            GeometryError: There is no such robot, or the delay is no finite number of 0 or more.
        """
        robot, seconds = index_of(self.orders.names, name), number_from("seconds", seconds)
        if not 0.0 <= seconds < math.inf:
            raise GeometryError(f"seconds is {seconds}; give a finite number of 0 or more")
        robots, lates = delayed_arrivals(self.orders.packed, self.links, robot, seconds)
        names = self.orders.names
        return {
            names[r]: s for r, s in zip(robots.tolist(), lates.tolist(), strict=True) if s > 0.0
        }
