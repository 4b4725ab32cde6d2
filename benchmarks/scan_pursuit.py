"""Pure pursuit of the shortest way over a map of all scans: what one would write in an afternoon.

After Coulter, "Implementation of the Pure Pursuit Path Tracking Algorithm", 1992: the cart drives
the arc to a place a little ahead on its way, which is looked for anew twice a second. It turns on
the spot where that lies aside, and slows down for its goal and for tight arcs.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scan_map import ScanMap
from sim_bridge import PERIOD, RADIUS, SimulatedCart

KEPT, AHEAD, EVERY = 0.08, 0.4, 0.5
"""Free space on the way [m]; so far ahead it heads for it [m]; looked for anew so often [s]."""

ASIDE, TURN_GAIN = 0.7, 1.5
"""Beyond that it turns where it is [rad]; by its gain [1/s]."""


class Pursuit:
    """Chooses commands for a cart.

    Args:
        start: x, y [m].
        goal: x, y [m].
        limits: Greatest speed [m/s], yaw rate [rad/s], and change of speed [m/s²].
    """

    def __init__(
        self,
        start: tuple[float, float],
        goal: tuple[float, float],
        limits: tuple[float, float, float],
    ) -> None:
        self.map, self.limits = ScanMap(start, goal, RADIUS + KEPT), limits
        self.goal = self.heads_for = np.array(goal)
        self.since, self.speed = -math.inf, 0.0

    def told(self, cart: SimulatedCart, ranges: NDArray[np.float64]) -> tuple[float, float]:
        """Speed [m/s] and yaw rate [rad/s] to drive now."""
        fastest, turn, accel = self.limits
        place, heading = np.array(cart.state.position), cart.state.heading
        self.map.saw(cart, ranges)
        near = np.hypot(*(self.heads_for - place)) < 0.5 * AHEAD
        if near or cart.time - self.since >= EVERY:
            self.heads_for, self.since = self.map.ahead(place, AHEAD), cart.time
        gone = self.heads_for - place
        angle = math.remainder(math.atan2(gone[1], gone[0]) - heading, math.tau)
        if abs(angle) > ASIDE:
            self.speed = max(self.speed - accel * PERIOD, 0.0)
            return self.speed, min(max(TURN_GAIN * angle, -turn), turn)
        bend = 2.0 * math.sin(angle) / max(float(np.hypot(*gone)), 0.1)
        wanted = min(
            fastest,
            math.sqrt(2.0 * accel * float(np.hypot(*(self.goal - place)))),
            turn / max(abs(bend), 1e-6),
            math.sqrt(accel / max(abs(bend), 1e-6)),
        )
        change = accel * PERIOD
        self.speed = min(max(wanted, self.speed - change), self.speed + change)
        return self.speed, self.speed * bend
