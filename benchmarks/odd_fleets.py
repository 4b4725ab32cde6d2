"""Small random fleets of odd kinds, planned and driven with trouble, beside an oracle of samples.

    python benchmarks/odd_fleets.py [FLEETS] [--seed 1] [--drives 1] [--first 0]

Discs, footprints and robots with a turning circle; routes, stations, laps and patrols that never
end; priorities, departures, robots that leave; worlds with walls and corridors. Each is planned,
read again after it was saved, simulated with random delays, and driven by FleetNavigator with
reports and commands that get lost, robots that die, are taken out, added and sent elsewhere. The
oracle knows paths and laws alone: where every robot is every 10 ms, and its path every centimetre.
"""

from __future__ import annotations

import argparse
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from odd_fleet_drives import NavigatorDrive

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.saved.course_record import CourseRecord
from viaspline.formats.fleet_yaml import fleet_text
from viaspline.report.files.fleet_json import fleet_json
from viaspline.report.files.fleet_results import folder_names, write_robots

TICK_S = 0.01
"""From sample to sample."""
SLACK_M = 2e-6
"""What a sample may be nearer than is proven: rounding."""
BOX = 24.0
KINDS: dict[str, dict[str, Any]] = {
    "disc": {"radius_m": 0.4, "clearance_m": 0.1},
    "swift": {"radius_m": 0.25, "clearance_m": 0.05, "max_speed_mps": 3.0},
    "slow": {"radius_m": 0.6, "clearance_m": 0.1, "max_speed_mps": 0.6, "max_accel_mps2": 0.3},
    "long": {"footprint": [[-0.9, -0.3], [0.9, -0.3], [0.9, 0.3], [-0.9, 0.3]], "clearance_m": 0.1},
    "turner": {"radius_m": 0.4, "clearance_m": 0.1, "min_turn_radius_m": 1.5},
    "car": {
        "radius_m": 0.5, "clearance_m": 0.1,
        "drive": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 30}},
    },
    "smooth": {"radius_m": 0.4, "clearance_m": 0.1, "max_jerk_mps3": 1.0},
}  # fmt: skip


def random_fleet(random: np.random.Generator) -> dict[str, Any]:
    """What is asked of a fleet; it may have faults."""
    corridor = random.random() < 0.3
    height = float(random.choice([2.6, 3.4, 5.0])) if corridor else BOX
    known: list[dict[str, Any]] = []
    if not corridor:
        for k in range(int(random.integers(0, 5))):
            center = random.uniform(3.0, BOX - 3.0, 2).tolist()
            radius = float(random.uniform(0.3, 2.0))
            known.append({"name": f"post {k}", "circle": {"center": center, "radius": radius}})
    world: dict[str, Any] = {"known": known}
    if corridor or random.random() < 0.5:
        world["bounds"] = [-1.0, -1.0, BOX + 1.0, height]
    names = [str(name) for name in random.choice(list(KINDS), 3)]
    top = height - 1.2 if corridor else BOX
    low = 0.2 if corridor else 0.0
    members = []
    for k in range(int(random.integers(2, 7))):
        points = np.column_stack(
            [random.uniform(0.0, BOX, 5), random.uniform(low, max(top, low + 0.1), 5)]
        )
        members.append(_member(random, k, points.round(2).tolist(), str(random.choice(names))))
    return {
        "separation_m": float(random.choice([0.0, 0.2, 0.5, 1.0])),
        "world": world,
        "robots": {name: KINDS[name] for name in names},
        "fleet": members,
    }


def _member(
    random: np.random.Generator, k: int, points: list[list[float]], kind: str
) -> dict[str, Any]:
    """A robot: a drive, a drive past stations, laps, or a patrol."""
    start, one, two, three, goal = points
    what = random.random()
    via: list[Any] = [[], [one], [one, two]][int(random.integers(0, 3))]
    if random.random() < 0.3:
        via = [{"at": place, "dwell_s": float(random.choice([0.5, 4.0]))} for place in via]
    route: dict[str, Any] = {"start": start, "via": via, "goal": goal}
    if what > 0.7:
        route = {"start": start, "via": [*(via or [one]), three], "closed": True}
        if what < 0.85:
            route["laps"] = int(random.integers(1, 4))
    return {
        "name": f"r{k}",
        "robot": kind,
        "route": route,
        "priority": float(random.integers(0, 3)),
        "depart_s": float(random.choice([0.0, 0.0, 3.0, 20.0])),
        "rest": "leave" if random.random() < 0.3 else "stay",
    }


def body_radius(mission: vs.Mission) -> float:
    """Of the circle about a body [m]."""
    footprint = mission.robot.footprint
    if footprint is None:
        return float(mission.robot.radius_m)
    return float(np.hypot(*np.array(footprint, float).T).max())


def faults_of_plan(plan: FleetPlan) -> Iterator[str]:
    """What of a plan isn't as it has to be, by samples."""
    members = {one.name: one for one in plan.fleet.members}
    for name, one in plan.plans.items():
        yield from _faults_of_path(name, one)
        yield from _faults_of_law(name, one, members[name])
    end = max((one.trajectory.end_time for one in plan.plans.values()), default=0.0)
    times = np.arange(-1.0, end + 1.0, TICK_S)
    places = {}
    for name, member in members.items():
        if name not in plan.plans:
            places[name] = np.tile(
                np.array(member.mission.route.start.at[:2], float), (len(times), 1)
            )
            continue
        one = plan.plans[name]
        places[name] = np.array(one.path.at_distance(one.trajectory.distance_at(times)))
        if member.rest == "leave" and not member.mission.route.is_patrol:
            places[name][times > one.trajectory.end_time] = np.nan
    yield from too_near(
        places, {n: body_radius(m.mission) for n, m in members.items()}, plan.fleet.separation_m,
        times, "planned", set(plan.plans),
    )  # fmt: skip


def too_near(
    places: dict[str, Any], radii: dict[str, float], separation: float, times: Any, what: str,
    moving: set[str],
) -> Iterator[str]:  # fmt: skip
    """Pairs of robots one of which moves, that come too near each other."""
    names = list(places)
    for i, one in enumerate(names):
        for other in names[:i]:
            if not {one, other} & moving:
                continue
            gap = np.hypot(*(places[one] - places[other]).T) - radii[one] - radii[other]
            if np.isfinite(gap).any() and np.nanmin(gap) < separation - SLACK_M:
                k = int(np.nanargmin(gap))
                yield f"{what}: {one} and {other} {gap[k]:.4f} m apart at {times[k]:.2f} s"


def _faults_of_path(name: str, plan: vs.Plan) -> Iterator[str]:
    """Clearance of a disc to posts and bounds, every centimetre."""
    mission, path = plan.mission, plan.path
    count = max(int(path.length / 0.01), 2)
    places = np.array(path.at_distance(np.linspace(0.0, path.length, count)))
    robot = mission.robot
    if robot.footprint is not None:
        return
    kept = float(robot.radius_m) + robot.clearance_m - SLACK_M
    for one in mission.world.known:
        gap = np.hypot(*(places - np.array(one.circle.center)).T).min() - one.circle.radius
        if gap < kept:
            yield f"path: {name} {gap - kept:.4f} m too near to {one.name}"
    if mission.world.bounds is not None:
        x0, y0, x1, y1 = mission.world.bounds
        x, y = places.T
        gap = min((x - x0).min(), (x1 - x).min(), (y - y0).min(), (y1 - y).min())
        if gap < kept:
            yield f"path: {name} {gap - kept:.4f} m too near to the bounds"
    points = [point.at[:2] for _, point in mission.route.points()]
    for point in points:
        if np.hypot(*(places - np.array(point)).T).min() > 0.011:
            yield f"path: {name} misses {point}"


def _faults_of_law(name: str, plan: vs.Plan, member: vs.FleetMember) -> Iterator[str]:
    """Speed, acceleration, departure and stations, every 10 ms."""
    law, robot = plan.trajectory, plan.mission.robot
    times = np.arange(law.start_time, law.end_time + TICK_S, TICK_S)
    along = np.asarray(law.distance_at(times))
    speed = np.diff(along) / TICK_S
    if (speed < -1e-9).any():
        yield f"law: {name} goes back"
    if speed.max(initial=0.0) > robot.max_speed_mps * (1.0 + 1e-6):
        yield f"law: {name} drives {speed.max():.3f} m/s"
    rise = np.abs(np.diff(speed)).max(initial=0.0) / TICK_S
    most = max(robot.max_accel_mps2, robot.max_brake_mps2 or 0.0)
    if rise > most * 1.001 + 1e-4:
        yield f"law: {name} accelerates by {rise:.3f} m/s² where {most} are allowed"
    if float(law.distance_at(member.mission.route.depart_s)) > 1e-9:
        yield f"law: {name} sets out before it departs"
    if abs(float(law.distances[-1]) - plan.path.length) > 1e-6:
        yield f"law: {name} doesn't arrive"
    for via, distance in zip(plan.path.vias, plan.path.via_distances, strict=True):
        if via.dwell > 0.0:
            stood = (np.abs(along - distance) < 1e-6).sum() * TICK_S
            if stood < via.dwell - 2 * TICK_S:
                yield f"law: {name} stays {stood:.2f} s at {via.name} and not {via.dwell} s"


def faults_of_run(plan: FleetPlan, run: Any) -> Iterator[str]:
    """What of a simulated drive isn't as it has to be."""
    members = {one.name: one for one in plan.fleet.members}
    if run.deadlock or not set(plan.plans) <= set(run.arrivals):
        yield f"run: deadlock of {run.deadlock}, {sorted(set(plan.plans) - set(run.arrivals))}"
    times = np.arange(-1.0, run.end_s + 1.0, TICK_S)
    places = {}
    for name in plan.plans:
        along = run.distance_at(name, times)
        places[name] = np.array(plan.plans[name].path.at_distance(along))
        member = members[name]
        if member.rest == "leave" and not member.mission.route.is_patrol:
            places[name][times > run.arrivals.get(name, np.inf)] = np.nan
        if float(run.distance_at(name, np.array([member.mission.route.depart_s - 0.01]))[0]) > 1e-6:
            yield f"run: {name} sets out before it departs"
    for name, member in members.items():
        if name not in plan.plans:
            places[name] = np.tile(
                np.array(member.mission.route.start.at[:2], float), (len(times), 1)
            )
    yield from too_near(
        places, {n: body_radius(m.mission) for n, m in members.items()}, plan.fleet.separation_m,
        times, "run", set(plan.plans),
    )  # fmt: skip


def save_without_picture(plan: FleetPlan, folder: Path) -> None:
    """What ``plan.save`` writes, but for the picture, which takes longer than all else."""
    names = folder_names(one.name for one in plan.fleet.members)
    (folder / "fleet.json").write_text(fleet_json(plan, "fleet", names))
    (folder / "courses.npz").write_bytes(CourseRecord.of(plan).to_bytes())
    (folder / "planned-fleet.yaml").write_text(fleet_text(plan.fleet, folder), "utf-8")
    write_robots(plan, folder, lambda share: None)


def faults_of(fleet: vs.Fleet, seed: int, drives: int, counts: dict[str, int]) -> Iterator[str]:
    """All that is wrong with a fleet's plan and drives."""
    plan = vs.plan_fleet(fleet)
    counts["robots"] += len(fleet.members)
    counts["served"] += len(plan.plans)
    if not plan.certificate.holds:
        yield "certificate doesn't hold"
    yield from faults_of_plan(plan)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        save_without_picture(plan, Path(folder))
        if vs.load_fleet_plan(folder) != plan:
            yield "another plan is loaded than was saved"
    if not plan.plans:
        return
    for k in range(drives):
        delays = vs.Delays(slowed=0.3 * (k % 2), halts=1.0, halts_s=10.0, lost=0.2 * (k % 3 == 0))
        run = vs.simulate_fleet(fleet, delays, plan, seed=seed + k)
        yield from faults_of_run(plan, run)
        drive = NavigatorDrive(plan, np.random.default_rng([seed, k]))
        yield from drive.faults()
        for kind, count in drive.happened.items():
            counts[kind] = counts.get(kind, 0) + count


def main() -> None:
    """Plan and drive random fleets, and say what is wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fleets", nargs="?", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--drives", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="after this one of the seed's")
    asked = parser.parse_args()
    counts, wrong, k, done = {"robots": 0, "served": 0, "faulty missions": 0}, 0, asked.first, 0
    while done < asked.fleets:
        k += 1
        data = random_fleet(np.random.default_rng([asked.seed, k]))
        try:
            fleet = vs.Fleet.model_validate(data)
        except vs.MissionError:
            counts["faulty missions"] += 1
            continue
        done += 1
        try:
            faults = list(faults_of(fleet, k, asked.drives, counts))
        except Exception as error:  # whatever it is, it is told with its fleet
            faults = [f"{type(error).__name__}: {error}"]
        for fault in faults:
            wrong += 1
            print(f"fleet {asked.seed}:{k}: {fault}", flush=True)
    print(f"{done} fleets, {wrong} faults: " + ", ".join(f"{n} {w}" for w, n in counts.items()))


if __name__ == "__main__":
    main()
