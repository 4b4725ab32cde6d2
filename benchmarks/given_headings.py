"""Paths that begin or end in a given heading: missions that ask for it, and re-plans.

    python benchmarks/given_headings.py [--seed N] [--worlds N]

Random missions (two to five via points and ten discs in 100 m x 100 m), with headings at the start
and at the goal in seven of ten: the driven time, in all and over that of the same mission without
headings. Then random routes of 250 m x 250 m with a disc that comes into the way 20 m ahead of a
robot: the driven time of the whole path that is laid by ``reflex``, over that of the old one, and
how many turn within half a metre behind the place where they leave it. Run it from two checkouts to
compare them.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

import viaspline as vs
from viaspline.machine.machine_limits import limits_of
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning.replan import reflex
from viaspline.world.world import World

SHARP_M = 0.5


def discs(random: np.random.Generator, count: int, size: float, radii: Any) -> list[Any]:
    return [
        {
            "circle": {
                "center": random.uniform(0, size, 2).tolist(),
                "radius": random.uniform(*radii),
            }
        }
        for _ in range(count)
    ]


def asked(random: np.random.Generator) -> tuple[vs.Mission, vs.Mission]:
    """A mission with headings, and the same without."""
    points = random.uniform(10, 90, (random.integers(2, 6), 2)).tolist()
    headings = random.uniform(-180, 180, 2).tolist()
    world = {"known": discs(random, 10, 100.0, (1.0, 4.0))}
    robot = {"radius_m": 0.4, "clearance_m": 0.2, "max_accel_mps2": 1,
             "max_speed_mps": random.uniform(0.5, 4.0)}  # fmt: skip
    if random.random() < 0.4:
        robot["min_turn_radius_m"] = random.uniform(0.5, 3.0)
    ends: list[dict[str, Any]] = [{"at": points[0]}, {"at": points[-1]}]
    free = {"start": dict(ends[0]), "via": points[1:-1], "goal": dict(ends[1])}
    for end, heading in zip(ends, headings, strict=True):
        if random.random() < 0.7:
            end["heading_deg"] = heading
    route = {**free, "start": ends[0], "goal": ends[1]}
    with_headings, without = (
        vs.Mission.model_validate({"world": world, "robot": robot, "route": one})
        for one in (route, free)
    )
    return with_headings, without


def missions(seed: int, count: int) -> None:
    times, ratios, refused = [], [], 0
    for k in range(count):
        try:
            with_headings, free = asked(np.random.default_rng((seed, k)))
            found, least = vs.plan(with_headings), vs.plan(free)
        except vs.ViasplineError:
            refused += 1
            continue
        times.append(found.trajectory.duration)
        ratios.append(times[-1] / least.trajectory.duration)
    middle, high, most = np.percentile(ratios, (50, 95, 100))
    print(f"{len(times)} missions planned, {refused} not: {sum(times):.1f} s in all")
    print(f"over free headings: median {middle:.4f}, 95 % {high:.4f}, worst {most:.4f}")


def under_way(random: np.random.Generator) -> tuple[float, float] | None:
    """The new path's time over the old one's, and the radius of its sharpest turn ahead [m]."""
    stops = random.uniform(20, 230, (random.integers(4, 8), 2)).tolist()
    route = {"start": stops[0], "via": stops[1:-1], "goal": stops[-1]}
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2, "max_accel_mps2": 1}
    if random.random() < 0.5:
        robot["max_lateral_accel_mps2"] = 0.5
    world = {"known": discs(random, 12, 250.0, (2.0, 10.0))}
    share, aside, radius = random.uniform(0, 0.8), random.normal(size=2), random.uniform(1, 4)
    try:
        mission = vs.Mission.model_validate({"world": world, "robot": robot, "route": route})
        plan = vs.plan(mission)
        at = share * plan.path.length
        place = np.asarray(plan.path.at_distance(min(at + 20.0, plan.path.length))) + aside
        disc = vs.Obstacle(circle={"center": place.tolist(), "radius": radius})
        known = World.known(mission).with_obstacles([disc])
        new = reflex(plan.path, at, known, Requirements.of(mission)).path
    except vs.ViasplineError:
        return None
    law = vs.retime(new, limits_of(mission.robot))
    u = np.linspace(float(new.parameter(at)), new.domain[1], 20_001)
    return law.duration / plan.trajectory.duration, float(1.0 / np.abs(new.curvature(u)).max())


def replans(seed: int, count: int) -> None:
    found = [one for k in range(count) if (one := under_way(np.random.default_rng((seed, 1, k))))]
    ratios, radii = np.array(found).T
    middle, high, most = np.percentile(ratios, (50, 95, 100))
    print(f"{len(found)} re-plans, time over the old path's: mean {ratios.mean():.4f}, "
          f"median {middle:.4f}, 95 % {high:.4f}, worst {most:.4f}; "
          f"{(radii <= SHARP_M).sum()} turn within {SHARP_M} m")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--worlds", type=int, default=60)
    options = parser.parse_args()
    missions(options.seed, options.worlds)
    replans(options.seed, options.worlds)


if __name__ == "__main__":
    main()
