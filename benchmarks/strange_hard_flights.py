"""Strange missions in space made harder: narrow bands, tight gates, more in the way, fewer limits.

Each is a mission of ``strange_flights.py`` with one to three of these changes, so that sound ones
get tight and some become impossible; that they are refused in words is all that is asked of those.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from strange_flights import SIDE_M, TOP_M, StrangeFlights


class HardFlights(StrangeFlights):
    """Draws missions of a kind, made harder.

    Args:
        rng: Where chance comes from.
        kind: One of ``FLIGHT_KINDS``.
        folder: Where files that missions name are written.
    """

    def __init__(self, rng: np.random.Generator, kind: str, folder: Path) -> None:
        super().__init__(rng, kind, folder)
        self.changes = (self._cables, self._narrow_gates, self._low_band, self._movers,
                        self._laps, self._fast, self._nearer)  # fmt: skip

    def draw(self) -> dict[str, Any]:
        """The next one."""
        mission = super().draw()
        for k in self.rng.choice(len(self.changes), int(self.rng.integers(1, 4)), replace=False):
            self.changes[k](mission)
        return mission

    def _cables(self, mission: dict[str, Any]) -> None:
        """Lines across the whole world, as thin as a finger."""
        base = self._ground_at(0.5 * SIDE_M, 0.5 * SIDE_M)
        for number in range(int(self.rng.integers(3, 9))):
            x, y = self.rng.uniform(0, SIDE_M, (2, 2))
            z = base + self.rng.uniform(2, TOP_M, 2)
            ends = np.round(np.column_stack((x, y, z)), 2).tolist()
            capsule = {"from": ends[0], "to": ends[1], "radius": 0.01}
            mission["world"]["known"].append({"name": f"cable {number}", "capsule": capsule})

    def _narrow_gates(self, mission: dict[str, Any]) -> None:
        """Frames about all gates, with a hand's breadth to spare."""
        robot = mission["robot"]
        body = max(robot["radius_m"], robot.get("half_height_m", 0.0))
        half = body + robot["clearance_m"] + robot.get("tracking_error_m", 0.0) + 0.1
        for number, point in enumerate(mission["route"]["via"]):
            if "gate" not in point:
                continue
            gate = point["gate"]
            gate["width_m"] = gate["height_m"] = round(2 * half, 3)
            facing = np.radians(gate["facing_deg"])
            left = half * np.array([-np.sin(facing), np.cos(facing), 0.0])
            up = np.array([0.0, 0.0, half])
            middle = np.array(gate["at"])
            corners = [middle + a * left + b * up for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
            for k in range(4):
                ends = [np.round(corners[k - j], 4).tolist() for j in (1, 0)]
                capsule = {"from": ends[0], "to": ends[1], "radius": 0.02}
                one = {"name": f"frame {number}.{k}", "capsule": capsule}
                mission["world"]["known"].append(one)

    def _low_band(self, mission: dict[str, Any]) -> None:
        """A ceiling that is hardly above the highest place."""
        if "altitude" in mission["world"]:
            band = mission["world"]["altitude"]
            band["max_m"] = round(band["max_m"] - self._within(0, 3), 2)

    def _movers(self, mission: dict[str, Any]) -> None:
        """More that moves."""
        for k in range(20, 20 + int(self.rng.integers(2, 6))):
            mission["world"]["known"].append(self._mover(k))

    def _laps(self, mission: dict[str, Any]) -> None:
        if mission["route"].get("closed"):
            mission["route"]["laps"] = 4

    def _fast(self, mission: dict[str, Any]) -> None:
        """Fast along, slow up and down, and it turns slowly."""
        mission["robot"] |= {"max_speed_mps": 15.0, "max_climb_mps": 0.7, "max_descent_mps": 0.4,
                             "max_yaw_rate_dps": 15.0, "max_vertical_accel_mps2": 0.3}  # fmt: skip

    def _nearer(self, mission: dict[str, Any]) -> None:
        """A larger body among the same things."""
        mission["robot"]["radius_m"] = round(1.2 * mission["robot"]["radius_m"], 3)
