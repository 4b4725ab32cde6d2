"""What a mission in space asks for, told without the planner: places, distances, ground, band.

Distances are formulas of their own in numpy: an upright cylinder or a ball beside prisms, turned
boxes, balls, cables, cubes and the columns of a terrain. Nothing of the planner is imported.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from strange_oracle import Faults, polygon_of, pose_of_mover

__all__ = ["AskedFlight", "Faults"]
CHUNK = 2000


@dataclass(frozen=True)
class Upright:
    """The body: an upright cylinder, with what a ball's radius adds to all sides [m]."""

    radius: float
    half: float
    margin: float

    @classmethod
    def of(cls, robot: dict[str, Any]) -> Upright:
        radius = float(robot.get("radius_m", 0.5))
        if "half_height_m" in robot:
            return cls(radius, float(robot["half_height_m"]), 0.0)
        return cls(0.0, 0.0, radius)

    def free(self, level: np.ndarray, upright: np.ndarray) -> np.ndarray:
        """Free space where a thing is so far off in plan and in height [m]; below 0: touched."""
        level = np.maximum(level - self.radius, 0.0)
        return np.hypot(level, np.maximum(upright - self.half, 0.0)) - self.margin


@dataclass(frozen=True)
class Terrain:
    """Heights at nodes, as the file has them.

    Attributes:
        heights: (ny, nx) [m], the southmost row first.
        x, y: Of the first node [m].
        cell: From node to node [m].
    """

    heights: np.ndarray
    x: float
    y: float
    cell: float

    @classmethod
    def read(cls, file: Path) -> Terrain:
        lines = file.read_text(encoding="ascii").splitlines()
        keys = {name: float(value) for name, value in (line.split() for line in lines[:5])}
        heights = np.array([line.split() for line in lines[5:]], float)[::-1]
        return cls(heights, keys["xllcenter"], keys["yllcenter"], keys["cellsize"])

    def at(self, places: np.ndarray) -> np.ndarray:
        """Bilinear heights [m]; nan beyond the edge."""
        ny, nx = self.heights.shape
        u, v = (places[:, 0] - self.x) / self.cell, (places[:, 1] - self.y) / self.cell
        inside = (u >= 0) & (v >= 0) & (u <= nx - 1) & (v <= ny - 1)
        i = np.clip(u.astype(int), 0, nx - 2)
        j = np.clip(v.astype(int), 0, ny - 2)
        a, b, h = u - i, v - j, self.heights
        low = (1 - a) * h[j, i] + a * h[j, i + 1]
        high = (1 - a) * h[j + 1, i] + a * h[j + 1, i + 1]
        return np.where(inside, (1 - b) * low + b * high, np.nan)

    def free(self, places: np.ndarray, body: Upright) -> np.ndarray:
        """Of a body from its columns, and from where nothing is known [m]."""
        h = self.heights
        tops = np.maximum.reduce([h[:-1, :-1], h[1:, :-1], h[:-1, 1:], h[1:, 1:]]).ravel()
        ny, nx = h.shape
        j, i = (one.ravel() for one in np.mgrid[: ny - 1, : nx - 1])
        half = 0.5 * self.cell
        middle = np.column_stack([self.x + (2 * i + 1) * half, self.y + (2 * j + 1) * half])
        least = np.full(len(places), np.inf)
        for k in range(0, len(places), CHUNK):
            at = places[k : k + CHUNK]
            off = np.maximum(np.abs(at[:, None, :2] - middle) - half, 0.0)
            level = np.hypot(off[..., 0], off[..., 1])
            least[k : k + CHUNK] = body.free(level, at[:, None, 2] - tops).min(axis=1)
        edge = np.minimum.reduce([
            places[:, 0] - self.x, self.x + (nx - 1) * self.cell - places[:, 0],
            places[:, 1] - self.y, self.y + (ny - 1) * self.cell - places[:, 1],
        ])  # fmt: skip
        return np.minimum(least, body.free(np.maximum(edge, 0.0), np.zeros(len(places))))


def free_of_solid(one: dict[str, Any], body: Upright, folder: Path) -> Callable[..., np.ndarray]:
    """The function that says how far bodies at places (n, 3) are from a solid [m]."""
    if ball := one.get("ball"):
        return lambda at: free_of_segment(at, ball["center"], ball["center"], ball["radius"], body)
    if (capsule := one.get("capsule")) and len(capsule["from"]) == 3:
        ends = capsule["from"], capsule["to"]
        return lambda at: free_of_segment(at, *ends, capsule["radius"], body)
    if voxels := one.get("voxels"):
        return lambda at: free_of_cubes(at, voxels, body, folder)
    if box := one.get("box"):
        return lambda at: free_of_box(at, box, body)
    low, high = one.get("height_m", (-math.inf, math.inf))
    shape, radius = polygon_of(one)
    shapely.prepare(shape)

    def free(at: np.ndarray) -> np.ndarray:
        level = shapely.distance(shape, shapely.points(at[:, :2])) - radius
        return body.free(level, np.maximum(low - at[:, 2], at[:, 2] - high))

    return free


def free_of_box(at: np.ndarray, box: dict[str, Any], body: Upright) -> np.ndarray:
    """A box that is turned about its middle."""
    low, high = np.array(box["min"], float), np.array(box["max"], float)
    turn = math.radians(box.get("yaw_deg", 0.0))
    off = at - 0.5 * (low + high)
    cos, sin = math.cos(turn), math.sin(turn)
    x, y = cos * off[:, 0] + sin * off[:, 1], -sin * off[:, 0] + cos * off[:, 1]
    out = np.maximum(np.abs(np.column_stack([x, y])) - 0.5 * (high - low)[:2], 0.0)
    return body.free(np.hypot(*out.T), np.abs(off[:, 2]) - 0.5 * (high - low)[2])


def free_of_segment(
    at: np.ndarray, first: Any, last: Any, radius: float, body: Upright
) -> np.ndarray:
    """A line with a radius: the least of a convex function of its length, by the golden section."""
    a, way = np.array(first, float), np.subtract(last, first)

    def gap(t: np.ndarray) -> np.ndarray:
        off = at - a - t[:, None] * way
        return body.free(np.hypot(off[:, 0], off[:, 1]), np.abs(off[:, 2])) - radius

    low, high = np.zeros(len(at)), np.ones(len(at))
    share = 0.5 * (math.sqrt(5) - 1)
    for _ in range(60 if way.any() else 1):
        c, d = high - share * (high - low), low + share * (high - low)
        left = gap(c) < gap(d)
        low, high = np.where(left, low, c), np.where(left, d, high)
    return np.minimum.reduce([gap(0.5 * (low + high)), gap(np.zeros_like(low)),
                              gap(np.ones_like(low))])  # fmt: skip


def free_of_cubes(
    at: np.ndarray, voxels: dict[str, Any], body: Upright, folder: Path
) -> np.ndarray:
    """Every cube of a ``.3dmap``."""
    rows = (folder / voxels["file"]).read_text(encoding="ascii").split("\n")[1:]
    cubes = np.array([row.split() for row in rows if row], float).reshape(-1, 3)
    side = voxels["cell_m"]
    middles = side * (cubes + 0.5) + voxels["origin_m"]
    least = np.full(len(at), np.inf)
    if not len(cubes):
        return least
    for k in range(0, len(at), CHUNK):
        off = np.abs(at[k : k + CHUNK, None] - middles) - 0.5 * side
        level = np.hypot(*np.maximum(off[..., :2], 0.0).transpose(2, 0, 1))
        least[k : k + CHUNK] = body.free(level, off[..., 2]).min(axis=1)
    return least


@dataclass(frozen=True)
class AskedFlight:
    """A mission in space as it was written.

    Attributes:
        data: What the file holds.
        folder: Where files lie that it names.
    """

    data: dict[str, Any]
    folder: Path

    @property
    def robot(self) -> dict[str, Any]:
        return self.data["robot"]

    @property
    def body(self) -> Upright:
        return Upright.of(self.robot)

    @property
    def kept(self) -> float:
        """Clearance that has to be proven [m]."""
        return self.robot["clearance_m"] + self.robot.get("tracking_error_m", 0.0)

    @cached_property
    def terrain(self) -> Terrain | None:
        file = self.data["world"].get("ground", {}).get("terrain")
        return None if file is None else Terrain.read(self.folder / file)

    def ground_at(self, places: np.ndarray) -> np.ndarray:
        """How high the ground is under places (n, 2 or 3) [m]."""
        if self.terrain is not None:
            return self.terrain.at(places)
        ground = self.data["world"].get("ground")
        return np.full(len(places), np.nan if ground is None else ground["flat_m"])

    def of_point(self, point: dict[str, Any]) -> list[float]:
        """Where a point of the route is [m]."""
        if gate := point.get("gate"):
            return list(map(float, gate["at"]))
        x, y, *z = point["at"]
        if "agl_m" in point:
            return [x, y, float(self.ground_at(np.array([[x, y]]))[0]) + point["agl_m"]]
        return [x, y, *z]

    def places(self) -> list[list[float]]:
        """All places of the route in the order in which it is given, upright legs with it."""
        route = self.data["route"]
        x, y = route["start"]["at"][:2]
        standing = self.robot.get("half_height_m", self.robot.get("radius_m", 0.5))
        before: list[list[float]] = []
        if takeoff := route.get("takeoff"):
            home = float(self.ground_at(np.array([[x, y]]))[0])
            before = [[x, y, home + standing]]
            first = [x, y, home + takeoff["to_agl_m"]]
        else:
            first = self.of_point(route["start"])
        vias = [self.of_point(point) for point in route["via"]]
        if route.get("closed"):
            return [*before, first, *([*vias, first] * route.get("laps", 1))]
        if land := route.get("land"):
            u, v = land["at"]
            ground = float(self.ground_at(np.array([[u, v]]))[0]) + standing
            top = max((vias[-1] if vias else first)[2], ground)
            return [*before, first, *vias, [u, v, top], [u, v, ground]]
        return [*before, first, *vias, self.of_point(route["goal"])]

    def things(self, which: tuple[str, ...], *, moving: bool) -> list[dict[str, Any]]:
        """What stands, or moves, of the known and the unseen."""
        every = (one for key in which for one in self.data["world"].get(key, ()))
        return [one for one in every if ("motion" in one) is moving]

    def free(self, at: np.ndarray, which: tuple[str, ...], *, ground: bool) -> np.ndarray:
        """Between bodies at places (n, 3) and all that stands, and the edges [m]."""
        body, least = self.body, np.full(len(at), np.inf)
        for one in self.things(which, moving=False):
            least = np.minimum(least, free_of_solid(one, body, self.folder)(at))
        world = self.data["world"]
        rings = [shapely.LinearRing(ring) for ring in world.get("fences", ())]
        rings += [shapely.box(*world["bounds"]).exterior] if "bounds" in world else []
        for ring in rings:
            inside = shapely.contains_xy(shapely.Polygon(ring), *at[:, :2].T)
            level = shapely.distance(ring, shapely.points(at[:, :2]))
            least = np.minimum(least, body.free(np.where(inside, level, 0.0), np.zeros(len(at))))
        if ground and self.terrain is not None:
            least = np.minimum(least, self.terrain.free(at, body))
        elif ground and "ground" in world:
            above = at[:, 2] - world["ground"]["flat_m"] - body.half - body.margin
            least = np.minimum(least, above)
        return least

    def free_of_moving(
        self, at: np.ndarray, times: np.ndarray, which: tuple[str, ...], *, grown: bool
    ) -> np.ndarray:
        """Between bodies at places and times and all that moves [m], (n,)."""
        least = np.full(len(at), np.inf)
        for one in self.things(which, moving=True):
            motion = one["motion"]
            flat, heights = in_plan_and_height(motion, times)
            there = np.isfinite(flat[:, 0])
            off = at - np.column_stack([flat[:, :2], heights])
            cos, sin = np.cos(flat[:, 2]), np.sin(flat[:, 2])
            x, y = cos * off[:, 0] + sin * off[:, 1], -sin * off[:, 0] + cos * off[:, 1]
            own = np.column_stack([x, y, off[:, 2]])[there]
            error = motion.get("error", {}) if grown else {}
            unsure = error.get("position_m", 0) + error.get("growth_mps", 0) * np.maximum(times, 0)
            free = free_of_solid(one, self.body, self.folder)(own) - unsure[there]
            least[there] = np.minimum(least[there], free)
        return least


def in_plan_and_height(motion: dict[str, Any], times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the frame of something is: x, y and heading (n, 3), and z (n,)."""
    if "velocity_mps" in motion:
        plan = {"from": motion["from"][:2], "velocity_mps": motion["velocity_mps"][:2]}
        return pose_of_mover(plan, times), motion["from"][2] + motion["velocity_mps"][2] * times
    flat = {"after": motion["after"], "keyframes": [row[:4] for row in motion["keyframes"]]}
    upright = {"after": motion["after"],
               "keyframes": [[row[0], row[4], 0.0] for row in motion["keyframes"]]}  # fmt: skip
    return pose_of_mover(flat, times), pose_of_mover(upright, times)[:, 0]
