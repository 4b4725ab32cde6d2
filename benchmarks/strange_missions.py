"""Sound missions that combine many keys at once: short drives of every kind of robot.

Each is what a mission file holds. A kind says what a mission has for sure (something that moves, a
corridor, a map of squares); everything else of the schema of missions in the plane is there by
chance. Places of the route have room for the body, and obstacles that stand keep away from them;
what moves goes where it likes.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from random_drives import ROBOTS

KINDS = (
    "plain", "circle", "machine", "unseen", "lidar", "moving", "hidden", "corridor", "map",
    "rounds",
)  # fmt: skip
SIDE_M = 18.0
"""Side of the square in which they drive."""

MAP_CELL_M = 0.5

MORE_ROBOTS: dict[str, dict[str, Any]] = {
    "skid-steer": {
        "footprint": [[-0.5, -0.35], [0.5, -0.35], [0.5, 0.35], [-0.5, 0.35]],
        "clearance_m": 0.15,
        "drive": {"skid_steer": {"track_m": 0.6, "slip": 0.2, "max_wheel_speed_mps": 2},
                  "delay_s": 0.1, "lag_s": 0.1},
    },
    "held heading": {
        "radius_m": 0.5, "clearance_m": 0.15,
        "drive": {"omnidirectional": {"max_speed_along_mps": 1.5, "max_speed_across_mps": 1.0,
                                      "hold_heading_deg": 30}},
    },
    "footprint, circle": {
        "footprint": [[-0.3, -0.35], [1.0, -0.35], [1.0, 0.35], [-0.3, 0.35]], "clearance_m": 0.15,
        "min_turn_radius_m": 1.0,
    },
}  # fmt: skip
ALL_ROBOTS = {**ROBOTS, **MORE_ROBOTS}
CIRCLES = ("turning circle", "steered", "footprint, steered", "footprint, circle")


class StrangeMissions:
    """Draws missions of a kind.

    Args:
        rng: Where chance comes from.
        kind: One of ``KINDS``.
        folder: Where files that missions name are written.
    """

    def __init__(self, rng: np.random.Generator, kind: str, folder: Path) -> None:
        self.rng, self.kind, self.folder = rng, kind, folder

    def draw(self) -> dict[str, Any]:
        """The next one."""
        robot, room = self._robot()
        points = self._points(3.0 + 2.0 * room)
        world: dict[str, Any] = {"bounds": [-6.0, -6.0, SIDE_M + 6.0, SIDE_M + 6.0]}
        known, unseen = self._standing(points, room)
        if self.kind == "map":
            known = [self._map(points, room)]
            del world["bounds"]
        if self.kind == "moving" or (self.kind != "corridor" and self._is(0.08)):
            known += [self._mover(i) for i in range(int(self.rng.integers(1, 5)))]
        if self.kind == "hidden":
            unseen += [self._mover(10 + i) for i in range(int(self.rng.integers(1, 4)))]
            if self._is(0.7):
                safety = "passive" if self._is(0.7) else "none"
                robot["moving"] = {"max_speed_mps": self._within(0.8, 2), "safety": safety}
        world["known"] = known
        if unseen and "sensor" in robot:
            world["unseen"] = unseen
        if self._is(0.3):
            world["speed_zones"] = [self._zone() for _ in range(int(self.rng.integers(1, 4)))]
        if self._is(0.15) and self.kind != "map":
            edge = [[-4, -5], [SIDE_M + 5, -4], [SIDE_M + 4, SIDE_M + 5], [-5, SIDE_M + 4]]
            world["fences"] = [edge]
        route = self._route(points, robot)
        count = len(points) if route.get("closed") else len(points) - 1
        return {"world": world, "robot": robot, "route": route, "spline": self._spline(count)}

    def _is(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def _within(self, low: float, high: float) -> float:
        return round(float(self.rng.uniform(low, high)), 3)

    def _robot(self) -> tuple[dict[str, Any], float]:
        """A robot, and what its body and clearance take about its place, with some room [m]."""
        names: tuple[str, ...] = tuple(ALL_ROBOTS)
        if self.kind == "circle":
            names = CIRCLES
        if self.kind == "machine":
            names = tuple(name for name, keys in ALL_ROBOTS.items() if "drive" in keys)
        if self.kind == "map":
            names = ("point", "radius", "differential", "footprint")
        robot: dict[str, Any] = {"max_speed_mps": self._within(0.8, 2), "max_accel_mps2": 1.0}
        robot |= ALL_ROBOTS[str(self.rng.choice(names))]
        robot["clearance_m"] = self._within(0.02, 0.4)
        for key, share, low, high in (
            ("prefer_clearance_m", 0.2, 0.05, 0.6), ("max_brake_mps2", 0.2, 0.5, 2),
            ("max_accel_mps2", 0.3, 0.4, 2), ("max_lateral_accel_mps2", 0.3, 0.4, 1.5),
            ("max_yaw_rate_degps", 0.25, 20, 90), ("max_yaw_accel_degps2", 0.1, 40, 120),
            ("max_jerk_mps3", 0.25, 0.5, 3),
        ):  # fmt: skip
            if self._is(share):
                robot[key] = self._within(low, high)
        if "drive" not in robot and self._is(0.15):
            robot["tracking_error_m"] = self._within(0, 0.1)
        if "drive" in robot and self._is(0.3):
            noise = {"position_noise_m": 0.01, "heading_noise_deg": 0.5}
            robot["localization"] = noise
        if self.kind in ("unseen", "lidar", "hidden") or self._is(0.3):
            robot["sensor"] = self._sensor()
        if "sensor" in robot and self._is(0.1):
            robot["max_replan_s"] = self._within(0.2, 2)
        body = max((math.hypot(*at) for at in robot.get("footprint", ())), default=0.0)
        return robot, max(body, robot.get("radius_m", 0.0)) + robot["clearance_m"] + 0.5

    def _sensor(self) -> dict[str, Any]:
        if self.kind != "lidar" and self._is(0.5):
            sensor: dict[str, Any] = {"range_m": self._within(2, 8)}
            if self.kind == "hidden" and self._is(0.5):
                sensor["velocity_noise_mps"] = 0.1
            return sensor
        lidar = {"range_m": self._within(3, 8), "fov_deg": float(self.rng.choice([180, 270, 360]))}
        if self._is(0.3):
            lidar |= {"noise_m": 0.01, "beams": 720}
        return {"lidar": lidar}

    def _points(self, apart: float) -> np.ndarray:
        """Places of the route, (n, 2) [m]."""
        count = int(self.rng.integers(2, 5)) + (self.kind == "rounds")
        points = [self.rng.uniform(0, SIDE_M, 2)]
        for _ in range(1000):
            point = self.rng.uniform(0, SIDE_M, 2)
            if np.hypot(*(np.array(points) - point).T).min() > apart:
                points.append(point)
            if len(points) == count:
                break
        return np.round(points, 2)

    def _standing(self, points: np.ndarray, room: float) -> tuple[list, list]:
        """What stands on the map and beside it."""
        known: list[dict[str, Any]] = []
        unseen: list[dict[str, Any]] = []
        for number in range(int(self.rng.integers(2, 11))):
            at, size = self._place_of_thing(points), self._within(0.2, 2.2)
            if np.hypot(*(points - at).T).min() < size + room:
                continue
            thing = {"name": f"thing {number}", **self._shape(at, size)}
            hides = 0.6 if self.kind in ("unseen", "lidar") else 0.2
            if self._is(hides):
                unseen.append(thing)
                continue
            if self._is(0.15) and self.kind != "corridor":
                side = "left" if self._is(0.5) else "right"
                thing["pass_on" if self._is(0.6) else "never_pass_on"] = side
            known.append(thing)
        return known, unseen

    def _place_of_thing(self, points: np.ndarray) -> np.ndarray:
        """Somewhere, or near a straight line between two places of the route."""
        if self._is(0.4):
            return np.round(self.rng.uniform(0, SIDE_M, 2), 2)
        leg = int(self.rng.integers(len(points) - 1))
        along = self.rng.uniform(0.15, 0.85)
        at = (1 - along) * points[leg] + along * points[leg + 1]
        return np.round(at + self.rng.normal(0, 1, 2), 2)

    def _shape(self, at: np.ndarray, size: float) -> dict[str, Any]:
        chance = self.rng.random()
        if chance < 0.4:
            return {"circle": {"center": at.tolist(), "radius": size}}
        turn = self.rng.uniform(0, math.tau)
        if chance < 0.6:
            end = 0.8 * size * np.array([math.cos(turn), math.sin(turn)])
            ends = {"from": np.round(at - end, 3).tolist(), "to": np.round(at + end, 3).tolist()}
            return {"capsule": {**ends, "radius": round(0.2 * size, 3)}}
        angles = turn + np.linspace(0, math.tau, int(self.rng.integers(3, 8)), endpoint=False)
        reach = size * self.rng.uniform(0.5, 1, len(angles)) if chance < 0.8 else size
        corners = at + (reach * np.array([np.cos(angles), np.sin(angles)])).T
        return {"polygon": np.round(corners, 3).tolist()}

    def _map(self, points: np.ndarray, room: float) -> dict[str, Any]:
        """A map of random squares, free about the places of the route."""
        count = round(SIDE_M / MAP_CELL_M)
        middles = MAP_CELL_M * (np.arange(count) + 0.5)
        x, y = np.meshgrid(middles, middles)
        blocked = self.rng.random((count, count)) < self.rng.uniform(0.005, 0.05)
        for a, b in points:
            blocked &= np.hypot(x - a, y - b) > room + MAP_CELL_M
        np.clip(points, 2.0 * room, SIDE_M - 2.0 * room, out=points)
        for a, b in points:
            blocked &= np.hypot(x - a, y - b) > room + MAP_CELL_M
        rows = ["".join("@" if cell else "." for cell in row) for row in blocked[::-1]]
        head = f"type octile\nheight {count}\nwidth {count}\nmap\n"
        (self.folder / "squares.map").write_text(head + "\n".join(rows) + "\n", encoding="ascii")
        return {"map": "squares.map", "resolution_m": MAP_CELL_M}

    def _mover(self, number: int) -> dict[str, Any]:
        """Something that moves, its shape about 0, 0."""
        thing = {"name": f"mover {number}", **self._shape(np.zeros(2), self._within(0.2, 0.6))}
        if self._is(0.4):
            at = self.rng.uniform(0, SIDE_M, 2)
            speed = self.rng.uniform(-0.5, 0.5, 2)
            motion: dict[str, Any] = {"from": np.round(at, 2).tolist(),
                                      "velocity_mps": np.round(speed, 2).tolist()}  # fmt: skip
        else:
            t, at, frames = 0.0, self.rng.uniform(0, SIDE_M, 2), []
            turns = self._is(0.3)
            for _ in range(int(self.rng.integers(2, 5))):
                heading = [self._within(0, 360)] if turns else []
                frames.append([round(t, 2), *np.round(at, 2).tolist(), *heading])
                to = self.rng.uniform(0, SIDE_M, 2)
                t += math.dist(at, to) / self.rng.uniform(0.3, 1.0) + 0.5
                at = to
            after = str(self.rng.choice(["bounce", "stay", "vanish", "bounce"]))
            motion = {"keyframes": frames, "after": after}
        if self._is(0.15):
            motion["error"] = {"position_m": 0.05, "growth_mps": 0.005}
        return {**thing, "motion": motion}

    def _zone(self) -> dict[str, Any]:
        low, size = self.rng.uniform(0, SIDE_M, 2), self.rng.uniform(1, 6, 2)
        (a, b), (c, d) = np.round(low, 2).tolist(), np.round(low + size, 2).tolist()
        return {"polygon": [[a, b], [c, b], [c, d], [a, d]], "max_speed_mps": self._within(0.2, 1)}

    def _route(self, points: np.ndarray, robot: dict[str, Any]) -> dict[str, Any]:
        places: list[dict[str, Any]] = [{"at": point.tolist()} for point in points]
        for place in places[1:]:
            if self._is(0.25):
                place["dwell_s"] = 2.0
        if self._is(0.25):
            places[0]["heading_deg"] = self._within(-180, 180)
        route: dict[str, Any] = {"start": places[0]}
        closed = self.kind == "rounds" or self._is(0.1)
        if closed and len(places) > 2:
            route |= {"via": places[1:], "closed": True}
            if self._is(0.7):
                route["laps"] = int(self.rng.integers(1, 3))
        else:
            if self._is(0.25):
                places[-1]["heading_deg"] = self._within(-180, 180)
            route |= {"via": places[1:-1], "goal": places[-1]}
        if self.kind == "corridor":
            wide = robot["clearance_m"] + 1.6
            route["corridor"] = {side: self._within(wide, 4) for side in ("left_m", "right_m")}
        if self._is(0.3):
            route["optimise"] = "length"
        if self._is(0.3):
            route["detours"] = "local" if self._is(0.5) else "short"
        if self.kind in ("moving", "hidden") and self._is(0.3):
            route |= {"depart_s": self._within(0, 5), "hold_s": self._within(0, 5)}
        return route

    def _spline(self, spans: int) -> dict[str, Any]:
        spline: dict[str, Any] = {}
        if self._is(0.4):
            each = self._is(0.4)
            tension = [self._within(-0.6, 1) for _ in range(spans)]
            spline["tension"] = tension if each else tension[0]
        elif self._is(0.05):
            spline["tension"] = "auto"
        if self._is(0.3):
            spline["knots"] = str(self.rng.choice(["uniform", "centripetal", "chordal"]))
        if self._is(0.25):
            spline["tangents"] = str(self.rng.choice(["cardinal", "continuous"]))
        return spline
