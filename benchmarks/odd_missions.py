"""Missions with odd values for every key, drawn from the JSON Schema of missions.

A small sound mission is given one to four values at random places of the schema: the least and the
greatest number that it states, what lies just beyond them, numbers of a robot's size, words, lists
and mappings that belong elsewhere. Most missions are refused, the others are driven.
"""

from __future__ import annotations

import copy
import math
from typing import Any

import numpy as np

from viaspline.mission.json_schema import json_schema

BASE: dict[str, Any] = {
    "world": {
        "bounds": [-5, -8, 22, 12],
        "known": [
            {"circle": {"center": [6, 0.2], "radius": 1}},
            {"name": "hedge", "capsule": {"from": [9, 4], "to": [9, 8], "radius": 0.5}},
            {"polygon": [[14, -2], [16, -2], [15, 1]], "pass_on": "left"},
        ],
        "unseen": [{"circle": {"center": [11, 2], "radius": 0.4}}],
        "speed_zones": [{"polygon": [[2, -1], [4, -1], [4, 2]], "max_speed_mps": 0.5}],
    },
    "robot": {"radius_m": 0.3, "clearance_m": 0.2, "sensor": {"range_m": 6}},
    "route": {
        "start": {"at": [0, 0], "heading_deg": 0},
        "via": [{"at": [10, 1], "dwell_s": 1}],
        "goal": [18, 2],
    },
    "spline": {"tension": 0.0},
}
ANYTHING = (
    None, True, "", "left", "auto", "[1, 2]", "☃", [], {}, [0, 0], [[0, 0], [1, 1]], -1, 0, 1e9,
    1e300,
    math.nan, math.inf, {"at": [3, 3]}, {"circle": {"center": [3, 3]}},
)  # fmt: skip
SHARE_OF_JUNK = 0.04
MAX_ITEMS = 5


class OddMissions:
    """Draws missions.

    Args:
        rng: Where chance comes from.
    """

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng, self.schema = rng, json_schema()

    def draw(self) -> dict[str, Any]:
        """The next one: what a mission file holds."""
        mission = copy.deepcopy(BASE)
        for _ in range(int(self.rng.integers(1, 5))):
            part = str(self.rng.choice(["world", "robot", "robot", "route", "route", "spline"]))
            keys = self._resolved(self.schema["properties"][part])["properties"]
            key = str(self.rng.choice(list(keys)))
            mission[part][key] = self._value(keys[key])
        return mission

    def _resolved(self, schema: dict[str, Any]) -> dict[str, Any]:
        name = schema.get("$ref")
        return self.schema["$defs"][name.rsplit("/", 1)[-1]] if name else schema

    def _value(self, schema: dict[str, Any]) -> Any:
        if self.rng.random() < SHARE_OF_JUNK:
            return ANYTHING[int(self.rng.integers(len(ANYTHING)))]
        schema = self._resolved(schema)
        if options := schema.get("anyOf") or schema.get("oneOf"):
            return self._value(options[int(self.rng.integers(len(options)))])
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return schema["enum"][int(self.rng.integers(len(schema["enum"])))]
        kind = schema.get("type")
        if kind in ("number", "integer"):
            value = self._number(schema)
            return value if kind == "number" or not math.isfinite(value) else int(value)
        if kind == "array":
            return self._list(schema)
        if kind == "object":
            return self._mapping(schema)
        return {
            "boolean": bool(self.rng.integers(2)),
            "string": "x" * int(self.rng.integers(4)),
        }.get(str(kind))

    def _number(self, schema: dict[str, Any]) -> float:
        low = float(schema.get("minimum", schema.get("exclusiveMinimum", -1e9)))
        high = float(schema.get("maximum", schema.get("exclusiveMaximum", 1e9)))
        chance = self.rng.random()
        if chance < 0.06:
            return low
        if chance < 0.12:
            return high
        if chance < 0.15:
            return float(np.nextafter(*((low, -np.inf) if chance < 0.135 else (high, np.inf))))
        if chance < 0.25:
            return float(np.clip(10.0 ** self.rng.uniform(-9, 9), low, high))
        usual = self.rng.uniform(-12, 20) if low < 0.0 else 10.0 ** self.rng.uniform(-1.5, 1.2)
        return float(np.clip(round(float(usual), 2), low, high))

    def _list(self, schema: dict[str, Any]) -> list[Any]:
        if first := schema.get("prefixItems"):
            return [self._value(item) for item in first]
        least = int(schema.get("minItems", 0))
        most = min(int(schema.get("maxItems", MAX_ITEMS)), max(MAX_ITEMS, least))
        count = int(self.rng.integers(least, most + 1))
        return [self._value(schema.get("items", {})) for _ in range(count)]

    def _mapping(self, schema: dict[str, Any]) -> dict[str, Any]:
        keys, needed = schema.get("properties", {}), schema.get("required", ())
        return {
            key: self._value(keys[key])
            for key in keys
            if key in needed or self.rng.random() < 1.5 / len(keys)
        }
