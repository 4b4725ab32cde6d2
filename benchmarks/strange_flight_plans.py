"""What the files of a plan in space have to keep; see ``strange_flight_oracle.py``."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
from strange_flight_curve import Sampled, users
from strange_flight_laws import law_faults, row_faults, stop_faults
from strange_flight_oracle import AskedFlight, Faults
from strange_flight_sides import side_faults
from strange_oracle import passing_faults, table

CORNER = 0.01


def flight_plan_faults(asked: AskedFlight, plan: dict[str, Any], path_csv: str) -> Faults:
    """What a written plan doesn't keep."""
    spans = np.array(plan["path"]["spans"], float)
    curve = Sampled.of_spans(spans)
    yield from via_faults(asked, plan, spans)
    yield from joint_faults(asked, plan, spans)
    yield from clear_faults(asked, plan, curve)
    yield from height_faults(asked, plan, curve)
    yield from gate_faults(asked, plan, spans)
    yield from side_faults(asked, plan, curve.places, curve.of)
    law = plan["trajectory"]["law"]
    if not any(law.get("changes_1ps2", ())) and not any(law.get("jerks_mps3", ())):
        yield from law_faults(asked, plan, curve)
    yield from row_faults(asked, plan, table(path_csv))
    yield from stop_faults(asked, plan)
    yield from yaw_faults(asked, plan, curve)


def via_faults(asked: AskedFlight, plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Every place of the route, exactly, in order."""
    expected, through = asked.places(), [via["at"] for via in users(plan)]
    if asked.data["route"].get("order") == "shortest":
        if "land" in asked.data["route"]:  # it lands from the height of its last via point
            del expected[-2], through[-2]
        expected, through = sorted(expected), sorted(through)
    if len(expected) != len(through) or not np.allclose(expected, through, rtol=0, atol=1e-9):
        yield "vias", f"{through} instead of {expected}"
    yield from passing_faults(plan, spans)


def joint_faults(asked: AskedFlight, plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Corners at which it doesn't stop, jumps of curvature that nobody tells of."""
    ends = [Sampled.of_spans(span[None]) for span in spans]
    law = plan["trajectory"]["law"]
    stops = np.array(law["distances_m"])[np.array(law["speeds_mps"]) == 0.0]
    done = 0.0
    for k, (one, other) in enumerate(pairwise(ends)):
        done += one.along[-1]
        if np.abs(stops - done).min() < 1e-2:
            continue
        turn = math.acos(min(1.0, max(-1.0, float(one.ways[-1] @ other.ways[0]))))
        if turn > CORNER:
            yield "corner", f"of {math.degrees(turn):.1f} deg at {spans[k, 3]}, no stop"
        jump = float(np.linalg.norm(one.bends[-1] - other.bends[0]))
        largest = max(np.nanmax(np.linalg.norm(part.bends, axis=1)) for part in (one, other))
        is_cardinal = asked.data["spline"].get("tangents") == "cardinal"
        if jump > 1e-3 * (1 + largest) and turn < 1e-3 and not is_cardinal:
            told = plan["drivability"]["curvature_jumps"]
            yield "jump", f"of {jump:.4f} 1/m at {spans[k, 3]} beside {largest:.4f}; {told} told"


def clear_faults(asked: AskedFlight, plan: dict[str, Any], curve: Sampled) -> Faults:
    """Free space along the curve; on upright legs from and to the ground without the ground."""
    low, high = plan["airborne_m"]
    air = (curve.along >= low - 1e-9) & (curve.along <= high + 1e-9)
    free = np.full(len(air), np.inf)
    for part, ground in ((air, True), (~air, False)):
        if part.any():
            free[part] = asked.free(curve.places[part], ("known",), ground=ground)
    least, at = float(free.min()), curve.places[free.argmin()]
    proof = plan["certificate"]
    told = math.inf if proof["clearance_m"] is None else proof["clearance_m"]
    if least < told - 1e-6:
        yield "clearance", f"{least:.6f} m sampled at {at}, {told:.6f} m proven"
    if least > told + 5e-3:
        yield "loose", f"{least:.6f} m sampled, {told:.6f} m proven at {proof['tightest_at']}"
    if told < asked.kept - 1e-6:  # what a proof may lack
        yield "nearer than asked", f"{told:.6f} m proven, {asked.kept} asked"
    if not proof["holds"]:
        yield "nearer than asked", "the proof doesn't hold"


def band_of(asked: AskedFlight, places: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """The least and the greatest heights that are allowed at places [m], each (n,)."""
    band = asked.data["world"].get("altitude")
    if band is None:
        return None
    zero = np.zeros(len(places))
    above = band.get("above", "home")
    if above == "ground":
        zero = asked.ground_at(places)
    elif above == "home":
        home = asked.ground_at(np.array([asked.data["route"]["start"]["at"][:2]], float))[0]
        zero = np.full(len(places), 0.0 if math.isnan(home) else home)
    return zero + band.get("min_m", -math.inf), zero + band.get("max_m", math.inf)


def height_faults(asked: AskedFlight, plan: dict[str, Any], curve: Sampled) -> Faults:
    """The altitude band, and the heights that are told."""
    low, high = plan["airborne_m"]
    air = (curve.along >= low - 1e-9) & (curve.along <= high + 1e-9)
    places, told = curve.places[air], plan["heights"]
    above = places[:, 2] - asked.ground_at(places)
    for key, value, sign in (
        ("least_m", places[:, 2].min(), 1), ("greatest_m", places[:, 2].max(), -1),
        ("least_agl_m", np.nanmin(above, initial=np.inf), 1),
        ("greatest_agl_m", np.nanmax(above, initial=-np.inf), -1),
    ):  # fmt: skip
        if told[key] is None or not math.isfinite(value):
            continue
        if sign * (value - told[key]) < -1e-6:
            yield "heights", f"{key} is {told[key]:.5f}, {value:.5f} sampled"
        if "agl" not in key and sign * (value - told[key]) > 0.06:
            yield "heights", f"{key} is {told[key]:.5f}, {value:.5f} sampled: loose"
    band = band_of(asked, places)
    if band is not None:
        below, beyond = band[0] - places[:, 2], places[:, 2] - band[1]
        if max(below.max(), beyond.max()) > 1e-6:
            yield "band", f"{below.max():.5f} m below, {beyond.max():.5f} m above"
    every = band_of(asked, curve.places)
    if every is not None and (curve.places[:, 2] - every[1]).max() > 1e-6:
        yield "band", f"{(curve.places[:, 2] - every[1]).max():.5f} m above on an upright leg"


def gate_faults(asked: AskedFlight, plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Gates that aren't passed squarely, in the direction that they face."""
    for point in asked.data["route"]["via"]:
        if (gate := point.get("gate")) is None:
            continue
        facing = math.radians(gate["facing_deg"])
        way = np.array([math.cos(facing), math.sin(facing), 0.0])
        found = [via for via in users(plan) if via["at"] == gate["at"]]
        if not found:
            yield "gate", f"{gate['at']} isn't passed"
        for via in found:
            k = round(via["u"])
            for part in (spans[k - 1, 3] - spans[k - 1, 2], spans[k, 1] - spans[k, 0]):
                size = np.linalg.norm(part)
                if size < 1e-9 or (part / size) @ way < 1 - 1e-9:
                    yield "gate", f"{gate} is passed by {part / max(size, 1e-12)}"


def yaw_faults(asked: AskedFlight, plan: dict[str, Any], curve: Sampled) -> Faults:
    """Where it looks: fixed, at a place, at what a via point says."""
    route, yaw = asked.data["route"], plan["yaw"]
    s, turn = np.array(yaw["distances_m"]), np.array(yaw["headings_rad"])

    def off(at: float, target: float) -> float:
        """How far the headings at a distance are from one, the nearest of those there [rad]."""
        here = turn[np.abs(s - at) < 1e-9].tolist() or [float(np.interp(at, s, turn))]
        return min(abs(math.remainder(one - target, math.tau)) for one in here)

    for via in users(plan):
        for point in route["via"]:
            if "look_at" in point and np.allclose(via["at"], asked.of_point(point), atol=1e-9):
                dx, dy = np.subtract(point["look_at"][:2], via["at"][:2])
                if (miss := off(via["distance_m"], math.atan2(dy, dx))) > 1e-6:
                    yield "look", f"{math.degrees(miss):.3f} deg off at {via['at']}"
    if any("look_at" in point for point in (route["start"], *route["via"], route.get("goal", {}))):
        return
    mode = route.get("yaw")
    if isinstance(mode, dict) and "fixed_deg" in mode:
        worst = max(off(float(at), math.radians(mode["fixed_deg"])) for at in s)
        if worst > 1e-6:
            yield "yaw", f"{math.degrees(worst):.3f} deg off a fixed one"
    if isinstance(mode, dict) and "to" in mode:
        near = np.linalg.norm(curve.places[:, :2] - mode["to"][:2], axis=1)
        heads = np.interp(curve.along, s, turn)
        dx, dy = (np.array(mode["to"][:2]) - curve.places[:, :2]).T
        miss = np.abs((heads - np.arctan2(dy, dx) + math.pi) % math.tau - math.pi)
        if miss[near > 5.0].max(initial=0.0) > math.radians(5):
            yield "yaw", f"{math.degrees(miss[near > 5.0].max()):.2f} deg off what it looks at"
