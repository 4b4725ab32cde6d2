"""What the files of a flight have to keep; see ``strange_flight_oracle.py``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from strange_flight_oracle import AskedFlight, Faults
from strange_oracle import table

BOTH = ("known", "unseen")


def flight_faults(asked: AskedFlight, run: dict[str, Any], run_csv: str) -> Faults:
    """What a written flight doesn't keep, or says otherwise than it is."""
    rows = table(run_csv)
    at = np.column_stack([rows["x_m"], rows["y_m"], rows["z_m"]])
    yield from told_faults(asked, run, rows, at)
    yield from near_faults(asked, run, rows, at)
    yield from rate_faults(asked, rows, at)


def told_faults(
    asked: AskedFlight, run: dict[str, Any], rows: np.ndarray, at: np.ndarray
) -> Faults:
    """Verdicts that contradict each other, places that weren't flown through."""
    if run["reached"] != (run["reason"] is None):
        yield "verdict", f"reached {run['reached']} because of {run['reason']}"
    if not run["reached"]:
        return
    expected = asked.places()
    if math.dist(expected[-1], at[-1]) > 1e-4:
        yield "goal", f"reached, but {math.dist(expected[-1], at[-1]):.5f} m off"
    if rows["speed_mps"][-1] > 1e-4:
        yield "goal", f"reached at {rows['speed_mps'][-1]} m/s"
    if asked.data["route"].get("order") == "shortest" and "land" in asked.data["route"]:
        del expected[-2]  # it lands from the height of its last via point
    for place in expected:
        a, b = at[:-1], at[1:]
        way = b - a
        share = np.clip(((place - a) * way).sum(axis=1)
                        / np.maximum((way**2).sum(axis=1), 1e-12), 0, 1)  # fmt: skip
        miss = float(np.linalg.norm(a + share[:, None] * way - place, axis=1).min())
        if miss > 0.15 * asked.robot["max_speed_mps"] ** 0.5:
            yield "via", f"{place} is {miss:.3f} m off the rows"


def near_faults(
    asked: AskedFlight, run: dict[str, Any], rows: np.ndarray, at: np.ndarray
) -> Faults:
    """What the body came near to."""
    route = asked.data["route"]
    upright = np.zeros(len(at), bool)
    still = 1e-6
    if "takeoff" in route:
        upright |= np.logical_and.accumulate(np.hypot(*(at[:, :2] - at[0, :2]).T) <= still)
    if "land" in route and run["reached"]:
        back = (np.hypot(*(at[:, :2] - at[-1, :2]).T) <= still)[::-1]
        upright |= np.logical_and.accumulate(back)[::-1]
    free = np.full(len(at), np.inf)
    for part, ground in ((~upright, True), (upright, False)):
        if part.any():
            free[part] = asked.free(at[part], BOTH, ground=ground)
    moving = asked.free_of_moving(at, rows["time_s"], BOTH, grown=False)
    known = asked.free_of_moving(at, rows["time_s"], ("known",), grown=False)
    told = math.inf if run["clearance_m"] is None else run["clearance_m"]
    stood = np.minimum(free, known) if not run.get("moving") else free
    if stood.min() < told - 1e-4:
        when = rows["time_s"][stood.argmin()]
        yield "run clearance", f"{stood.min():.5f} m at {when:.2f} s, {told:.5f} m told"
    if free.min() < asked.robot["clearance_m"] - 1e-4:
        when = rows["time_s"][free.argmin()]
        yield "nearer", f"{free.min():.4f} m from what stands at {when:.2f} s"
    if run.get("moving") and math.isfinite(moving.min()):
        told = run["moving"]["min_clearance_m"]
        if told is not None and moving.min() < told - 1e-3:
            when = rows["time_s"][moving.argmin()]
            yield "run moving", f"{moving.min():.4f} m at {when:.2f} s, {told:.4f} told"
        safe = asked.robot.get("moving", {}).get("safety") == "passive"
        for one in run["contacts"]:
            if one["robot_speed_mps"] > 0:
                known = safe and not one["appeared_within_braking_time"]
                yield "contact moving" if known else "contact, unsafe", f"{one}"


def rate_faults(asked: AskedFlight, rows: np.ndarray, at: np.ndarray) -> Faults:
    """Limits, by differences of the rows."""
    robot, t = asked.robot, rows["time_s"]
    steps = np.diff(t)
    if (steps <= -1e-12).any():
        yield "run rows", "time goes back"
    on = steps > 1e-3
    steps = steps[on]
    top, accel = robot["max_speed_mps"], robot["max_accel_mps2"]
    brake = robot.get("max_brake_mps2", accel)
    climb = robot.get("max_climb_mps", top)
    way = np.diff(at, axis=0)[on] / steps[:, None]
    gain = np.diff(rows["speed_mps"])[on] / steps
    turn = np.abs((np.diff(rows["heading_rad"])[on] + math.pi) % math.tau - math.pi) / steps
    limits = [
        ("run speed", np.linalg.norm(way, axis=1), top), ("run climb", way[:, 2], climb),
        ("run descent", -way[:, 2], robot.get("max_descent_mps", climb)),
        ("run acceleration", gain, accel), ("run braking", -gain, brake),
    ]  # fmt: skip
    if "max_yaw_rate_dps" in robot:
        limits.append(("run yaw rate", turn, math.radians(robot["max_yaw_rate_dps"])))
    for word, values, most in limits:
        if values.size and values.max() > most * (1 + 5e-3) + 5e-3:
            when = t[:-1][on][values.argmax()]
            yield word, f"{values.max():.4f} at {when:.2f} s, at most {most:.4f}"
