"""What the time law of a plan in space has to keep; see ``strange_flight_oracle.py``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from strange_flight_curve import Sampled, users
from strange_flight_oracle import AskedFlight, Faults
from strange_oracle import STANDS_MPS

STEP_S = 0.005


def timed(law: dict[str, Any], hold: float = 0.0) -> tuple[np.ndarray, ...]:
    """Times every 5 ms [s], with distances, speeds and accelerations by the law's nodes."""
    t, s, v, a = (np.array(law[key], float) for key in (
        "times_s", "distances_m", "speeds_mps", "accelerations_mps2"))  # fmt: skip
    times = np.arange(t[0], t[-1] + hold, STEP_S)
    piece = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(a) - 1)
    since = np.minimum(times, t[-1]) - t[piece]
    along = s[piece] + v[piece] * since + 0.5 * a[piece] * since**2
    ends = times >= t[-1]
    speeds, gains = v[piece] + a[piece] * since, a[piece]
    return times, np.where(ends, s[-1], along), np.where(ends, 0, speeds), np.where(ends, 0, gains)


def law_faults(asked: AskedFlight, plan: dict[str, Any], curve: Sampled) -> Faults:
    """Limits of the law along the exact curve, and what moves beside it."""
    law, robot = plan["trajectory"]["law"], asked.robot
    hold = asked.data["route"].get("hold_s", 0.0)
    times, along, v, a = timed(law, hold)
    scale = curve.along[-1] / law["distances_m"][-1]
    if abs(scale - 1) > 1e-4:
        yield "length", f"{curve.along[-1]} m sampled, {law['distances_m'][-1]} m told"

    def at(values: np.ndarray) -> np.ndarray:
        known = np.isfinite(values).all(axis=1)
        return np.column_stack([np.interp(along * scale, curve.along[known], axis[known])
                                for axis in values.T])  # fmt: skip

    ways, bends = at(curve.ways), at(curve.bends)
    accel, top = robot["max_accel_mps2"], robot["max_speed_mps"]
    climb = robot.get("max_climb_mps", top)
    across = robot.get("max_lateral_accel_mps2", accel)
    size = np.linalg.norm(bends, axis=1)
    limits = [
        ("speed", v, top), ("climb", v * ways[:, 2], climb),
        ("descent", -v * ways[:, 2], robot.get("max_descent_mps", climb)),
        ("acceleration", a, accel), ("braking", -a, robot.get("max_brake_mps2", accel)),
        ("across", v**2 * size, across),
    ]  # fmt: skip
    if upright := robot.get("max_vertical_accel_mps2"):  # a corner where it stands has none
        gain = np.where(v > STANDS_MPS, a * ways[:, 2] + v**2 * bends[:, 2], 0.0)
        limits.append(("vertical", np.abs(gain), upright))
    if "max_yaw_rate_dps" in robot:
        yaw = plan["yaw"]
        heads = np.interp(along, yaw["distances_m"], yaw["headings_rad"])
        rate = np.abs(np.diff(heads)) / STEP_S
        s, turn = np.array(yaw["distances_m"]), np.array(yaw["headings_rad"])
        with np.errstate(all="ignore"):
            per = np.abs(np.diff(turn) / np.diff(s))
        piece = np.clip(np.searchsorted(s, along, side="right") - 1, 0, len(per) - 1)
        rate = np.where(np.isfinite(per[piece]), per[piece] * v, 0.0)
        limits.append(("yaw rate", rate, math.radians(robot["max_yaw_rate_dps"])))
    for word, values, most in limits:
        if values.max() > most * (1 + 3e-3) + 1e-4:
            k = int(values.argmax())
            yield word, (f"{values[k]:.4f} at {times[k]:.2f} s, {along[k]:.2f} m, "
                         f"at most {most:.4f}")  # fmt: skip
    places = at(curve.places)
    for zone in asked.data["world"].get("speed_zones", ()):
        inside = shapely.contains_xy(shapely.Polygon(zone["polygon"]).buffer(-1e-3),
                                     *places[:, :2].T)  # fmt: skip
        if inside.any() and v[inside].max() > zone["max_speed_mps"] * (1 + 1e-3) + 1e-4:
            yield "zone", f"{v[inside].max():.4f} m/s in one of {zone['max_speed_mps']}"
    if asked.things(("known",), moving=True):
        told = plan["certificate"]["moving"]["clearance_m"]
        free = asked.free_of_moving(places, times, ("known",), grown=True)
        if told is not None and free.min() < told - 2e-3:
            yield "moving", f"{free.min():.4f} m at {times[free.argmin()]:.2f} s, {told:.4f} proven"
        if told is None and math.isfinite(free.min()):
            yield "moving", "something is there, nothing is said of it"
        least = robot["clearance_m"]  # beside how far it gets from its path, which is taken off
        if told is not None and told < least - 1e-6:
            yield "moving", f"{told:.4f} m proven, {least} asked"


def row_faults(asked: AskedFlight, plan: dict[str, Any], rows: np.ndarray) -> Faults:
    """The table against itself and the limits, by differences."""
    robot, t = asked.robot, rows["time_s"]
    steps = np.diff(t)
    if (steps < -1e-9).any():
        yield "rows", "time goes back"
    moves = steps > 1e-3
    at = np.column_stack([rows["x_m"], rows["y_m"], rows["z_m"]])
    gone = np.linalg.norm(np.diff(at, axis=0), axis=1)[moves] / steps[moves]
    rise = np.diff(at[:, 2])[moves] / steps[moves]
    climb = robot.get("max_climb_mps", robot["max_speed_mps"])
    for word, values, most in (
        ("rows speed", gone, robot["max_speed_mps"]), ("rows climb", rise, climb),
        ("rows descent", -rise, robot.get("max_descent_mps", climb)),
    ):  # fmt: skip
        if values.size and values.max() > most * (1 + 3e-3) + 2e-3:
            yield word, f"{values.max():.4f}, at most {most:.4f}"
    known = np.isfinite(rows["agl_m"])
    off = np.abs(at[:, 2] - asked.ground_at(at) - rows["agl_m"])[known]
    if off.size and not off.max() < 2e-3:
        yield "rows agl", f"{off.max():.4f} m off"


def stop_faults(asked: AskedFlight, plan: dict[str, Any]) -> Faults:
    """Dwells that aren't kept."""
    law, route = plan["trajectory"]["law"], asked.data["route"]
    t, s = np.array(law["times_s"]), np.array(law["distances_m"])
    if abs(t[-1] - t[0] - plan["trajectory"]["duration_s"]) > 1e-6:
        yield "duration", f"{t[-1] - t[0]} s and {plan['trajectory']['duration_s']} s"
    if abs(t[0] - route.get("depart_s", 0.0)) > 1e-9:
        yield "depart", f"sets out at {t[0]} s"
    dwells = [(asked.of_point(point), point["dwell_s"]) for point in route["via"]
              if point.get("dwell_s") and "gate" not in point]  # fmt: skip
    for via in users(plan):
        for place, dwell in dwells:
            if np.allclose(via["at"], place, rtol=0, atol=1e-9):
                there = t[np.abs(s - via["distance_m"]) < 1e-6]
                if not there.size or there[-1] - there[0] < dwell - 1e-6:
                    yield "dwell", f"{np.ptp(there) if there.size else 0} s of {dwell} at {place}"
