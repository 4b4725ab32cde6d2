"""What the files of a plan have to keep; see ``strange_oracle.py``."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from strange_oracle import (
    FAR_M,
    STANDS_MPS,
    Asked,
    Faults,
    bezier,
    filled,
    passing_faults,
    polygon_of,
    route_places,
    table,
)  # fmt: skip


def plan_faults(asked: Asked, plan: dict[str, Any], path_csv: str) -> Faults:
    """What a written plan doesn't keep."""
    spans = np.array(plan["path"]["spans"], float)
    sampled = bezier(spans)
    yield from via_faults(asked, plan, spans)
    yield from joint_faults(asked, plan, spans)
    yield from bend_faults(asked, plan, sampled)
    yield from clearance_faults(asked, plan, sampled)
    rows = table(path_csv)
    yield from limit_faults(asked, plan, rows)
    yield from moving_faults(asked, plan, spans)
    yield from side_faults(asked, plan, sampled)


def via_faults(asked: Asked, plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Every place of the route, exactly, in order."""
    through = [via for via in plan["path"]["vias"] if via["kind"] == "user"]
    places = route_places(asked)
    if [via["at"] for via in through] != places:
        yield "vias", f"{[via['at'] for via in through]} instead of {places}"
    yield from passing_faults(plan, spans)


def turned(angle: Any) -> Any:
    """An angle between -pi and pi."""
    return (angle + math.pi) % math.tau - math.pi


def _ends(spans: np.ndarray) -> tuple[np.ndarray, ...]:
    """Headings and curvatures at both ends of spans [rad, 1/m]; nan where the curve stands."""
    found = []
    for polygon in (spans, spans[:, ::-1]):
        first = 3 * (polygon[:, 1] - polygon[:, 0])
        second = 6 * (polygon[:, 2] - 2 * polygon[:, 1] + polygon[:, 0])
        speed = np.hypot(*first.T)
        with np.errstate(all="ignore"):
            bend = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3
        found += [np.where(speed > 1e-9, np.arctan2(*first.T[::-1]), np.nan), bend]
    return found[0], found[1], found[2] + math.pi, -found[3]


def joint_faults(asked: Asked, plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Headings that are given, corners that nobody tells of, jumps of curvature."""
    heading, bend, heading_end, bend_end = _ends(spans)
    route, told = asked.data["route"], plan["drivability"]
    ends = [("start", route["start"], heading[0])]
    if "goal" in route:
        ends.append(("goal", route["goal"], heading_end[-1]))
    for name, place, is_heading in ends:
        given = place.get("heading_deg")
        if given is not None and abs(turned(math.radians(given) - is_heading)) > 1e-6:
            yield "heading", f"{name}: {math.degrees(is_heading):.3f} instead of {given}"
    turns = np.abs(turned(heading[1:] - heading_end[:-1]))
    spots = [np.array(one["at"]) for one in told["turns_on_spot"]]
    for number in np.flatnonzero(turns > 0.01):
        at = spans[number + 1, 0]
        if told["verdict"] == "good" and not any(np.allclose(at, spot) for spot in spots):
            yield "corner", f"of {math.degrees(turns[number]):.1f} deg at {at} isn't told"
    jumps = np.abs(bend[1:] - bend_end[:-1])
    jumps[(turns > 1e-3) | ~np.isfinite(jumps)] = 0.0
    largest = float(np.max(jumps, initial=0.0))
    if asked.data["spline"].get("tangents") == "cardinal":
        return
    scale = 1e-3 * (1 + np.nanmax(np.abs(bend)))
    if largest > scale:
        at = spans[1 + int(jumps.argmax()), 0]
        yield (
            "jump",
            f"curvature jumps by {largest:.4f} 1/m at {at}; {told['curvature_jumps']} told",
        )


def bend_faults(asked: Asked, plan: dict[str, Any], sampled: tuple) -> Faults:
    """Curvature beyond what is told, or what the robot can drive."""
    _, _, bend, _ = sampled
    sharpest = float(np.nanmax(np.abs(bend)))
    told = plan["path"]["max_curvature_1pm"] or math.inf
    if sharpest > told * (1 + 1e-6) + 1e-6 and sharpest < 1e4:
        yield "curvature", f"{sharpest:.6g} 1/m sampled, {told:.6g} told"
    robot = asked.robot
    least = robot.get("min_turn_radius_m", 0.0)
    if ackermann := robot.get("drive", {}).get("ackermann"):
        wheels = ackermann["wheelbase_m"] / math.tan(math.radians(ackermann["max_steer_deg"]))
        least = max(least, wheels)
    if least and sharpest * least > 1 + 1e-5:
        yield "circle", f"radius {1 / sharpest:.6g} m driven, {least:.6g} m asked"
    drives = plan["drivability"]
    radius = drives["sharpest_radius_m"] or math.inf
    if drives["verdict"] == "good" and radius < (drives["least_radius_m"] or 0.0) * (1 - 1e-6):
        yield "drivability", "good, but its sharpest bend is sharper than the least radius"
    if (drives["verdict"] == "good") != (not drives["reasons"]):
        yield "drivability", f"{drives['verdict']} because of {drives['reasons']}"


def clearance_faults(asked: Asked, plan: dict[str, Any], sampled: tuple) -> Faults:
    """Bodies along the exact curve, beside what is proven."""
    places, headings, _, _ = sampled
    told = plan["certificate"]
    if told["clearance_m"] is None:
        return
    turn = filled(headings) if asked.held_heading is None else asked.held_heading
    cores = asked.body.laid(places, np.broadcast_to(turn, len(places)))
    gaps = asked.distances(cores, ("known",))
    least = float(gaps.min())
    if least < told["clearance_m"] - 1e-6:
        yield "clearance", f"{least:.6f} m sampled at {places[gaps.argmin()]}, {told} proven"
    corners = bool(plan["drivability"]["turns_on_spot"]) and asked.body.corners is not None
    if least > told["clearance_m"] + 4e-3 and not corners and "corridor" not in asked.data["route"]:
        yield "loose", f"{least:.6f} m sampled, {told['clearance_m']:.6f} m proven"
    if told["holds"] and told["clearance_m"] < asked.robot["clearance_m"] - 1e-9:
        yield "clearance", f"holds with {told['clearance_m']} m"
    if not told["holds"]:
        yield "holds", f"a plan whose certificate doesn't hold: {told}"


def limit_faults(asked: Asked, plan: dict[str, Any], rows: np.ndarray) -> Faults:
    """Speeds and what follows from them, of the table of the path."""
    robot, law = asked.robot, plan["trajectory"]["law"]
    v, t, bend = rows["speed_mps"], rows["time_s"], rows["curvature_1pm"]
    accel = robot["max_accel_mps2"]
    brake = robot.get("max_brake_mps2", accel)
    side = robot.get("max_lateral_accel_mps2", accel)
    limits = [
        ("speed", v, robot["max_speed_mps"]),
        ("lateral", v**2 * np.abs(bend), side),
    ]
    if "max_yaw_rate_degps" in robot and asked.held_heading is None:
        limits.append(("yaw rate", v * np.abs(bend), math.radians(robot["max_yaw_rate_degps"])))
    if wheels := robot.get("drive", {}).get("differential"):
        outer = v * (1 + 0.5 * wheels["track_m"] * np.abs(bend))
        limits.append(("wheel speed", outer, wheels.get("max_wheel_speed_mps", np.inf)))
    gains = np.array(law["accelerations_mps2"], float)[np.diff(law["times_s"]) > 1e-6]
    limits += [("acceleration", gains, accel), ("braking", -gains, brake)]
    rolls = (v[1:] > STANDS_MPS) & (v[:-1] > STANDS_MPS) & (np.diff(t) > 1e-3)
    with np.errstate(all="ignore"):
        slope = np.where(rolls, np.diff(v) / np.diff(t), np.nan)
        span = 0.5 * (np.diff(t)[1:] + np.diff(t)[:-1])
        jerk = np.abs(np.diff(slope)) / span
    limits += [("acceleration of rows", slope, accel), ("braking of rows", -slope, brake)]
    if "max_jerk_mps3" in robot:
        limits.append(("jerk", jerk, robot["max_jerk_mps3"] + 1e-5 / np.nanmin(span) ** 2))
    for name, values, most in limits:
        values = values[np.isfinite(values)]
        if values.size and values.max() > most * (1 + 2e-3) + 1e-4:
            yield name, f"{values.max():.5f}, at most {most:.5f}"
    for zone in asked.data["world"].get("speed_zones", ()):
        inside = shapely.contains_xy(shapely.Polygon(zone["polygon"]), rows["x_m"], rows["y_m"])
        if inside.any() and v[inside].max() > zone["max_speed_mps"] * (1 + 1e-3) + 1e-4:
            yield "zone", f"{v[inside].max():.4f} m/s in one of {zone['max_speed_mps']}"
    takes = law["times_s"][-1] - law["times_s"][0]
    if abs(takes - plan["trajectory"]["duration_s"]) > 1e-6:
        yield "duration", f"{takes} and {plan['trajectory']['duration_s']}"


def moving_faults(asked: Asked, plan: dict[str, Any], spans: np.ndarray) -> Faults:
    """Bodies along the path by its law, beside what moves on the map."""
    told = plan["certificate"].get("moving")
    if not asked.moving("known"):
        return
    if told is None:
        yield "moving", "nothing is said of what moves"
        return
    law = plan["trajectory"]["law"]
    if (
        law.get("accelerations_mps2") is None
        or len(law["accelerations_mps2"]) != len(law["times_s"]) - 1
    ):
        return
    hold = asked.data["route"].get("hold_s", 0.0)
    times = np.arange(law["times_s"][0], law["times_s"][-1] + hold, 0.01)
    along = distance_by_law(law, times)
    places, headings, *_ = bezier(spans)
    lengths = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
    at = np.column_stack([np.interp(along, lengths, axis) for axis in places.T])
    turn = np.interp(along, lengths, np.unwrap(filled(headings)))
    if asked.held_heading is not None:
        turn = np.full(len(at), asked.held_heading)
    cores = asked.body.laid(at, turn)
    gaps = asked.distances_to_moving(cores, times, ("known",), grown=True)
    if gaps.min() < told["clearance_m"] - 2e-3:
        when = times[gaps.argmin()]
        yield "moving", f"{gaps.min():.4f} m sampled at {when:.2f} s, {told} proven"


def distance_by_law(law: dict[str, Any], times: np.ndarray) -> np.ndarray:
    """Distances at times by nodes [m].

    Between them the acceleration is even, or changes evenly with the distance (c) or with time (j):
    x" = a + c x has the solution of an oscillator that is let go, or driven apart.
    """
    t, s, v, a = (
        np.array(law[key], float)
        for key in ("times_s", "distances_m", "speeds_mps", "accelerations_mps2")
    )
    c, j = (
        np.zeros(len(a)) if law.get(key) is None else np.array(law[key], float)
        for key in ("changes_1ps2", "jerks_mps3")
    )
    piece = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(a) - 1)
    since = np.minimum(times, t[-1]) - t[piece]
    v, a, c, j = v[piece], a[piece], c[piece], j[piece]
    gone = v * since + 0.5 * a * since**2 + j * since**3 / 6.0
    bends = np.abs(c) * since**2 > 1e-9
    root = np.sqrt(np.abs(np.where(bends, c, 1.0)))
    first = np.where(c > 0.0, np.sinh(root * since), np.sin(root * since)) / root
    other = np.where(c > 0.0, np.cosh(root * since), np.cos(root * since)) - 1.0
    return s[piece] + np.where(bends, v * first + a * other / np.where(bends, c, 1.0), gone)


def side_faults(asked: Asked, plan: dict[str, Any], sampled: tuple) -> Faults:
    """Paths that cross the line from an obstacle out to the side that it mustn't be passed on."""
    places, _, _, of = sampled
    through = [via for via in plan["path"]["vias"] if via["kind"] == "user"]
    if "corridor" in asked.data["route"]:
        return
    near = 2 * (asked.body.inner_radius + asked.robot["clearance_m"])
    for one in asked.standing("known"):
        side = one.get("pass_on")
        if one.get("never_pass_on"):
            side = {"left": "right", "right": "left"}[one["never_pass_on"]]
        if side is None:
            continue
        shape, radius = polygon_of(one)
        for begin, end in pairwise(through):
            leg = np.array(end["at"]) - np.array(begin["at"])
            out = np.array([leg[1], -leg[0]]) / np.hypot(*leg)  # to the right of it
            out = -out if side == "right" else out
            middle = np.array(shape.centroid.coords[0])
            straight = shapely.LineString([begin["at"], end["at"]])
            driven = shapely.LineString(places[(of >= round(begin["u"])) & (of < round(end["u"]))])
            if shape.distance(driven) - radius > 0.9 * near:
                continue
            gate = shapely.LineString([middle, middle + FAR_M * out])
            if driven.crosses(gate) and shape.distance(straight) - radius < near:
                yield "side", f"{one['name']} is passed on the other side than {side}"
