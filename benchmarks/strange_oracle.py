"""What the written files of a plan and a drive have to keep, told without the planner.

``plan.json``, ``run.json``, ``path.csv`` and ``run.csv`` are held against the mission as it was
written: Bézier polygons are sampled every centimetre or two, bodies laid there by shapely, limits
looked for by differences of the tables. Nothing of the planner is imported. Each fault is a word
for its kind and a sentence.

What is left out, because it says nothing: curvature and heading while the robot stands, jerk where
it sets out, stops or brakes for something, what is kept of the edges of a corridor.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from oracle import samples, verdict

Faults = Iterator[tuple[str, str]]
SAMPLES_M = 0.015
STANDS_MPS = 0.02
FAR_M = 1e3
FLOOD_STEP_M, FLOOD_EDGE_M, FLOOD_FAR_M = 0.1, 7.0, 31.0


def bezier(spans: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Samples of all spans: places (n, 2), headings (n,), curvatures (n,), span of each (n,)."""
    places, headings, curvatures, of = [], [], [], []
    for number, polygon in enumerate(spans):
        length = np.linalg.norm(np.diff(polygon, axis=0), axis=1).sum()
        u = np.linspace(0, 1, max(4, math.ceil(length / SAMPLES_M)) + 1)[:, None]
        a, b, c, d = polygon
        v = 1 - u
        places.append(v**3 * a + 3 * v**2 * u * b + 3 * v * u**2 * c + u**3 * d)
        first = 3 * (v**2 * (b - a) + 2 * v * u * (c - b) + u**2 * (d - c))
        second = 6 * (v * (c - 2 * b + a) + u * (d - 2 * c + b))
        speed = np.hypot(*first.T)
        still = speed < 1e-9 * max(length, 1e-9)
        with np.errstate(all="ignore"):
            bend = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3
        curvatures.append(np.where(still, np.nan, bend))
        headings.append(np.where(still, np.nan, np.arctan2(first[:, 1], first[:, 0])))
        of.append(np.full(len(u), number))
    return (*map(np.concatenate, (places, headings, curvatures, of)),)


def table(text: str) -> np.ndarray:
    """A written table, by its columns' names."""
    return np.genfromtxt(io.StringIO(text), delimiter=",", names=True)


def passing_faults(plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Spans that aren't joined, and via points of a plan that its curve isn't at, in order."""
    if not np.array_equal(spans[1:, 0], spans[:-1, 3]):
        yield "vias", "spans aren't joined"
    ends = np.concatenate([spans[:, 0], spans[-1:, 3]])
    last = -1.0
    for via in plan["path"]["vias"]:
        if via["u"] != round(via["u"]) or ends[round(via["u"])].tolist() != via["at"]:
            yield "vias", f"the curve isn't at {via['at']} at u = {via['u']}"
        if via["u"] <= last:
            yield "vias", f"{via['name']} isn't in order"
        last = via["u"]


def polygon_of(shape: dict[str, Any]) -> tuple[Any, float]:
    """The core of an obstacle, and how far it reaches beyond that [m]."""
    if disc := shape.get("circle"):
        return shapely.Point(disc["center"]), disc["radius"]
    if capsule := shape.get("capsule"):
        return shapely.LineString([capsule["from"], capsule["to"]]), capsule["radius"]
    return shapely.Polygon(shape["polygon"], shape.get("holes")), 0.0


def squares(file: Path, side: float) -> list[Any]:
    """The blocked squares of a MovingAI map, lower left corner at 0, 0."""
    rows = file.read_text(encoding="ascii").split("map\n")[1].split()
    return [
        shapely.box(j * side, i * side, (j + 1) * side, (i + 1) * side)
        for i, row in enumerate(reversed(rows))
        for j, cell in enumerate(row)
        if cell == "@"
    ]


def pose_of_mover(motion: dict[str, Any], times: np.ndarray) -> np.ndarray:
    """Where something is at times [s], (n, 3) [m, m, rad]; nan where it isn't there."""
    if "velocity_mps" in motion:
        at = np.array(motion["from"]) + times[:, None] * np.array(motion["velocity_mps"])
        return np.column_stack([at, np.zeros(len(times))])
    rows, heading = [], 0.0
    for t, x, y, *turn in motion["keyframes"]:
        heading = math.radians(turn[0]) if turn else heading
        rows.append((t, x, y, heading))
    frames = np.array(rows)
    first, last = frames[0, 0], frames[-1, 0]
    t = times.copy()
    if motion["after"] == "loop":
        t = np.where(t > last, first + np.mod(t - first, last - first), t)
    if motion["after"] == "bounce":
        folded = np.mod(t - first, 2 * (last - first))
        t = np.where(t > last, first + np.minimum(folded, 2 * (last - first) - folded), t)
    pose = np.column_stack([np.interp(t, frames[:, 0], axis) for axis in frames.T[1:]])
    if motion["after"] == "vanish":
        pose[(times > last) | (times < first)] = np.nan
    return pose


@dataclass(frozen=True)
class Body:
    """The robot's body as the mission says it."""

    radius: float
    corners: np.ndarray | None

    @classmethod
    def of(cls, robot: dict[str, Any]) -> Body:
        if "footprint" in robot:
            return cls(0.0, np.array(robot["footprint"], float))
        return cls(float(robot.get("radius_m", 0.5)), None)

    @property
    def inner_radius(self) -> float:
        """Of the disc about the reference point that the body contains [m]."""
        if self.corners is None:
            return self.radius
        return float(shapely.Point(0, 0).distance(shapely.LinearRing(self.corners)))

    def laid(self, places: np.ndarray, headings: np.ndarray) -> np.ndarray:
        """Its core at places, as shapes of shapely."""
        if self.corners is None:
            return shapely.points(places)
        cos, sin = np.cos(headings)[:, None], np.sin(headings)[:, None]
        x, y = self.corners.T
        at = np.stack([cos * x - sin * y, sin * x + cos * y], axis=2) + places[:, None]
        return shapely.polygons(at)


@dataclass(frozen=True)
class Asked:
    """A mission as it was written.

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
    def body(self) -> Body:
        return Body.of(self.robot)

    @property
    def held_heading(self) -> float | None:
        """The heading that the body keeps wherever it goes [rad]."""
        drive = self.robot.get("drive", {}).get("omnidirectional", {})
        turn = drive.get("hold_heading_deg")
        return None if turn is None else math.radians(turn)

    def standing(self, which: str) -> list[dict[str, Any]]:
        """What stands: ``known`` or ``unseen``."""
        return [one for one in self.data["world"].get(which, ()) if "motion" not in one]

    def moving(self, which: str) -> list[dict[str, Any]]:
        """What moves: ``known`` or ``unseen``."""
        return [one for one in self.data["world"].get(which, ()) if "motion" in one]

    @cached_property
    def edges(self) -> list[Any]:
        """Lines that the body stays inside of."""
        world = self.data["world"]
        rings = [shapely.Polygon(ring).exterior for ring in world.get("fences", ())]
        if "bounds" in world:
            rings.append(shapely.box(*world["bounds"]).exterior)
        for one in world["known"]:
            if "map" in one and "bounds" not in world:
                rows = (self.folder / one["map"]).read_text(encoding="ascii").split("map\n")[1]
                side, rows = one["resolution_m"], rows.split()
                rings.append(shapely.box(0, 0, side * len(rows[0]), side * len(rows)).exterior)
        return rings

    def distances(self, cores: np.ndarray, which: tuple[str, ...]) -> np.ndarray:
        """Of bodies from all that stands, and from the edges [m], (n,)."""
        least = np.full(len(cores), np.inf)
        for edge in self.edges:
            least = np.minimum(least, shapely.distance(cores, edge))
        for one in (one for kind in which for one in self.standing(kind)):
            if "map" in one:
                blocked = squares(self.folder / one["map"], one["resolution_m"])
                shapes = [(shapely.union_all(blocked), 0.0)] if blocked else []
            else:
                shapes = [polygon_of(one)]
            for shape, radius in shapes:
                shapely.prepare(shape)
                least = np.minimum(least, shapely.distance(cores, shape) - radius)
        return least - self.body.radius

    def distances_to_moving(
        self, cores: np.ndarray, times: np.ndarray, which: tuple[str, ...], *, grown: bool
    ) -> np.ndarray:
        """Of bodies at times from all that moves [m], (n,); grown by what isn't sure of it."""
        least = np.full(len(cores), np.inf)
        for one in (one for kind in which for one in self.moving(kind)):
            shape, radius = polygon_of(one)
            pose = pose_of_mover(one["motion"], times)
            there = np.isfinite(pose[:, 0])
            cos, sin = np.cos(pose[:, 2]), np.sin(pose[:, 2])
            at = shapely.get_coordinates(shape)
            x = cos[:, None] * at[:, 0] - sin[:, None] * at[:, 1] + pose[:, :1]
            y = sin[:, None] * at[:, 0] + cos[:, None] * at[:, 1] + pose[:, 1:2]
            moved = np.stack([x, y], axis=2)[there]
            make = {1: lambda a: shapely.points(a[:, 0]), 2: shapely.linestrings}
            shapes = make.get(len(at), shapely.polygons)(moved)
            error = one["motion"].get("error", {}) if grown else {}
            unsure = error.get("position_m", 0) + error.get("growth_mps", 0) * np.maximum(times, 0)
            gap = shapely.distance(cores[there], shapes) - radius - unsure[there]
            least[there] = np.minimum(least[there], gap)
        return least - self.body.radius


def route_places(asked: Asked) -> list[list[float]]:
    """The places of the route in the order in which they are driven."""
    route = asked.data["route"]
    places = [route["start"]["at"], *(via["at"] for via in route["via"])]
    if route.get("closed"):
        return places * route.get("laps", 1) + places[:1]
    return [*places, route["goal"]["at"]]


def filled(headings: np.ndarray) -> np.ndarray:
    """Headings, at places where the curve stands those beside them."""
    known = np.flatnonzero(np.isfinite(headings))
    near = known[np.clip(np.searchsorted(known, np.arange(len(headings))), 0, len(known) - 1)]
    return headings[near]


def open_legs(asked: Asked, which: tuple[str, ...]) -> bool | None:
    """Whether a disc can certainly go from each place of the route to the next.

    Returns:
        None where the flood of ``oracle.py`` can't tell, or more is asked than a disc's way:
        sides, a corridor, a turning circle, a body that is no disc, an allowance that is measured.
    """
    robot = asked.robot
    sides = any(one.keys() & {"pass_on", "never_pass_on"} for one in asked.standing("known"))
    more = {"footprint", "min_turn_radius_m", "drive", "localization"} & robot.keys()
    if more or sides or "corridor" in asked.data["route"] or asked.moving("known"):
        return None
    box = (-FLOOD_EDGE_M, -FLOOD_EDGE_M, FLOOD_FAR_M, FLOOD_FAR_M)
    x, y = np.meshgrid(*samples(box, FLOOD_STEP_M))
    gaps = asked.distances(shapely.points(x, y).ravel(), which).reshape(x.shape)
    inside = np.ones(x.shape, bool)
    for edge in asked.edges:
        inside &= shapely.contains_xy(shapely.Polygon(edge), x, y)
    kept = robot["clearance_m"] + robot.get("tracking_error_m", 0.0)
    told = [
        verdict(np.where(inside, gaps, -1.0), box, FLOOD_STEP_M, a, b, kept)
        for a, b in pairwise(route_places(asked))
    ]
    return None if "unsure" in told else "closed" not in told
