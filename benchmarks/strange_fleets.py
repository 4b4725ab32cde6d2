"""Sound fleets that combine many keys at once, in the plane and in space, mostly of few robots.

Each is what a fleet's file holds; some robots have their mission in a file of its own. A kind says
how robots are laid out (swapped places, a corridor with bays, a crowd, drones in columns) and what
is there for sure (things that move, patrols that never end); everything else is there by chance.
Starts keep away from each other, and so do goals at which robots stay: anything else is a fault.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from strange_flights import TOP_M, StrangeFlights
from strange_missions import CIRCLES, StrangeMissions

PLANAR = (
    "mixed", "swapped", "ring", "corridor", "machines", "rounds", "patrols", "moving", "on goals",
    "one", "crowd",
)  # fmt: skip
FLYING = (
    "town", "columns", "swapped flights", "hills", "plant", "patrol flights", "moving flights",
    "flock",
)  # fmt: skip
FLEET_KINDS = (*PLANAR, *FLYING)
STATES = {"hills": "hills", "plant": "plant"}
"""Kinds of flights whose worlds some kinds of fleets have."""


class StrangeFleets:
    """Draws fleets of a kind.

    Args:
        rng: Where chance comes from.
        kind: One of ``FLEET_KINDS``.
        folder: Where files that fleets name are written.
    """

    def __init__(self, rng: np.random.Generator, kind: str, folder: Path) -> None:
        self.rng, self.kind, self.folder = rng, kind, folder
        self.flies = kind in FLYING
        if self.flies:
            self.draws: Any = StrangeFlights(rng, STATES.get(kind, "town"), folder)
        else:
            names = {"moving": "moving", "machines": "machine"}
            self.draws = StrangeMissions(rng, names.get(kind, "plain"), folder)
        self.side = {"crowd": 60.0, "flock": 90.0}.get(kind, 40.0 if self.flies else 24.0)

    def draw(self) -> dict[str, Any]:
        """The next one."""
        robots, room = self._kinds()
        apart = self._within(0.0, 1.5) if self._is(0.8) else 0.0
        world: dict[str, Any] = {}
        if self.flies:
            self.draws._ground(world)
        spread = 2.0 * room + apart + 0.3
        count = self._count()
        starts, goals = self._ends(count, spread, room, world)
        names = list(robots)
        members = [
            self._member(k, starts[k], goals[k], str(self.rng.choice(names)), robots, room)
            for k in range(count)
        ]
        points = np.vstack([starts, goals, *(m.pop("between") for m in members)])
        self._fill(world, points, room)
        data = {"world": world, "separation_m": apart, "robots": robots, "fleet": members}
        if self._is(0.2):
            data["spline"] = {"tension": self._within(0, 0.8)}
        return data

    def files(self, data: dict[str, Any]) -> dict[str, Any]:
        """The same, with the missions of some robots in files of their own."""
        members = []
        for one in data["fleet"]:
            if not self._is(0.25):
                members.append(one)
                continue
            mission = {"route": one["route"], "robot": data["robots"][one["robot"]]}
            if "spline" in data or "spline" in one:
                mission["spline"] = one.get("spline", data.get("spline"))
            if self._is(0.5):
                mission["world"] = data["world"]
            file = f"{one['name']}.yaml"
            (self.folder / file).write_text(json.dumps(mission), encoding="utf-8")
            rest = {key: one[key] for key in one if key not in ("route", "robot", "spline")}
            members.append({**rest, "mission": file})
        return {**data, "fleet": members}

    def _is(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def _within(self, low: float, high: float) -> float:
        return round(float(self.rng.uniform(low, high)), 3)

    def _count(self) -> int:
        low, high = {"crowd": (15, 45), "flock": (10, 25), "one": (1, 2)}.get(self.kind, (2, 8))
        return int(self.rng.integers(low, high))

    def _kinds(self) -> tuple[dict[str, Any], float]:
        """Kinds of robots by name, and the most that a body and its clearance take [m]."""
        many = 1 if self.kind in ("crowd", "flock") else int(self.rng.integers(1, 4))
        drawn = [self._kind() for _ in range(many)]
        room = max(room for _, room in drawn) - 0.5
        if self.kind == "corridor":
            robot = {"radius_m": self._within(0.2, 0.45), "clearance_m": self._within(0.0, 0.1),
                     "max_speed_mps": self._within(0.8, 2), "max_accel_mps2": 1.0}  # fmt: skip
            return {"cart": robot}, 0.55
        return {f"kind {k}": robot for k, (robot, _) in enumerate(drawn)}, room

    def _kind(self) -> tuple[dict[str, Any], float]:
        while True:
            robot, room = self.draws._robot()
            robot.pop("sensor", None)
            robot.pop("max_replan_s", None)
            if self.kind in ("crowd", "ring") and "footprint" in robot:
                continue
            if self.kind == "crowd" and {"drive", "min_turn_radius_m"} & robot.keys():
                continue
            return robot, room

    def _place(self, room: float) -> np.ndarray:
        x, y = self.rng.uniform(0, self.side, 2)
        if not self.flies:
            return np.round([x, y], 2)
        above = self.rng.uniform(room + 0.5, TOP_M)
        return np.round([x, y, self.draws._ground_at(x, y) + above], 2)

    def _apart(self, count: int, spread: float, room: float) -> np.ndarray:
        """Places, each so far in plan from the others [m]."""
        found: list[np.ndarray] = []
        for _ in range(10_000):
            place = self._place(room)
            if not found or np.hypot(*(np.array(found) - place)[:, :2].T).min() > spread:
                found.append(place)
            if len(found) == count:
                return np.array(found)
        self.side *= 1.3
        return self._apart(count, spread, room)

    def _ends(
        self, count: int, spread: float, room: float, world: dict[str, Any]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Starts and goals of all robots."""
        if self.kind == "corridor":
            return self._corridor(count, spread, world)
        starts = self._apart(count, spread, room)
        if self.kind in ("swapped", "swapped flights", "on goals"):
            order = self.rng.permutation(count)
            if self.kind == "on goals":
                goals = self._apart(count, spread, room)
                goals[order[: count // 2]] = starts[order[-(count // 2) :]]
                for k in range(count):
                    if any(math.dist(goals[k][:2], goals[j][:2]) <= spread for j in range(k)):
                        goals[k] = starts[k] + 0.3
                return starts, goals
            return starts, starts[order]
        if self.kind == "ring":
            turn = np.linspace(0, math.tau, count, endpoint=False)
            radius = max(spread / (2 * math.sin(math.pi / max(count, 2))) * 1.02, 2.0)
            starts = np.column_stack([np.cos(turn), np.sin(turn)]) * radius + 0.5 * self.side
            starts = np.round(starts, 2)
            return starts, np.roll(starts, -int(self.rng.integers(1, max(count, 2))), axis=0)
        if self.kind == "columns":
            return self._columns(count, spread, room)
        return starts, self._apart(count, spread, room)

    def _columns(self, count: int, spread: float, room: float) -> tuple[np.ndarray, np.ndarray]:
        """Drones above each other that cross over and under each other."""
        step = spread + self._within(0.0, 2.0)
        heights = room + 1.0 + step * np.arange(count)
        middle = 0.5 * self.side
        turn = self.rng.uniform(0, math.tau, count)
        way = np.column_stack([np.cos(turn), np.sin(turn)]) * self.rng.uniform(8, 18)
        base = self.draws._ground_at(middle, middle)
        starts = np.column_stack([middle + way, base + heights])
        ends = np.column_stack([middle - way, base + self.rng.permutation(heights)])
        return np.round(starts, 2), np.round(ends, 2)

    def _corridor(
        self, count: int, spread: float, world: dict[str, Any]
    ) -> tuple[np.ndarray, np.ndarray]:
        """A corridor with bays; some go east, the others west."""
        wide = self._within(1.3, 2.6)
        long = spread * (2 * count + 3) + 8.0
        known, bays = [], np.sort(self.rng.uniform(6.0, long - 6.0, int(self.rng.integers(1, 4))))
        left = -1.0
        for k, bay in enumerate([*bays.tolist(), None]):
            right = long + 1.0 if bay is None else bay - 1.6
            if right > left + 0.3:
                corners = [[left, wide], [right, wide], [right, wide + 3.5], [left, wide + 3.5]]
                known.append({"name": f"wall {k}", "polygon": np.round(corners, 3).tolist()})
            left = left if bay is None else bay + 1.6
        world |= {"bounds": [-1.0, 0.0, round(long + 1.0, 2), round(wide + 3.5, 2)], "known": known}
        y = 0.5 * wide
        east = int(self.rng.integers(1, count)) if count > 1 else 1
        x = [1.0 + spread * k for k in range(east)]
        x += [long - 1.0 - spread * k for k in range(count - east)]
        to = [long - 1.0 - spread * k for k in range(east)][::-1]
        to += [1.0 + spread * k for k in range(count - east)][::-1]
        level = np.full(count, y)
        return np.round(np.column_stack([x, level]), 2), np.round(np.column_stack([to, level]), 2)

    def _member(
        self, k: int, start: np.ndarray, goal: np.ndarray, kind: str, robots: dict[str, Any],
        room: float,
    ) -> dict[str, Any]:  # fmt: skip
        """A robot with its route."""
        many = int(self.rng.integers(0, 3)) if self.kind not in ("corridor", "columns") else 0
        between = [self._place(room) for _ in range(many)]
        closed = {"rounds": 0.8, "patrols": 0.6, "patrol flights": 0.5}.get(self.kind, 0.08)
        closed = 0.0 if self.kind in ("corridor", "ring", "columns") else closed
        route: dict[str, Any] = {"start": self._point(start)}
        if self._is(closed):
            between = between or [self._place(room)]
            route |= {"via": [self._point(one) for one in between], "closed": True}
            if not (self.kind in ("patrols", "patrol flights") and self._is(0.6)):
                route["laps"] = int(self.rng.integers(1, 4))
        else:
            route |= {"via": [self._point(one) for one in between], "goal": self._point(goal)}
        self._begin_and_end(route, start, goal)
        robot = robots[kind]
        if not self.flies and not robot.get("min_turn_radius_m") and self._is(0.2):
            route["start"]["heading_deg"] = self._within(-180, 180)
        if self._is(0.15):
            route["optimise"] = "length"
        member: dict[str, Any] = {"name": f"r{k}", "robot": kind, "route": route}
        if self._is(0.4):
            member["priority"] = float(self.rng.integers(-1, 3))
        if self._is(0.3):
            member["depart_s"] = self._within(0, 25)
        stays = 0.15 if self.kind in ("patrols", "patrol flights") else 0.7
        member["rest"] = "stay" if self._is(stays) else "leave"
        if self._is(0.15):
            member["spline"] = {"tension": self._within(-0.4, 1)}
        return {**member, "between": np.array(between).reshape(-1, len(start))}

    def _point(self, at: np.ndarray) -> dict[str, Any]:
        point: dict[str, Any] = {"at": at.tolist()}
        if self._is(0.15):
            point["dwell_s"] = self._within(0.5, 8)
        return point

    def _begin_and_end(self, route: dict[str, Any], start: np.ndarray, goal: np.ndarray) -> None:
        """Take-offs and landings, where there is ground."""
        draws = self.draws
        if not self.flies or (draws.flat is None and draws.terrain is None):
            return
        if self._is(0.4):
            x, y, z = start.tolist()
            base = draws.flat or 0.0 if draws.terrain is None else draws._ground_at(x, y)
            route["start"] = {"at": [x, y]}
            route["takeoff"] = {"to_agl_m": round(max(z - base, 3.0), 2)}
        if "goal" in route and self._is(0.4):
            del route["goal"]
            route["land"] = {"at": goal[:2].tolist()}

    def _fill(self, world: dict[str, Any], points: np.ndarray, room: float) -> None:
        """What stands and moves, bounds and zones."""
        if self.kind == "corridor":
            return
        low, high = points[:, :2].min(axis=0) - 8.0, points[:, :2].max(axis=0) + 8.0
        if self._is(0.7):
            world["bounds"] = np.round([*low, *high], 2).tolist()
        known = self._standing(points, room)
        if self.kind == "plant":
            known.append(self.draws._voxels(points, room))
        if self.kind in ("moving", "moving flights"):
            known += [self.draws._mover(k) for k in range(int(self.rng.integers(1, 4)))]
        world["known"] = known
        if self._is(0.2):
            world["speed_zones"] = [self.draws._zone()]
        if self.flies and self._is(0.4):
            ground = self.draws._ground_at(*points[0, :2])
            top = float(points[:, 2].max()) - (ground if "ground" in world else 0.0)
            world["altitude"] = {"max_m": round(top + self._within(2, 20), 2), "above": "home"}

    def _standing(self, points: np.ndarray, room: float) -> list[dict[str, Any]]:
        """What stands, clear of all places of all routes and of columns above and under them."""
        known = []
        most = {"ring": 3, "crowd": 20, "flock": 20}.get(self.kind, 9)
        for number in range(int(self.rng.integers(0, most))):
            at, size = self._place(room), self._within(0.3, 2.5)
            if self.flies:
                shape, reach = self.draws._shape(at, 1.5 * size)
                wide = reach["level"]
            else:
                shape, wide = self.draws._shape(at, size), size
            if np.hypot(*(points - at)[:, :2].T).min() > wide + room + 0.3:
                known.append({"name": f"thing {number}", **shape})
        return known


def drawn_robots(data: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """The mission of each robot as it would stand in a file, by name."""
    found = {}
    for one in data["fleet"]:
        route = dict(one["route"])
        if "depart_s" in one:
            route["depart_s"] = one["depart_s"]
        spline = one.get("spline", data.get("spline", {}))
        found[one["name"]] = {
            "world": {"known": [], **data["world"]}, "robot": data["robots"][one["robot"]],
            "route": {"via": [], **route}, "spline": spline,
        }  # fmt: skip
    return found


__all__ = ["CIRCLES", "FLEET_KINDS", "FLYING", "PLANAR", "StrangeFleets", "drawn_robots"]
