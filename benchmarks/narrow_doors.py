"""Bodies through a door that is hardly wider than they are, with things in the rooms before it.

    python benchmarks/narrow_doors.py [MISSIONS [FIRST [LEAST_M MOST_M]]]

A yard of 60 m by 40 m that a wall divides, with one door: ``LEAST_M`` to ``MOST_M`` wider than the
body with its clearance (0.06 to 0.5). Two to five discs and boxes stand about, now and then right
behind the door, where no body gets past. Carts with two wheels and cars, five places to go to. A
line for each mission: what came of it, by the processor's time, and how near the body comes to
anything on its path by shapely, which shares nothing with the planner.
"""

from __future__ import annotations

import sys
import time

import numpy as np
import shapely
from shapely_bodies import bodies_at, shape_of

import viaspline as vs

WIDE_M, HIGH_M = 60.0, 40.0
CLEARANCE_M = 0.2
SAMPLE_M = 0.05
"""Between places of a path at which the body is looked at [m]."""


def robot(rng: np.random.Generator) -> tuple[dict, float, float]:
    """A cart or a car, how long it is and how wide [m]."""
    length, width = rng.uniform(1.5, 3.5), rng.uniform(0.6, 1.4)
    ahead, behind, half = 0.8 * length, -0.2 * length, 0.5 * width
    body = [[behind, -half], [ahead, -half], [ahead, half], [behind, half]]
    if rng.random() < 0.4:
        drive: dict = {"drive": {"differential": {"track_m": 0.8 * width}}}
    else:
        steered = {"wheelbase_m": 0.6 * length, "max_steer_deg": float(rng.choice([25, 32, 40]))}
        noise = {"position_noise_m": 0.02, "heading_noise_deg": 0.5}
        drive = {
            "drive": {"ackermann": steered, "delay_s": 0.1, "lag_s": 0.1},
            "localization": noise,
        }
    limits = {"max_speed_mps": 2, "max_accel_mps2": 1, "max_lateral_accel_mps2": 0.8}
    return {"footprint": body, "clearance_m": CLEARANCE_M, **limits, **drive}, length, width


def yard(rng: np.random.Generator, length: float, door: float) -> tuple[list, float, float]:
    """What stands in it, and where its wall begins and ends [m]."""
    x, y, thick = rng.uniform(22, 38), rng.uniform(8, 32), rng.uniform(0.5, 3.0)
    low, high = y - 0.5 * door, y + 0.5 * door
    walls = [
        {"name": "south", "polygon": [[x, 0], [x + thick, 0], [x + thick, low], [x, low]]},
        {"name": "north", "polygon": [[x, high], [x + thick, high], [x + thick, 40], [x, 40]]},
    ]
    things = []
    for k in range(int(rng.integers(2, 6))):
        at, size = rng.uniform([5, 4], [55, 36]), rng.uniform(1, 3)
        if abs(at[0] - x) < size + 4:
            continue
        (west, south), (east, north) = at - size, at + size * np.array([1.0, 0.6])
        ring = [[west, south], [east, south], [east, north], [west, north]]
        disc = {"circle": {"center": at.tolist(), "radius": size}}
        things.append({"name": f"o{k}", **(disc if rng.random() < 0.6 else {"polygon": ring})})
    return [*walls, *things], x, x + thick


def mission(seed: int, least: float, most: float) -> vs.Mission:
    """A mission of a seed; a place that would lie in the way of something is drawn again."""
    rng = np.random.default_rng(seed)
    asked, length, width = robot(rng)
    known, west, east = yard(rng, length, width + 2 * CLEARANCE_M + rng.uniform(least, most))
    taken = [shape_of(vs.Obstacle.model_validate(one)) for one in known]
    places: list[list[float]] = []
    for is_west in (True, True, rng.random() < 0.5, False, False):
        low, high = (4, west - 4) if is_west else (east + 4, 56)
        at = rng.uniform([low, 4], [high, 36])
        while min(one.distance(shapely.Point(at)) for one in taken) < length + width:
            at = rng.uniform([low, 4], [high, 36])
        places.append(at.round(2).tolist())
    headings = [float(each) for each in rng.choice([0, 90, 180, 270], 2)]
    start, *vias, goal = [{"at": at} for at in places]
    start["heading_deg"] = headings[0]
    if rng.random() < 0.5:
        goal["heading_deg"] = headings[1]
    world = {"bounds": [0, 0, WIDE_M, HIGH_M], "known": known}
    route = {"start": start, "via": vias, "goal": goal}
    return vs.Mission.model_validate({"world": world, "robot": asked, "route": route})


def nearest(asked: vs.Mission, plan: vs.Plan) -> float:
    """How near the body comes to anything on its path [m]."""
    path = plan.path
    at = np.linspace(*path.domain, int(path.length / SAMPLE_M))
    things = shapely.union_all([shape_of(one) for one in asked.world.known])
    swept = bodies_at(asked.robot.footprint, path.evaluate(at), path.heading(at))
    return float(shapely.distance(things, swept).min())


def main() -> None:
    """A line for each mission, and one for all."""
    said = [*sys.argv[1:], *("20", "7000", "0.06", "0.5")[len(sys.argv) - 1 :]]
    count, first, least, most = int(said[0]), int(said[1]), float(said[2]), float(said[3])
    came: dict[str, int] = {}
    spent, close = [], []
    for seed in range(first, first + count):
        asked = mission(seed, least, most)
        began = time.process_time()
        try:
            plan = vs.plan(asked)
        except vs.ViasplineError as fault:
            kind, told = type(fault).__name__, str(fault).split(":")[0]
        else:
            gap = nearest(asked, plan)
            close += [seed] if gap < CLEARANCE_M else []
            kind = "planned"
            told = f"{plan.trajectory.duration:.2f} s, {gap:.3f} m from what is nearest"
        spent.append(time.process_time() - began)
        came[kind] = came.get(kind, 0) + 1
        print(f"{seed}  {spent[-1]:6.2f} s  {kind}: {told}", flush=True)
    print(f"\n{came}; too close: {close or 'none'}; {np.median(spent):.2f} s in the median, "
          f"{max(spent):.1f} s at most")  # fmt: skip


if __name__ == "__main__":
    main()
