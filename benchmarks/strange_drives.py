"""What the files of a drive have to keep; see ``strange_oracle.py``."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from strange_oracle import STANDS_MPS, Asked, Faults, bezier, filled, route_places, table

HAIR_MPS = 2e-3
SPOT_RAD = 0.1


def run_faults(asked: Asked, run: dict[str, Any], run_csv: str) -> Faults:
    """What a written drive doesn't keep, or says otherwise than it is."""
    rows = table(run_csv)
    yield from told_faults(asked, run, rows)
    yield from near_faults(asked, run, rows)
    yield from met_faults(asked, run, rows)
    if "drive" not in asked.robot and "localization" not in asked.robot:
        yield from driven_limit_faults(asked, run, rows)
        yield from driven_turn_faults(asked, rows)
    for replan in run["replans"]:
        if replan["mode"] == "from_rest":
            continue
        jumps = {
            key: value for key, value in replan.items() if key.endswith(("jump_m", "jump_rad"))
        }
        if any(value > 1e-6 for value in jumps.values()):
            yield "replan jump", f"{jumps}"


def told_faults(asked: Asked, run: dict[str, Any], rows: np.ndarray) -> Faults:
    """Verdicts that contradict each other."""
    if run["reached"] != (run["reason"] is None):
        yield "verdict", f"reached {run['reached']} because of {run['reason']}"
    times = [event["time_s"] for event in run["events"]]
    if any(b < a - 1e-9 for a, b in pairwise(times)):
        yield "events", "events aren't in order"
    if run["reached"]:
        goal = np.array(route_places(asked)[-1])
        off = math.dist(goal, (rows["x_m"][-1], rows["y_m"][-1]))
        exact = "drive" not in asked.robot and "localization" not in asked.robot
        if off > (1e-5 if exact else 0.5):
            yield "goal", f"reached, but {off:.4f} m off"
        if rows["speed_mps"][-1] > (1e-5 if exact else 0.05):
            yield "goal", f"reached at {rows['speed_mps'][-1]} m/s"
        if any(via["status"] == "failed" for via in run["vias"]):
            yield "verdict", "reached, but a via point failed"
    places = np.column_stack([rows["x_m"], rows["y_m"]])
    line = shapely.LineString(places) if len(places) > 1 else shapely.Point(places[0])
    for via in run["vias"]:
        if via["status"] == "served":
            miss = line.distance(shapely.Point(via["at"]))
            if miss > (via["miss_m"] or 0.0) + 5e-3:
                yield "served", f"{via['name']} is {miss:.4f} m off, {via['miss_m']} told"
        elif via["reason"] is None:
            yield "verdict", f"{via['name']} is {via['status']} for no reason"


def near_faults(asked: Asked, run: dict[str, Any], rows: np.ndarray) -> Faults:
    """What the driven body came near to that stands."""
    places, headings, _, _ = bezier(np.array(run["path"]["spans"], float))
    exact = "drive" not in asked.robot and "localization" not in asked.robot
    if exact and asked.held_heading is None:
        cores = asked.body.laid(places, filled(headings))
    else:
        table_of = np.column_stack([rows["x_m"], rows["y_m"]])
        cores = asked.body.laid(table_of, rows["heading_rad"])
    gaps = asked.distances(cores, ("known", "unseen"))
    least, told = float(gaps.min()), run["min_clearance_m"]
    if told is None or "corridor" in asked.data["route"]:
        return
    if least < told - (1e-6 if exact else 2e-3):
        yield "run clearance", f"{least:.5f} m sampled, {told:.5f} m told"
    if least > max(told, 0.0) + 0.01 and (told > -0.01 or least > 0.02):
        yield "run loose", f"{least:.5f} m sampled, {told:.5f} m told ({run['nearest']})"
    if told < 0.0:
        seen = [one["seen_in_time"] for one in run["nearer_than_asked"]]
        word = "contact seen" if any(seen) or not seen else "contact unseen"
        yield word, f"{told:.4f} m from {run['nearest']}, seen in time: {seen}"
    if told < asked.robot["clearance_m"] - 1e-6 and not run["nearer_than_asked"] and exact:
        yield "shortfall", f"{told:.5f} m left, and nothing is said of that"
    if any(one["seen_in_time"] and one["clearance_m"] < asked.robot["clearance_m"] - 2e-3
           for one in run["nearer_than_asked"]) and exact:  # fmt: skip
        yield "seen in time", f"{run['nearer_than_asked']}"


def met_faults(asked: Asked, run: dict[str, Any], rows: np.ndarray) -> Faults:
    """What the driven body came near to that moves."""
    if not asked.moving("known") and not asked.moving("unseen"):
        return
    table_of = np.column_stack([rows["x_m"], rows["y_m"]])
    cores = asked.body.laid(table_of, rows["heading_rad"])
    gaps = asked.distances_to_moving(cores, rows["time_s"], ("known", "unseen"), grown=False)
    least, told = float(gaps.min()), run["moving"]["min_clearance_m"]
    if told is not None and math.isfinite(least) and least < told - 5e-3:
        when = rows["time_s"][gaps.argmin()]
        yield "moving clearance", f"{least:.4f} m sampled at {when}, {told:.4f} m told"
    touched = gaps < -5e-3 if asked.body.radius else gaps <= 0.0
    rolls = rows["speed_mps"] > 0.05
    contacts = run["contacts"]
    if (touched & rolls).any() and not contacts:
        yield "contact untold", f"at {rows['time_s'][(touched & rolls).argmax()]} s"
    passive = asked.robot.get("moving", {}).get("safety") == "passive"
    for one in contacts:
        if one["robot_speed_mps"] > 0.0:
            known = not one["appeared_within_braking_time"]
            word = "contact moving" if known and passive else "contact moving, unsafe"
            yield word, f"{one}"
    for one in run["passes"]:
        if told is not None and one["clearance_m"] < told - 1e-9:
            yield "pass", f"{one} where {told} m were proven of the whole drive"


def driven_limit_faults(asked: Asked, run: dict[str, Any], rows: np.ndarray) -> Faults:
    """Limits of a robot that follows exactly, by differences of its table."""
    robot = asked.robot
    v, t = rows["speed_mps"], rows["time_s"]
    accel = robot["max_accel_mps2"]
    brake = robot.get("max_brake_mps2", accel)
    steps = np.diff(t) > 1e-3
    gain = np.diff(v)[steps]  # a robot that is slower than a hair stands already
    slope = np.sign(gain) * np.maximum(np.abs(gain) - HAIR_MPS, 0.0) / np.diff(t)[steps]
    bend = np.abs(rows["curvature_1pm"])
    bend[(v < STANDS_MPS) | ~np.isfinite(bend)] = 0.0
    limits = [("driven speed", v, robot["max_speed_mps"])]
    if slope.size:
        limits += [("driven acceleration", slope, accel), ("driven braking", -slope, brake)]
    limits.append(("driven lateral", v**2 * bend, robot.get("max_lateral_accel_mps2", accel)))
    if "max_yaw_rate_degps" in robot:
        limits.append(("driven yaw rate", v * bend, math.radians(robot["max_yaw_rate_degps"])))
    for name, values, most in limits:
        if values.max() > most * (1 + 5e-3) + 2e-3:
            yield name, f"{values.max():.5f} at {t[values.argmax()]:.2f} s, at most {most:.5f}"
    for zone in asked.data["world"].get("speed_zones", ()):
        inside = shapely.contains_xy(
            shapely.Polygon(zone["polygon"]).buffer(-1e-3), rows["x_m"], rows["y_m"]
        )
        if inside.any() and v[inside].max() > zone["max_speed_mps"] * 1.005 + 2e-3:
            yield "driven zone", f"{v[inside].max():.4f} m/s in one of {zone['max_speed_mps']}"


def driven_turn_faults(asked: Asked, rows: np.ndarray) -> Faults:
    """Turns on the spot of a robot that follows exactly which are faster than its yaw rate.

    A table has the robot look along its path; so a turn counts from before a stand to after it.
    """
    if "max_yaw_rate_degps" not in asked.robot or asked.held_heading is not None:
        return
    most = math.radians(asked.robot["max_yaw_rate_degps"])
    t, headings = rows["time_s"], rows["heading_rad"]
    rolls = np.flatnonzero(rows["speed_mps"] >= STANDS_MPS)
    for i, j in pairwise(rolls):
        turned = abs(math.remainder(headings[j] - headings[i], math.tau))
        if j > i + 1 and turned > most * (t[j] - t[i]) + SPOT_RAD:
            yield "driven turn", f"{turned:.3f} rad from {t[i]:.2f} to {t[j]:.2f} s"
