"""Sound missions in space that combine many keys at once, small enough to plan hundreds of them.

Each is what a mission file holds. A kind says what a mission has for sure (something that moves, a
terrain, voxels, gates, asked sides); everything else of the schema of missions in space is there by
chance. Places of the route keep away from what stands; what moves goes where it likes.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from strange_routes import route_of

FLIGHT_KINDS = (
    "town", "plant", "hills", "gates", "sides", "patrol", "moving", "unseen", "hidden",
)  # fmt: skip
SIDE_M, TOP_M = 60.0, 26.0
CUBE_M = 1.5
TERRAIN_CELL_M = 5.0


class StrangeFlights:
    """Draws missions of a kind.

    Args:
        rng: Where chance comes from.
        kind: One of ``FLIGHT_KINDS``.
        folder: Where files that missions name are written.
    """

    def __init__(self, rng: np.random.Generator, kind: str, folder: Path) -> None:
        self.rng, self.kind, self.folder = rng, kind, folder
        self.terrain: np.ndarray | None = None
        self.flat: float | None = None

    def draw(self) -> dict[str, Any]:
        """The next one."""
        robot, room = self._robot()
        world: dict[str, Any] = {}
        if self._is(0.8):
            world["bounds"] = [-15.0, -15.0, SIDE_M + 15.0, SIDE_M + 15.0]
        self._ground(world)
        points = self._points(4.0 + 2.0 * room, room)
        known, unseen = self._standing(points, room)
        if self.kind == "plant":
            known.append(self._voxels(points, room))
        if self.kind == "moving" or self._is(0.05):
            known += [self._mover(i) for i in range(int(self.rng.integers(1, 4)))]
        if self.kind == "hidden":
            unseen += [self._mover(10 + i) for i in range(int(self.rng.integers(1, 3)))]
            robot["moving"] = {"max_speed_mps": self._within(2, 4),
                               "safety": str(self.rng.choice(["passive", "none"]))}  # fmt: skip
        world["known"] = known
        if unseen:
            world["unseen"] = unseen
            robot["sensor"] = {"range_m": self._within(8, 30)}
        if self._is(0.2):
            world["speed_zones"] = [self._zone() for _ in range(int(self.rng.integers(1, 3)))]
        if self._is(0.15):
            edge = [[-14, -14], [SIDE_M + 14, -13], [SIDE_M + 13, SIDE_M + 14], [-13, SIDE_M + 13]]
            world["fences"] = [edge]
        route = self._route(points, room)
        self._altitude(world, points)
        return {"world": world, "robot": robot, "route": route, "spline": self._spline(route)}

    def _is(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def _within(self, low: float, high: float) -> float:
        return round(float(self.rng.uniform(low, high)), 3)

    def _robot(self) -> tuple[dict[str, Any], float]:
        """A robot, and what its body and clearance take about its place, with some room [m]."""
        robot: dict[str, Any] = {
            "radius_m": self._within(0.1, 0.9), "clearance_m": self._within(0.1, 2.0),
            "max_speed_mps": self._within(2, 10), "max_accel_mps2": self._within(1, 4),
        }  # fmt: skip
        for key, share, low, high in (
            ("half_height_m", 0.7, 0.05, 0.8), ("max_climb_mps", 0.7, 0.8, 4),
            ("max_descent_mps", 0.6, 0.6, 3), ("max_vertical_accel_mps2", 0.4, 0.4, 2),
            ("max_yaw_rate_dps", 0.6, 20, 120), ("max_lateral_accel_mps2", 0.3, 0.5, 3),
            ("max_brake_mps2", 0.2, 1, 4), ("max_jerk_mps3", 0.15, 1, 6),
            ("tracking_error_m", 0.15, 0, 0.4),
        ):  # fmt: skip
            if self._is(share):
                robot[key] = self._within(low, high)
        body = max(robot["radius_m"], robot.get("half_height_m", 0.0))
        return robot, 1.5 * body + robot["clearance_m"] + robot.get("tracking_error_m", 0) + 0.5

    def _ground(self, world: dict[str, Any]) -> None:
        """Flat ground, a terrain, or none."""
        if self.kind == "hills":
            count = round((SIDE_M + 40) / TERRAIN_CELL_M) + 1
            x, y = np.meshgrid(*2 * [np.linspace(-20, SIDE_M + 20, count)])
            heights = self._within(-30, 400) + self.rng.normal(0, 0.3, x.shape)
            for _ in range(3):
                a, b = self.rng.uniform(0, SIDE_M, 2)
                wide = self.rng.uniform(8, 25)
                bump = self.rng.uniform(-6, 12)
                heights += bump * np.exp(-((x - a) ** 2 + (y - b) ** 2) / wide**2)
            self.terrain = np.round(heights, 2)
            head = f"ncols {count}\nnrows {count}\nxllcenter -20\nyllcenter -20\n"
            head += f"cellsize {TERRAIN_CELL_M:g}\n"
            rows = "\n".join(" ".join(f"{h:.2f}" for h in row) for row in self.terrain[::-1])
            (self.folder / "hills.asc").write_text(head + rows + "\n", encoding="ascii")
            world["ground"] = {"terrain": "hills.asc"}
        elif self._is(0.75):
            self.flat = 0.0 if self._is(0.6) else self._within(-20, 200)
            world["ground"] = {"flat_m": self.flat}

    def _ground_at(self, x: float, y: float) -> float:
        if self.terrain is None:
            return self.flat or 0.0
        j = round((x + 20) / TERRAIN_CELL_M), round((y + 20) / TERRAIN_CELL_M)
        near = self.terrain[max(j[1] - 1, 0) : j[1] + 2, max(j[0] - 1, 0) : j[0] + 2]
        return float(near.max())

    def _points(self, apart: float, room: float) -> np.ndarray:
        """Places of the route, (n, 3) [m]."""
        count = int(self.rng.integers(2, 6)) + (self.kind == "patrol")
        found: list[np.ndarray] = []
        for _ in range(1000):
            x, y = self.rng.uniform(0, SIDE_M, 2)
            above = self.rng.uniform(room + 0.5, TOP_M)
            point = np.round([x, y, self._ground_at(x, y) + above], 2)
            if not found or np.linalg.norm(np.array(found) - point, axis=1).min() > apart:
                found.append(point)
            if len(found) == count:
                break
        return np.array(found)

    def _standing(self, points: np.ndarray, room: float) -> tuple[list, list]:
        """What stands on the map and beside it."""
        known: list[dict[str, Any]] = []
        unseen: list[dict[str, Any]] = []
        for number in range(int(self.rng.integers(2, 14))):
            at, size = self._place_of_thing(points), self._within(0.5, 6.0)
            shape, reach = self._shape(at, size)
            level = np.hypot(*(points[:, :2] - at[:2]).T)
            upright = reach.get("height", 0.0)
            if (np.hypot(np.maximum(level - reach["level"], 0.0),
                         np.maximum(np.abs(points[:, 2] - at[2]) - upright, 0.0)).min() < room
                    or (level[[0, -1]] < reach["level"] + room).any()):  # fmt: skip
                continue
            thing = {"name": f"thing {number}", **shape}
            if self.kind in ("unseen", "hidden") and self._is(0.5):
                unseen.append(thing)
                continue
            asks = 0.6 if self.kind == "sides" else 0.06
            if self._is(asks):
                sides = ["left", "right", "over"] + (["under"] if self._floats(shape) else [])
                key = "pass_on" if self._is(0.6) else "never_pass_on"
                if "height_m" not in shape and ("circle" in shape or "polygon" in shape):
                    sides, key = sides[:2], key
                thing[key] = str(self.rng.choice(sides))
            known.append(thing)
        return known, unseen

    @staticmethod
    def _floats(shape: dict[str, Any]) -> bool:
        return "ball" in shape or "box" in shape or "capsule" in shape or "height_m" in shape

    def _place_of_thing(self, points: np.ndarray) -> np.ndarray:
        """Somewhere, or near a straight line between two places of the route."""
        if self._is(0.3) or len(points) < 2:
            x, y = self.rng.uniform(0, SIDE_M, 2)
            return np.round([x, y, self._ground_at(x, y) + self.rng.uniform(0, TOP_M)], 2)
        leg = int(self.rng.integers(len(points) - 1))
        along = self.rng.uniform(0.15, 0.85)
        at = (1 - along) * points[leg] + along * points[leg + 1]
        return np.round(at + self.rng.normal(0, 1.5, 3), 2)

    def _shape(self, at: np.ndarray, size: float) -> tuple[dict[str, Any], dict[str, float]]:
        """A shape about a place, and how far it reaches from it [m]."""
        chance, turn = self.rng.random(), self.rng.uniform(0, math.tau)
        x, y, z = at.tolist()
        if chance < 0.15:
            return {"ball": {"center": [x, y, z], "radius": size}}, {"level": size, "height": size}
        if chance < 0.35:
            half = np.round(self.rng.uniform(0.3, 1, 3) * size, 2)
            box = {"min": np.round(at - half, 2).tolist(), "max": np.round(at + half, 2).tolist()}
            if self._is(0.6):
                box["yaw_deg"] = self._within(-180, 180)
            return {"box": box}, {"level": float(np.hypot(*half[:2])), "height": float(half[2])}
        if chance < 0.55:
            way = self.rng.normal(0, 1, 3)
            end = way / np.linalg.norm(way) * self.rng.uniform(1, 3) * size
            ends = {"from": np.round(at - end, 2).tolist(), "to": np.round(at + end, 2).tolist()}
            reach = {"level": float(np.hypot(*end[:2])) + 0.5, "height": abs(float(end[2])) + 0.5}
            return {"capsule": {**ends, "radius": self._within(0.02, 0.5)}}, reach
        heights: dict[str, Any] = {}
        upright = math.inf
        if self._is(0.85):
            ground = self._ground_at(x, y)
            low = ground - 2.0 if self._is(0.7) else z - self._within(0.5, 4)
            heights = {"height_m": [round(low, 2), round(z + self._within(0.3, 6), 2)]}
            upright = max(heights["height_m"][1] - z, z - low)
        if chance < 0.7:
            return ({"circle": {"center": [x, y], "radius": size}, **heights},
                    {"level": size, "height": upright})  # fmt: skip
        angles = turn + np.linspace(0, math.tau, int(self.rng.integers(3, 8)), endpoint=False)
        reach = size * self.rng.uniform(0.5, 1, len(angles)) if self._is(0.5) else size
        corners = at[:2] + (reach * np.array([np.cos(angles), np.sin(angles)])).T
        return ({"polygon": np.round(corners, 3).tolist(), **heights},
                {"level": size, "height": upright})  # fmt: skip

    def _voxels(self, points: np.ndarray, room: float) -> dict[str, Any]:
        """Random cubes, a few rows of them, free about the places of the route."""
        shape = (round(SIDE_M / CUBE_M), round(SIDE_M / CUBE_M), round(TOP_M / CUBE_M))
        base = self._ground_at(*points[0, :2])
        blocked = self.rng.random(shape) < self.rng.uniform(0.001, 0.01)
        for _ in range(int(self.rng.integers(1, 5))):  # walls, pipes and blocks
            low = self.rng.integers(0, shape)
            size = np.where(self.rng.random(3) < 0.4, self.rng.integers(4, 16, 3), 1)
            blocked[tuple(slice(a, a + b) for a, b in zip(low, size, strict=True))] = True
        middles = CUBE_M * (np.argwhere(blocked) + 0.5) + [0, 0, base]
        apart = np.linalg.norm(middles[:, None] - points[None], axis=2).min(axis=1)
        ends = np.hypot(*(middles[:, None, :2] - points[None, [0, -1], :2]).T).min(axis=0)
        cubes = np.argwhere(blocked)[(apart > room + 1.5 * CUBE_M) & (ends > room + 1.5 * CUBE_M)]
        rows = "\n".join(" ".join(map(str, cube)) for cube in cubes.tolist())
        text = f"voxel {shape[0]} {shape[1]} {shape[2]}\n{rows}\n"
        (self.folder / "plant.3dmap").write_text(text, encoding="ascii")
        voxels = {"file": "plant.3dmap", "cell_m": CUBE_M, "origin_m": [0, 0, round(base, 2)]}
        return {"name": "plant", "voxels": voxels}

    def _mover(self, number: int) -> dict[str, Any]:
        """Something that moves in space, its shape about 0, 0, 0."""
        shape, _ = self._shape(np.zeros(3), self._within(0.3, 1.5))
        if "height_m" in shape:
            shape["height_m"] = [-self._within(0.3, 4), self._within(0.3, 4)]
        thing = {"name": f"mover {number}", **shape}
        base = self._ground_at(*2 * [0.5 * SIDE_M])

        def place() -> np.ndarray:
            x, y = self.rng.uniform(0, SIDE_M, 2)
            return np.round([x, y, base + self.rng.uniform(0, TOP_M)], 2)

        if self._is(0.4):
            speed = self.rng.uniform(-1, 1, 3) * [1, 1, 0.4]
            motion: dict[str, Any] = {"from": place().tolist(),
                                      "velocity_mps": np.round(speed, 2).tolist()}  # fmt: skip
        else:
            t, at, frames = 0.0, place(), []
            turns = self._is(0.3)
            for _ in range(int(self.rng.integers(2, 5))):
                heading = self._within(0, 360) if turns else 0
                x, y, z = at.tolist()
                frames.append([round(t, 2), x, y, heading, z])
                to = place()
                t += math.dist(at, to) / self.rng.uniform(0.5, 2.0) + 0.5
                at = to
            after = str(self.rng.choice(["bounce", "stay", "vanish", "loop"]))
            motion = {"keyframes": frames, "after": after}
        if self._is(0.15):
            motion["error"] = {"position_m": 0.1, "growth_mps": 0.005}
        return {**thing, "motion": motion}

    def _zone(self) -> dict[str, Any]:
        low, size = self.rng.uniform(0, SIDE_M, 2), self.rng.uniform(3, 20, 2)
        (a, b), (c, d) = np.round(low, 2).tolist(), np.round(low + size, 2).tolist()
        return {"polygon": [[a, b], [c, b], [c, d], [a, d]], "max_speed_mps": self._within(0.5, 3)}

    def _route(self, points: np.ndarray, room: float) -> dict[str, Any]:
        return route_of(self, points, room)

    def _altitude(self, world: dict[str, Any], points: np.ndarray) -> None:
        """A band that has room for all places of the route."""
        if not self._is(0.5):
            return
        above = str(self.rng.choice(["home", "ground", "amsl"] if "ground" in world else ["home"]))
        grounds = np.array([self._ground_at(x, y) for x, y, _ in points])
        zero = {"home": grounds[0], "ground": grounds, "amsl": 0.0}[above]
        slack = 13.0 if self.terrain is not None else 0.0
        high = float((points[:, 2] - zero).max()) + slack + self._within(0.5, 12)
        band: dict[str, Any] = {"max_m": round(high, 2), "above": above}
        if self._is(0.5):
            low = float((points[:, 2] - zero).min()) - slack - self._within(0.5, 6)
            band["min_m"] = round(low, 2)
        world["altitude"] = band

    def _spline(self, route: dict[str, Any]) -> dict[str, Any]:
        spline: dict[str, Any] = {}
        if self._is(0.3):
            spline["tension"] = self._within(-0.4, 0.9)
        if self._is(0.2):
            spline["knots"] = str(self.rng.choice(["uniform", "centripetal", "chordal"]))
        if self._is(0.1):
            spline["tangents"] = str(self.rng.choice(["cardinal", "continuous"]))
        return spline
