"""Fleets to measure with: rounds of 214 m and crossings of 508 m in the mean, in an open square.

Discs with 2 m between their centres, 2 m/s, 1 m/s² along their paths and 0.8 m/s² across.
"""

from __future__ import annotations

import math

import numpy as np

import viaspline as vs
from viaspline.planner import Plan

SEPARATION_M = 1.0
ROBOT = {
    "radius_m": 0.5,
    "clearance_m": 0.0,
    "max_speed_mps": 2.0,
    "max_accel_mps2": 1.0,
    "max_lateral_accel_mps2": 0.8,
}
ROUND_RADIUS_M = 63.5  # of the disc from which the places of a round are drawn
ROUND_VIAS = 3
HOMES_APART_M = 2.5  # a little more than robots have to be from each other
CROSSING_SHARE = 0.97  # of the side, by which a crossing goes on the way it is to go
MARGIN_M = 30.0  # by which bends may leave the square


def round_missions(count: int, seed: int, side: float = 500.0) -> dict[str, vs.Mission]:
    """Closed rounds from random homes apart through random places, in order round their middle."""
    rng = np.random.default_rng(seed)
    room = min(ROUND_RADIUS_M, 0.5 * side)
    missions: dict[str, vs.Mission] = {}
    homes = np.empty((0, 2))
    while len(homes) < count:
        middle = rng.uniform(room, side - room, 2)
        angles = rng.uniform(0.0, 2.0 * math.pi, ROUND_VIAS + 1)
        radii = room * np.sqrt(rng.uniform(0.0, 1.0, ROUND_VIAS + 1))
        places = middle + radii[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))
        around = places - places.mean(axis=0)
        order = np.argsort(np.arctan2(around[:, 1], around[:, 0]))
        home, *via = np.roll(places[order], -int(rng.integers(ROUND_VIAS + 1)), axis=0).tolist()
        if (np.hypot(*(homes - home).T) < HOMES_APART_M).any():
            continue  # such a fleet is refused
        homes = np.vstack([homes, home])
        missions[f"r{len(homes)}"] = _mission(side, {"start": home, "via": via, "closed": True})
    return missions


def crossing_missions(count: int, seed: int, side: float = 500.0) -> dict[str, vs.Mission]:
    """Ways across the whole square: from one edge to the opposite one, through a random place."""
    rng = np.random.default_rng(seed)
    missions = {}
    for i in range(count):
        low = 0.5 * (1.0 - CROSSING_SHARE) * side
        along = [low, 0.5 * side, side - low]
        across = np.clip(rng.uniform(0.0, side) + rng.normal(0.0, 0.12 * side, 3), 0.0, side)
        ways = np.column_stack((along, across))
        if rng.random() < 0.5:
            ways = ways[:, ::-1]
        start, via, goal = (ways if rng.random() < 0.5 else ways[::-1]).tolist()
        missions[f"r{i + 1}"] = _mission(side, {"start": start, "via": [via], "goal": goal})
    return missions


def rounds(count: int, seed: int, side: float = 500.0) -> dict[str, Plan]:
    """Closed rounds, each planned by itself, by name."""
    return {name: vs.plan(one) for name, one in round_missions(count, seed, side).items()}


def crossings_508(count: int, seed: int, side: float = 500.0) -> dict[str, Plan]:
    """Ways across the whole square, each planned by itself, by name."""
    return {name: vs.plan(one) for name, one in crossing_missions(count, seed, side).items()}


def _mission(side: float, route: dict[str, object]) -> vs.Mission:
    bounds = [-MARGIN_M, -MARGIN_M, side + MARGIN_M, side + MARGIN_M]
    return vs.Mission.model_validate({"world": {"bounds": bounds}, "robot": ROBOT, "route": route})
