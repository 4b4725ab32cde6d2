"""What a change of the code changed: every byte of plan.json and run.json, before and after.

    python benchmarks/fingerprints.py lay DIR [--missions 1000] [--jobs 2] [--only FAMILY]
    python benchmarks/fingerprints.py compare OLD NEW

``lay`` plans or drives all examples, flights and fleets too, and as many random missions of eight
families, keeps the files in DIR, and their SHA-256 in DIR/SHA256SUMS. A refusal is a file too: its
words. ``compare`` tells files that are the same to the byte, those in which every number is the
same to 1e-9, and the rest.
Bytes are those of one machine and one numpy: lay both on the same.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import math
import re
import sys
from collections import Counter
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from work_pool import done

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")
PLACE = re.compile(r"route\.(?:(?P<end>start|goal)|via\[(?P<via>\d+)\])\.at")
TOLERANCE = 1e-9


def discs(rng: np.random.Generator, count: int, size: float, least: float, most: float) -> list:
    return [
        {"circle": {"center": rng.uniform(0, size, 2).tolist(), "radius": float(radius)}}
        for radius in rng.uniform(least, most, count)
    ]


def polygon(rng: np.random.Generator, size: float, least: float, most: float) -> dict[str, Any]:
    """A star-shaped polygon, mostly not convex."""
    corners = int(rng.integers(3, 9))
    angles = (np.arange(corners) + rng.uniform(0, 0.8, corners)) * math.tau / corners
    reach = rng.uniform(least, most, corners)[:, None]
    ring = rng.uniform(0, size, 2) + reach * np.column_stack((np.cos(angles), np.sin(angles)))
    return {"polygon": ring.tolist()}


def route(rng: np.random.Generator, size: float, fewest: int = 2, most: int = 6) -> dict[str, Any]:
    """Some places, now and then closed, with headings or stations."""
    places = rng.uniform(0.02 * size, 0.98 * size, (int(rng.integers(fewest, most + 1)), 2))
    start: dict[str, Any] = {"at": places[0].tolist()}
    vias: list[Any] = [place.tolist() for place in places[1:]]
    if rng.random() < 0.3:
        start["heading_deg"] = float(rng.uniform(-180, 180))
    if len(vias) > 1 and rng.random() < 0.4:
        vias[0] = {"at": vias[0], "dwell_s": float(rng.uniform(1, 20)), "name": "station"}
    if len(places) > 2 and rng.random() < 0.3:
        return {"start": start, "via": vias, "closed": True}
    return {"start": start, "via": vias[:-1], "goal": vias[-1]}


def vector(rng: np.random.Generator) -> dict[str, Any]:
    """A few discs and polygons, fences and zones now and then, every kind of spline."""
    known: list[Any] = discs(rng, int(rng.integers(0, 8)), 100, 2, 9)
    known += [polygon(rng, 100, 2, 10) for _ in range(int(rng.integers(0, 6)))]
    for obstacle in known:
        if rng.random() < 0.1:
            obstacle["pass_on"] = str(rng.choice(["left", "right"]))
    spline: dict[str, Any] = {"tension": float(rng.uniform(-0.5, 0.8))}
    spline["knots"] = str(rng.choice(["uniform", "centripetal", "chordal"]))
    if rng.random() < 0.3:
        spline["tangents"] = "continuous"
    world: dict[str, Any] = {"known": known}
    if rng.random() < 0.4:
        world["bounds"] = [0, 0, 100, 100]
    if rng.random() < 0.2:
        world["fences"] = [[[-5, -5], [105, -5], [105, 50], [90, 60], [105, 70], [105, 105],
                            [-5, 105]]]  # fmt: skip
    if rng.random() < 0.3:
        world["speed_zones"] = [{"polygon": [[20, 20], [70, 20], [70, 60]], "max_speed_mps": 0.7}]
    robot: dict[str, Any] = {"radius_m": 0.5, "clearance_m": float(rng.choice([0, 0.5, 2]))}
    if rng.random() < 0.5:
        robot["max_lateral_accel_mps2"] = 0.5
    if rng.random() < 0.2:
        robot["max_jerk_mps3"] = 1.0
    asked = route(rng, 100)
    if asked.get("closed") and rng.random() < 0.5:
        asked["laps"] = 3
    return {"world": world, "robot": robot, "route": asked, "spline": spline}


def clutter(rng: np.random.Generator) -> dict[str, Any]:
    """A hundred obstacles and more, between which a robot gets through in some places."""
    known: list[Any] = discs(rng, int(rng.integers(40, 120)), 100, 0.5, 2.5)
    known += [polygon(rng, 100, 0.5, 4) for _ in range(int(rng.integers(0, 60)))]
    robot = {"radius_m": float(rng.choice([0.0, 0.3, 0.8])), "clearance_m": 0.2}
    world = {"known": known, "bounds": [0, 0, 100, 100]}
    return {"world": world, "robot": robot, "route": route(rng, 100, 2, 4)}


def cells(rng: np.random.Generator, count: int, part: float, grain: int) -> np.ndarray:
    """Blocked squares in blobs of about ``grain`` cells."""
    rough = rng.random((count // grain + 1, count // grain + 1)) < part
    return np.kron(rough, np.ones((grain, grain), bool))[:count, :count]


def maps(rng: np.random.Generator) -> dict[str, Any]:
    """An occupancy grid, turned now and then, sometimes with a disc or another grid beside it."""
    from viaspline import Grid

    count, side = int(rng.choice([30, 60, 120])), float(rng.choice([0.25, 0.5, 1.0]))
    yaw = float(rng.choice([0.0, 0.0, 0.3]))
    blocked = cells(rng, count, float(rng.uniform(0.05, 0.3)), int(rng.choice([1, 2, 5])))
    known: list[Any] = [{"grid": Grid(blocked, side, (0.0, 0.0, yaw))}]
    if rng.random() < 0.4:
        known += discs(rng, 2, count * side, 0.2, 2)
    if rng.random() < 0.2:
        known.append({"grid": Grid(cells(rng, 20, 0.2, 2), 0.7 * side, (5.0, 5.0, 0.1))})
    robot = {"radius_m": float(rng.choice([0.1, 0.3, 0.49])) * side, "clearance_m": 0.0}
    return {"world": {"known": known}, "robot": robot, "route": route(rng, count * side, 2, 4)}


def circles(rng: np.random.Generator) -> dict[str, Any]:
    """A turning circle."""
    size, circle = float(rng.choice([20, 60, 200])), float(rng.choice([1, 3, 6]))
    known: list[Any] = discs(rng, int(rng.integers(0, 8)), size, 0.02 * size, 0.08 * size)
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": circle}
    return {"world": {"known": known}, "robot": robot, "route": route(rng, size)}


def bodies(rng: np.random.Generator) -> dict[str, Any]:
    """A footprint, with a turning circle now and then."""
    size = float(rng.choice([20, 60]))
    known: list[Any] = discs(rng, int(rng.integers(1, 7)), size, 0.02 * size, 0.08 * size)
    known += [polygon(rng, size, 0.02 * size, 0.1 * size) for _ in range(int(rng.integers(0, 4)))]
    robot: dict[str, Any] = {
        "footprint": [[-0.4, -0.3], [0.9, -0.3], [0.9, 0.3], [-0.4, 0.3]], "clearance_m": 0.2,
    }  # fmt: skip
    if rng.random() < 0.4:
        robot["min_turn_radius_m"] = 1.5
    return {"world": {"known": known}, "robot": robot, "route": route(rng, size, 2, 4)}


def replans(rng: np.random.Generator) -> dict[str, Any]:
    """A range sensor and things that are not on the map."""
    mission = vector(rng)
    unseen: list[Any] = discs(rng, int(rng.integers(1, 6)), 100, 1, 5)
    unseen += [polygon(rng, 100, 1, 5) for _ in range(int(rng.integers(0, 3)))]
    mission["world"]["unseen"] = unseen
    mission["robot"]["sensor"] = {"range_m": float(rng.choice([8, 20, 40]))}
    mission["robot"].pop("max_jerk_mps3", None)
    if rng.random() < 0.3:
        mission["robot"]["min_turn_radius_m"] = 2.0
    return mission


def lidars(rng: np.random.Generator) -> dict[str, Any]:
    """Posts that only beams find, on a map now and then."""
    unseen: list[Any] = discs(rng, int(rng.integers(4, 25)), 20, 0.1, 0.6)
    unseen += [polygon(rng, 20, 0.2, 1.0) for _ in range(int(rng.integers(0, 4)))]
    lidar = {"range_m": 5, "fov_deg": float(rng.choice([180, 270, 360])), "beams": 360}
    lidar["noise_m"] = float(rng.choice([0.0, 0.01]))
    robot = {"radius_m": 0.15, "clearance_m": 0.05, "max_speed_mps": 1, "sensor": {"lidar": lidar}}
    return {"world": {"unseen": unseen}, "robot": robot, "route": route(rng, 20, 2, 3)}


def drives(rng: np.random.Generator) -> dict[str, Any]:
    """Machines with delay, lag and noise, and something in their way."""
    kinds: dict[str, Any] = {
        "differential": {"track_m": 0.5, "max_wheel_speed_mps": 1.5},
        "skid_steer": {"track_m": 0.6, "slip": 0.2},
        "ackermann": {"wheelbase_m": 0.8, "max_steer_deg": 35, "max_steer_rate_degps": 60},
    }
    kind = str(rng.choice(sorted(kinds)))
    drive = {kind: kinds[kind], "delay_s": 0.05, "lag_s": float(rng.choice([0.0, 0.1]))}
    drive["speed_noise_mps"] = float(rng.choice([0.0, 0.02]))
    robot: dict[str, Any] = {"radius_m": 0.4, "clearance_m": 0.3, "drive": drive}
    robot["max_speed_mps"] = 1.2
    robot["sensor"] = {"range_m": 10}
    if rng.random() < 0.5:
        robot["localization"] = {"position_noise_m": 0.01, "heading_noise_deg": 0.5}
    world = {"known": discs(rng, 3, 40, 1, 3), "unseen": discs(rng, 2, 40, 0.5, 2)}
    return {"world": world, "robot": robot, "route": route(rng, 40, 2, 4)}


FAMILIES = {  # how many of a thousand, and whether they are driven
    vector: (250, False),
    clutter: (100, False),
    maps: (150, False),
    circles: (150, False),
    bodies: (80, False),
    replans: (150, True),
    lidars: (70, True),
    drives: (50, True),
}


def random_jobs(missions: int) -> list[tuple[str, int, bool]]:
    return [
        (family.__name__, seed, driven)
        for family, (share, driven) in FAMILIES.items()
        for seed in range(max(1, round(share * missions / 1000)))
    ]


def example_jobs() -> list[tuple[str, int, bool]]:
    names = sorted(path.name for path in EXAMPLES.glob("*.*") if path.suffix in (".yaml", ".plan"))
    return [(name, 0, True) for name in names]


def plan_text(plan: Any, name: str) -> str:
    """What is written of a plan, in the plane or in space."""
    from viaspline.report.files.plan_json import plan_json
    from viaspline.report.space.spatial_json import spatial_plan_json
    from viaspline.space.spatial_plan import SpatialPlan

    if isinstance(plan, SpatialPlan):
        return spatial_plan_json(plan, name)
    return plan_json(plan, name, spacing=0.1)


def run_text(run: Any, name: str) -> str:
    """What is written of a drive, in the plane or in space."""
    from viaspline.report.files.run_json import run_json
    from viaspline.report.space.spatial_json import flight_json
    from viaspline.space.spatial_run import SpatialRun

    return flight_json(run, name) if isinstance(run, SpatialRun) else run_json(run, name)


def fleet_texts(fleet: Any, name: str, driven: bool) -> dict[str, str]:
    """The files of a fleet and of each of its robots."""
    import viaspline as vs
    from viaspline.report.files.fleet_json import fleet_json
    from viaspline.report.files.fleet_run_json import fleet_run_json

    plan = vs.plan_fleet(fleet)
    found = {"fleet.json": fleet_json(plan, name, {robot: robot for robot in plan.plans})}
    found |= {f"{robot}.json": plan_text(one, robot) for robot, one in plan.plans.items()}
    if driven:
        found["run.json"] = fleet_run_json(vs.simulate_fleet(fleet, plan=plan), name)
    return found


def texts(mission: Any, name: str, driven: bool) -> dict[str, str]:
    """The files of a mission or a fleet, or the words of its refusal."""
    import viaspline as vs

    found: dict[str, str] = {}
    try:
        if isinstance(mission, vs.Fleet):
            return fleet_texts(mission, name, driven)
        plan = vs.plan(mission)
        found["plan.json"] = plan_text(plan, name)
        if driven:
            found["run.json"] = run_text(vs.simulate(mission, plan=plan), name)
    except vs.NoPathError as error:
        record = {"reason": error.reason, "where": error.where, "remedy": error.remedy,
                  "via": error.via, "obstacles": error.obstacles,
                  "changes": [[change.key, change.value] for change in error.changes]}  # fmt: skip
        found["refused.json"] = json.dumps(record, indent=1)
    except vs.ViasplineError as error:
        found["refused.json"] = json.dumps({type(error).__name__: str(error)}, indent=1)
    return found


def mended(data: dict[str, Any], tries: int = 4) -> Any:
    """A mission whose via points have room: those without are moved to where they are told to."""
    import viaspline as vs

    for _ in range(tries):
        try:
            return vs.Mission.model_validate(data)
        except vs.MissionError as error:
            for change in [change for fault in error.faults for change in fault.changes]:
                place = PLACE.fullmatch(change.key)
                if place is None or not isinstance(change.value, tuple):
                    continue
                where = data["route"]
                key: Any = place["end"] or "via"
                if place["via"] is not None:
                    where, key = where["via"], int(place["via"])
                if isinstance(where[key], dict):
                    where[key]["at"] = list(change.value)
                else:
                    where[key] = list(change.value)
    return vs.Mission.model_validate(data)


def do(folder: Path, job: tuple[str, int, bool]) -> list[str]:
    import viaspline as vs

    name, seed, driven = job
    families = {family.__name__: family for family in FAMILIES}
    if name in families:
        label = f"{name}-{seed:03d}"
        rng = np.random.default_rng([list(families).index(name), seed])
        try:
            mission = mended(families[name](rng))
        except vs.MissionError as error:
            written = {"refused.json": json.dumps({"MissionError": str(error)}, indent=1)}
        else:
            written = texts(mission, label, driven)
    else:
        label = Path(name).stem
        written = texts(vs.load(EXAMPLES / name), label, driven)
    lines = []
    for kind, text in written.items():
        (folder / f"{label}.{kind}").write_text(text)
        lines.append(f"{hashlib.sha256(text.encode()).hexdigest()}  {label}.{kind}")
    return lines


def lay(folder: Path, missions: int, jobs: int, only: str | None) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for stale in folder.glob("*.json"):
        stale.unlink()
    todo = [job for job in example_jobs() + random_jobs(missions) if only in (None, job[0])]
    lines: list[str] = []
    for count, (job, found) in enumerate(
        done(partial(do, folder), todo, jobs, math.inf, math.inf), 1
    ):
        lines += [f"{'died':64}  {job[0]}-{job[1]:03d}"] if found is None else found
        if count % 20 == 0 or count == len(todo):
            print(f"{count} of {len(todo)}", file=sys.stderr, flush=True)
    lines.sort(key=lambda line: line.split()[1])
    (folder / "SHA256SUMS").write_text("\n".join(lines) + "\n")
    print(hashlib.sha256("\n".join(lines).encode()).hexdigest(), f"{len(lines)} files")


def difference(old: str, new: str) -> float:
    """The largest difference of any number, relative above 1; infinite if words differ."""
    if NUMBER.sub("#", old) != NUMBER.sub("#", new):
        return math.inf
    pairs = zip(NUMBER.findall(old), NUMBER.findall(new), strict=True)
    return max((abs(float(a) - float(b)) / max(1.0, abs(float(a))) for a, b in pairs), default=0.0)


def compare(old: Path, new: Path) -> bool:
    names = {path.name for folder in (old, new) for path in folder.glob("*.json")}
    told: Counter[str] = Counter()
    for name in sorted(names):
        if not (old / name).exists() or not (new / name).exists():
            told["only in one"] += 1
            print(f"{name}: only in {old if (old / name).exists() else new}")
            continue
        before, after = (old / name).read_text(), (new / name).read_text()
        apart = 0.0 if before == after else difference(before, after)
        same = before == after
        told["same bytes" if same else "same to 1e-9" if apart <= TOLERANCE else "different"] += 1
        if apart > TOLERANCE:
            print(f"{name}: {'other words' if apart == math.inf else f'differs by {apart:.3g}'}")
    print(", ".join(f"{count} {what}" for what, count in sorted(told.items())))
    return not told["different"] and not told["only in one"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    verbs = parser.add_subparsers(dest="verb", required=True)
    laid = verbs.add_parser("lay")
    laid.add_argument("folder", type=Path)
    laid.add_argument("--missions", type=int, default=1000)
    laid.add_argument("--jobs", type=int, default=2)
    laid.add_argument("--only")
    compared = verbs.add_parser("compare")
    compared.add_argument("old", type=Path)
    compared.add_argument("new", type=Path)
    asked = parser.parse_args()
    if asked.verb == "lay":
        lay(asked.folder, asked.missions, asked.jobs, asked.only)
    elif not compare(asked.old, asked.new):
        sys.exit(1)


if __name__ == "__main__":
    main()
