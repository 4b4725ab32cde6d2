"""Images of a mission whose plans are known from its own: turned, mirrored, scaled, told otherwise.

A mission is what a file holds, as plain lists and mappings; a map is a ``Grid`` under ``grid``. An
image is another one, and how many times as long it is; None where there is none of its kind.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from shapely.ops import split

import viaspline as vs

Data = dict[str, Any]
Image = tuple[Data, float] | None
PLACES = ("at", "center", "from", "to", "polygon", "holes", "fences", "line")
HEADINGS = ("heading_deg", "hold_heading_deg")
SIDES = {"left": "right", "right": "left"}
DEFAULTS = {"clearance_m": 0.5, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}
FAR_OFFSETS_M = ((4.1e5, 5.4e6), (-1.2e5, 3.3e5), (7.0e6, -2.0e6))  # as in UTM, and farther
FACTORS = (0.1, 0.25, 0.5, 2.0, 4.0, 10.0, 31.7)


@dataclass(frozen=True)
class Similarity:
    """A mirroring about x, a scaling, a turn about the origin and a shift, in this order.

    Attributes:
        angle: Of the turn [deg].
        shift: x, y [m].
        scale: By which lengths, speeds and accelerations grow.
        mirrors: Whether left becomes right.
    """

    angle: float = 0.0
    shift: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0
    mirrors: bool = False

    def vectors(self, given: Any) -> Any:
        """Of what has no place, (..., 2)."""
        x, y = self.scale * np.moveaxis(np.asarray(given, float), -1, 0)
        y = -y if self.mirrors else y
        quarter = {0.0: (1, 0), 90.0: (0, 1), 180.0: (-1, 0), 270.0: (0, -1)}.get(self.angle % 360)
        turn = math.radians(self.angle)
        cos, sin = quarter or (math.cos(turn), math.sin(turn))
        return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)

    def places(self, given: Any) -> Any:
        """Of places, (..., 2), or of lists of these that are of several lengths."""
        if isinstance(given[0], (list, tuple)) and isinstance(given[0][0], (list, tuple)):
            return [self.places(one) for one in given]
        return (self.vectors(given) + self.shift).tolist()

    def heading(self, given: float) -> float:
        """Of a heading [deg]."""
        return (-given if self.mirrors else given) + self.angle

    def image(self, node: Any, key: str = "") -> Any:
        """What is under a key, as it is in the image."""
        if isinstance(node, dict):
            return self._mapping(node)
        if key in PLACES:
            return self.places(node)
        if key in HEADINGS:
            return self.heading(node)
        if key == "velocity_mps":
            return self.vectors(node).tolist()
        if key == "bounds":
            corners = np.array(self.places(corners_of(node)))
            return [*corners.min(axis=0).tolist(), *corners.max(axis=0).tolist()]
        if key == "footprint":
            return Similarity(0.0, (0.0, 0.0), self.scale, self.mirrors).vectors(node).tolist()
        if isinstance(node, str):
            return SIDES.get(node, node) if self.mirrors else node
        if isinstance(node, vs.Grid):
            return self._grid(node)
        if isinstance(node, list):
            return [self.image(one, key) for one in node]
        is_length = key == "radius" or key.endswith(("_m", "_mps", "_mps2", "_mps3"))
        return node * self.scale if is_length and not isinstance(node, bool) else node

    def _mapping(self, node: Data) -> Data:
        if "motion" in node:
            return self._mover(node)
        found = {key: self.image(value, key) for key, value in node.items()}
        if self.mirrors and "left_m" in node:
            found["left_m"], found["right_m"] = found["right_m"], found["left_m"]
        return found

    def _mover(self, node: Data) -> Data:
        """Its shape stands in a frame of its own, which turns with its headings if it has any."""
        motion = node["motion"]
        turns = any(len(frame) > 3 for frame in motion.get("keyframes", ()))
        own = Similarity(0.0 if turns else self.angle, (0.0, 0.0), self.scale, self.mirrors)
        rest = {key: value for key, value in motion.items() if key != "keyframes"}
        moved = self.image(rest)
        if "keyframes" in motion:
            moved["keyframes"] = [
                [t, *self.places([x, y]), *map(self.heading, turn)]
                for t, x, y, *turn in motion["keyframes"]
            ]
        shape = {key: value for key, value in node.items() if key != "motion"}
        return own.image(shape) | {"motion": moved}

    def _grid(self, grid: vs.Grid) -> vs.Grid:
        cells, (x, y, yaw) = grid.blocked, grid.origin
        if self.mirrors:
            height = cells.shape[0] * grid.resolution
            x, y, yaw = x - math.sin(yaw) * height, y + math.cos(yaw) * height, -yaw
            cells = cells[::-1]
        quarters, angle = divmod(self.angle, 90.0)
        if angle or yaw:
            place = Similarity(self.angle, self.shift, self.scale, self.mirrors).places([x, y])
            return vs.Grid(cells, grid.resolution * self.scale,
                           (*place, yaw + math.radians(self.angle)))  # fmt: skip
        size = grid.resolution * np.array(grid.blocked.shape[::-1])
        corners = self.places(corners_of([*grid.origin[:2], *(grid.origin[:2] + size)]))
        for _ in range(int(quarters) % 4):
            cells = cells.T[:, ::-1]
        return vs.Grid(
            cells, grid.resolution * self.scale, (*np.min(corners, axis=0).tolist(), 0.0)
        )


def corners_of(box: Any) -> list[list[float]]:
    """Of a box of x_min, y_min, x_max, y_max."""
    a, b, c, d = box
    return [[a, b], [c, b], [c, d], [a, d]]


def obstacles(data: Data) -> list[Data]:
    """What stands on the map, but maps."""
    return [one for one in data["world"]["known"] if "motion" not in one and "grid" not in one]


def has_grid(data: Data) -> bool:
    """Whether there is a map."""
    return any("grid" in one for one in data["world"]["known"])


def fenced(data: Data, _: np.random.Generator) -> Image:
    """Bounds told as a fence."""
    if "bounds" not in data["world"]:
        return None
    image = copy.deepcopy(data)
    ring = corners_of(image["world"].pop("bounds"))
    image["world"]["fences"] = [*image["world"].get("fences", ()), ring]
    return image, 1.0


def turned(data: Data, random: np.random.Generator) -> Image:
    """Turned by an odd angle and shifted; where there are bounds they are fences before."""
    if has_grid(data) or "bounds" in data["world"]:
        return None
    shift = random.uniform(-300, 300, 2)
    return Similarity(float(random.uniform(1, 359)), (*shift.tolist(),)).image(data), 1.0


def turned_map(data: Data, random: np.random.Generator) -> Image:
    """A map turned by an odd angle."""
    if not has_grid(data) or "bounds" in data["world"]:
        return None
    return Similarity(float(random.uniform(1, 89)), (3.3, -7.7)).image(data), 1.0


def quarter_turned(data: Data, random: np.random.Generator) -> Image:
    """Turned by quarters, and shifted by whole numbers."""
    shift = random.integers(-200, 200, 2).tolist()
    return Similarity(90.0 * int(random.integers(1, 4)), (*map(float, shift),)).image(data), 1.0


def far_away(data: Data, random: np.random.Generator) -> Image:
    """As far from the origin as in UTM coordinates, or farther."""
    shift = FAR_OFFSETS_M[int(random.integers(len(FAR_OFFSETS_M)))]
    return Similarity(0.0, shift).image(data), 1.0


def mirrored(data: Data, _: np.random.Generator) -> Image:
    """Left as right."""
    return Similarity(mirrors=True).image(data), 1.0


def scaled(data: Data, random: np.random.Generator) -> Image:
    """All lengths, speeds and accelerations times a number; times are the same.

    Not where there is a drive, whose controller has lengths of its own.
    """
    if "drive" in data["robot"]:
        return None
    image = copy.deepcopy(data)
    image["robot"] = DEFAULTS | image["robot"]
    if "footprint" not in image["robot"]:
        image["robot"].setdefault("radius_m", 0.5)
    factor = float(random.choice(FACTORS))
    return Similarity(scale=factor).image(image), factor


def shuffled(data: Data, random: np.random.Generator) -> Image:
    """Obstacles in another order; rings that begin elsewhere, or go the other way round."""
    image = copy.deepcopy(data)
    known = image["world"]["known"]
    if not known:
        return None
    for one in known:
        if ring := one.get("polygon"):
            at = int(random.integers(len(ring)))
            ring = ring[at:] + ring[:at]
            one["polygon"] = ring[::-1] if random.random() < 0.5 else ring
    image["world"]["known"] = [known[int(k)] for k in random.permutation(len(known))]
    return image, 1.0


def with_one_far_outside(data: Data, random: np.random.Generator) -> Image:
    """One more obstacle, a thousand times as far away as anything is wide."""
    world = data["world"]
    if not ("bounds" in world or world.get("fences")):
        return None
    image = copy.deepcopy(data)
    box = world.get("bounds") or np.array([*np.min(world["fences"][0], 0),
                                          *np.max(world["fences"][0], 0)])  # fmt: skip
    wide = max(box[2] - box[0], box[3] - box[1])
    at = [float(box[2] + wide * random.uniform(1, 1000)), float(box[1] - wide)]
    image["world"]["known"].append({"circle": {"center": at, "radius": 0.01 * float(wide)}})
    return image, 1.0


def with_one_inside(data: Data, random: np.random.Generator) -> Image:
    """One more obstacle that is part of another."""
    standing = [one for one in obstacles(data) if not one.keys() & {"pass_on", "never_pass_on"}]
    if not standing:
        return None
    image = copy.deepcopy(data)
    one = standing[int(random.integers(len(standing)))]
    if disc := one.get("circle"):
        inner: Data = {"circle": {"center": disc["center"], "radius": 0.5 * disc["radius"]}}
    elif capsule := one.get("capsule"):
        middle = 0.5 * (np.array(capsule["from"]) + capsule["to"])
        inner = {"circle": {"center": middle.tolist(), "radius": 0.9 * capsule["radius"]}}
    else:
        line = shapely.maximum_inscribed_circle(shapely.Polygon(one["polygon"], one.get("holes")))
        inner = {"circle": {"center": list(line.coords[0]), "radius": 0.8 * line.length}}
    image["world"]["known"].append(inner)
    return image, 1.0


def parted(data: Data, random: np.random.Generator) -> Image:
    """Each polygon and capsule told as two: polygons share a side, capsules overlap."""
    image, changed = copy.deepcopy(data), False
    known: list[Data] = []
    for one in image["world"]["known"]:
        halves = [] if one.keys() & {"pass_on", "never_pass_on", "motion"} else _halves(one, random)
        changed |= bool(halves)
        known += halves or [one]
    image["world"]["known"] = known
    return (image, 1.0) if changed else None


def _halves(one: Data, random: np.random.Generator) -> list[Data]:
    if capsule := one.get("capsule"):
        a, b = np.array(capsule["from"]), np.array(capsule["to"])
        near, far = (a + s * (b - a) for s in (random.uniform(0.3, 0.5), random.uniform(0.5, 0.7)))
        return [{"capsule": {"from": p.tolist(), "to": q.tolist(), "radius": capsule["radius"]}}
                for p, q in ((a, far), (near, b))]  # fmt: skip
    if "polygon" not in one or "holes" in one:
        return []
    ring = one["polygon"]
    shape = shapely.Polygon(ring)
    first = int(random.integers(len(ring)))
    diagonal = shapely.LineString([ring[first], ring[(first + len(ring) // 2) % len(ring)]])
    if len(ring) < 4 or not shape.is_valid or not shape.covers(diagonal):
        return []
    parts = [part for part in split(shape, diagonal).geoms if part.area > 0.01 * shape.area]
    if len(parts) != 2:
        return []
    return [{"polygon": [list(at) for at in part.exterior.coords[:-1]]} for part in parts]


def reversed_route(data: Data, _: np.random.Generator) -> Image:
    """From the goal to the start, a body with a front turned about."""
    robot, route = data["robot"], data["route"]
    brakes = robot.get("max_brake_mps2", robot.get("max_accel_mps2", 1.0))
    if "drive" in robot or brakes != robot.get("max_accel_mps2", 1.0) or "laps" in route:
        return None
    if any("motion" in one for one in data["world"]["known"]):
        return None
    image = copy.deepcopy(data)
    for one in image["world"]["known"]:
        for key in ("pass_on", "never_pass_on"):
            if key in one:
                one[key] = SIDES[one[key]]
    if "footprint" in robot:
        image["robot"]["footprint"] = (-np.array(robot["footprint"])).tolist()
    ends = [image["route"][key] for key in ("start", "goal") if key in image["route"]]
    if any("dwell_s" in end for end in ends):  # the stop at the goal is part of the drive
        return None
    for end in ends:
        if "heading_deg" in end:
            end["heading_deg"] += 180.0
    image["route"]["start"], image["route"]["via"] = ends[-1], image["route"].get("via", [])[::-1]
    if len(ends) > 1:
        image["route"]["goal"] = ends[0]
    elif len(ends) == 1 and "heading_deg" in ends[0]:
        return None
    if "corridor" in route:
        sides = route["corridor"]
        image["route"]["corridor"] = {"left_m": sides["right_m"], "right_m": sides["left_m"]}
    tension = image.get("spline", {}).get("tension")
    if isinstance(tension, list):
        image["spline"]["tension"] = tension[::-1]
    return image, 1.0


def exchanged(data: Data, random: np.random.Generator) -> Image:
    """Some of what a disc keeps as its radius, the rest as clearance."""
    robot = data["robot"]
    if robot.keys() & {"footprint", "tracking_error_m", "drive"}:
        return None
    image = copy.deepcopy(data)
    required = robot.get("radius_m", 0.5) + robot.get("clearance_m", 0.5)
    share = float(random.uniform(0.05, 1.0))
    image["robot"] |= {"radius_m": share * required, "clearance_m": (1.0 - share) * required}
    return image, 1.0


RELATIONS: dict[str, Callable[[Data, np.random.Generator], Image]] = {
    "fenced": fenced,
    "turned": turned,
    "turned map": turned_map,
    "quarter turned": quarter_turned,
    "far away": far_away,
    "mirrored": mirrored,
    "scaled": scaled,
    "shuffled": shuffled,
    "one far outside": with_one_far_outside,
    "one inside": with_one_inside,
    "parted": parted,
    "reversed": reversed_route,
    "exchanged": exchanged,
}
"""By name; a via point on the path needs the path, and is put there by ``metamorphic.py``."""
