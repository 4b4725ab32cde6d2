"""Images of strange missions in space, which have to be planned as these are.

See ``strange_flight_images.py``.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np

OTHER_SIDE: Final = {"left": "right", "right": "left"}

Data = dict[str, Any]


class Placed:
    """A turn about the vertical, a mirror and a shift of all that a mission has.

    Args:
        turn: About the origin [rad], before the shift.
        shift: x, y, z [m].
        mirror: Whether y is negated first.
    """

    def __init__(self, turn: float = 0.0, shift: Any = (0, 0, 0), *, mirror: bool = False) -> None:
        self.turn, self.shift, self.mirror = turn, shift, mirror

    def way(self, at: Any) -> list[float]:
        """A direction, or a place before the shift."""
        x, y, *z = at
        y = -y if self.mirror else y
        if self.turn:
            c, s = math.cos(self.turn), math.sin(self.turn)
            x, y = c * x - s * y, s * x + c * y
        return [float(x), float(y), *z]

    def at(self, at: Any) -> list[float]:
        """A place."""
        moved = self.way(at)
        return [float(a + b) for a, b in zip(moved, self.shift, strict=False)]

    def heading(self, degrees: float) -> float:
        return (-degrees if self.mirror else degrees) + math.degrees(self.turn)

    def mission(self, data: Data, folder: Path) -> Data:
        """The image of a mission whose files are in a folder."""
        new = copy.deepcopy(data)
        world = new["world"]
        world["known"] = [self._obstacle(one) for one in world["known"]]
        for zone in world.get("speed_zones", ()):
            zone["polygon"] = [self.at(p) for p in zone["polygon"]]
        if "fences" in world:
            world["fences"] = [[self.at(p) for p in ring] for ring in world["fences"]]
        ground = world.get("ground", {})
        if "flat_m" in ground:
            ground["flat_m"] += self.shift[2]
        if "terrain" in ground:
            ground["terrain"] = self._terrain(folder)
        band = world.get("altitude", {})
        if band and (band["above"] == "amsl" or not ground):  # nothing says how high home is
            for key in ("min_m", "max_m"):
                if key in band:
                    band[key] += self.shift[2]
        self._route(new["route"])
        return new

    def _terrain(self, folder: Path) -> str:
        """The same heights elsewhere; a mirrored or turned one can't be written."""
        head, rows = [], []
        for line in (folder / "hills.asc").read_text().splitlines():
            (head if line[0].isalpha() else rows).append(line)
        moved = {"xllcenter": self.shift[0], "yllcenter": self.shift[1]}
        told = [
            f"{key} {float(value) + moved.get(key, 0.0):.10g}"
            for key, value in map(str.split, head)
        ]
        told = [line.replace(".0", "") if line.startswith("n") else line for line in told]
        heights = [
            " ".join(f"{float(h) + self.shift[2]:.10g}" for h in row.split()) for row in rows
        ]
        (folder / "moved.asc").write_text("\n".join([*told, *heights]) + "\n", encoding="ascii")
        return "moved.asc"

    def _obstacle(self, one: Data) -> Data:
        """An obstacle; what moves has its shape about its own origin."""
        one = copy.deepcopy(one)
        place = self.way if "motion" in one else self.at
        up = 0.0 if "motion" in one else self.shift[2]
        if "height_m" in one:
            one["height_m"] = [h + up for h in one["height_m"]]
        for key in ("circle", "ball"):
            if key in one:
                one[key]["center"] = place(one[key]["center"])
        if "polygon" in one:
            one["polygon"] = [place(p) for p in one["polygon"]]
        if "capsule" in one:
            for key in ("from", "to"):
                one["capsule"][key] = place(one["capsule"][key])
        if "box" in one:
            self._box(one["box"], place)
        if "voxels" in one:
            cubes = one["voxels"]
            cubes["origin_m"] = self.at(cubes["origin_m"])
        if "motion" in one:
            self._motion(one["motion"])
        if self.mirror:
            for key in ("pass_on", "never_pass_on"):
                if key in one:
                    one[key] = OTHER_SIDE.get(one[key], one[key])
        return one

    def _box(self, box: Data, place: Callable[[Any], list[float]]) -> None:
        low, high = np.array(box["min"], float), np.array(box["max"], float)
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        at = np.array(place(middle.tolist()))
        box["min"], box["max"] = (at - half).tolist(), (at + half).tolist()
        box["yaw_deg"] = self.heading(box.get("yaw_deg", 0.0))

    def _motion(self, motion: Data) -> None:
        if "from" in motion:
            motion["from"] = self.at(motion["from"])
            motion["velocity_mps"] = self.way(motion["velocity_mps"])
        else:
            motion["keyframes"] = [
                [t, *self.at((x, y)), -heading if self.mirror else heading, z + self.shift[2]]
                for t, x, y, heading, z in motion["keyframes"]
            ]

    def _route(self, route: Data) -> None:
        for key in ("start", "goal", "land"):
            if key in route:
                self._point(route[key])
        for point in route["via"]:
            self._point(point)
        yaw = route.get("yaw")
        if isinstance(yaw, dict):
            if "to" in yaw:
                yaw["to"] = self.at(yaw["to"])
            else:
                yaw["fixed_deg"] = self.heading(yaw["fixed_deg"])

    def _point(self, point: Data) -> None:
        if "gate" in point:
            gate = point["gate"]
            gate["at"] = self.at(gate["at"])
            gate["facing_deg"] = self.heading(gate["facing_deg"])
        if "at" in point:
            point["at"] = self.at(point["at"])
        if "look_at" in point:
            point["look_at"] = self.at(point["look_at"])


def is_fixed_to_axes(data: Data) -> bool:
    """Whether a mission has files that can be shifted, but neither turned nor mirrored."""
    return "terrain" in data["world"].get("ground", {}) or any(
        "voxels" in one for one in data["world"]["known"]
    )


def reversed_route(data: Data) -> Data | None:
    """The other way round, with limits that are the same there and back."""
    route, world = data["route"], data["world"]
    if "takeoff" in route or "land" in route or any("motion" in one for one in world["known"]):
        return None
    band = world.get("altitude")
    if data["robot"].get("max_jerk_mps3") or (band is not None and band["above"] == "home"):
        return None
    new = copy.deepcopy(data)
    route = new["route"]
    route["via"] = route["via"][::-1]
    for point in route["via"]:
        if "gate" in point:
            point["gate"]["facing_deg"] += 180.0
    if "goal" in route:
        route["start"], route["goal"] = route["goal"], route["start"]
    if isinstance(route.get("yaw"), dict) and "fixed_deg" in route["yaw"]:
        route["yaw"]["fixed_deg"] += 180.0
    for one in new["world"]["known"]:
        for key in ("pass_on", "never_pass_on"):
            if key in one:
                one[key] = OTHER_SIDE.get(one[key], one[key])
    return new


def in_other_order(data: Data, rng: np.random.Generator) -> Data:
    new = copy.deepcopy(data)
    known = new["world"]["known"]
    new["world"]["known"] = [known[k] for k in rng.permutation(len(known))]
    return new


def with_far_thing(data: Data) -> Data:
    new = copy.deepcopy(data)
    base = data["world"].get("ground", {}).get("flat_m", 0.0)
    ball = {"center": [3000.0, -2000.0, base + 20.0], "radius": 4.0}
    new["world"]["known"].append({"name": "far", "ball": ball})
    return new


def boxes_as_polygons(data: Data) -> Data | None:
    new = copy.deepcopy(data)
    found = False
    for one in new["world"]["known"]:
        if "box" not in one or "motion" in one:
            continue
        box = one.pop("box")
        (x0, y0, z0), (x1, y1, z1) = box["min"], box["max"]
        x, y, a, b = (x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2, (y1 - y0) / 2
        turn = math.radians(box.get("yaw_deg", 0.0))
        c, s = math.cos(turn), math.sin(turn)
        one["polygon"] = [[x + c * u - s * v, y + s * u + c * v]
                          for u, v in ((-a, -b), (a, -b), (a, b), (-a, b))]  # fmt: skip
        one["height_m"] = [z0, z1]
        found = True
    return new if found else None


def capsules_in_two(data: Data) -> Data | None:
    new = copy.deepcopy(data)
    known: list[Data] = []
    for one in new["world"]["known"]:
        if "capsule" not in one or "motion" in one or "pass_on" in one or "never_pass_on" in one:
            known.append(one)
            continue
        first, last = np.array(one["capsule"]["from"]), np.array(one["capsule"]["to"])
        for name, (a, b) in (("", (0.0, 0.6)), (" too", (0.4, 1.0))):
            ends = {
                "from": (first + a * (last - first)).tolist(),
                "to": (first + b * (last - first)).tolist(),
            }
            known.append({**one, "name": one["name"] + name, "capsule": {**one["capsule"], **ends}})
    found = len(known) > len(new["world"]["known"])
    new["world"]["known"] = known
    return new if found else None


def images(data: Data, folder: Path, seed: int) -> Iterator[tuple[str, Data]]:
    """The images of a mission, by name."""
    rng = np.random.default_rng((seed, 77))
    turn = float(rng.uniform(0.1, 6.2))
    far = [float(rng.uniform(1e5, 9e5)), float(rng.uniform(1e6, 6e6)), 0.0]
    fixed = is_fixed_to_axes(data)
    yield "shifted", Placed(shift=np.round(far).tolist()).mission(data, folder)
    yield "raised", Placed(shift=(0, 0, 37.5)).mission(data, folder)
    if not fixed:
        yield "turned", Placed(turn).mission(data, folder)
        yield "turned far", Placed(turn, far).mission(data, folder)
        yield "mirrored", Placed(mirror=True).mission(data, folder)
    yield "order", in_other_order(data, rng)
    yield "far thing", with_far_thing(data)
    for name, image in (("polygons", boxes_as_polygons(data)), ("capsules", capsules_in_two(data)),
                        ("reversed", reversed_route(data))):  # fmt: skip
        if image is not None:
            yield name, image
