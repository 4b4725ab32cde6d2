"""Crossings among recorded people, who are not on the map.

    python benchmarks/people.py FOLDER [--crossings 60] [--safety passive | none]

FOLDER has a recording of the ETH/UCY sets, as ``obsmat.txt``: frame, id, x, z, y, vx, vz, vy, 2.5
frames a second. A robot of radius 0.25 m, 1.5 m/s and 1 m/s² goes from a random place in what was
recorded to another, at a random time; a range sensor of 10 m shows it where people are and how fast
they go. Nobody gives way to it. A drive is clean if it arrives and touches nobody. It is
frozen if it stood for two seconds together though it could have gone on: driving off along its way
in the middle of that would have touched nobody for the next eight seconds, as people really went.
"""

from __future__ import annotations

import argparse
import time as clock
from pathlib import Path

import numpy as np

import viaspline as vs

RADIUS_M, SPEED_MPS, ACCEL_MPS2, REACH_M = 0.25, 1.5, 1.0, 10.0
PERSON_M, FASTEST_MPS = 0.25, 2.5
FRAMES_PER_S = 25.0  # of the film; every tenth is written down
LEAST_M, APART_M = 6.0, 2.0  # from start to goal, from the start to who is there
LONGEST_S = 120.0
LOOK_S = 0.1
STOOD_S, AHEAD_S = 2.0, 8.0


def tracks_in(folder: Path) -> dict[int, np.ndarray]:
    """Rows t [s], x, y [m] of everybody who was seen more than once."""
    rows = np.loadtxt(folder / "obsmat.txt")
    times, people = rows[:, 0] / FRAMES_PER_S, rows[:, 1].astype(int)
    found = {}
    for person in np.unique(people).tolist():
        own = np.column_stack((times, rows[:, 2], rows[:, 4]))[people == person]
        if len(own) > 1:
            found[person] = own[np.argsort(own[:, 0])]
    return found


def crossing(
    tracks: dict[int, np.ndarray], random: np.random.Generator, safety: str
) -> vs.Mission | None:
    """A mission from one place to another; None where they or somebody at the start are near."""
    everywhere = np.concatenate(list(tracks.values()))
    low, high = everywhere[:, 1:].min(axis=0), everywhere[:, 1:].max(axis=0)
    depart = float(random.uniform(0.0, everywhere[:, 0].max() - LONGEST_S))
    start, goal = random.uniform(low, high, (2, 2))
    unseen = []
    for person, rows in tracks.items():
        moved = rows - (depart, 0.0, 0.0)
        if moved[-1, 0] < 0.0 or moved[0, 0] > LONGEST_S:
            continue
        shape = {"center": [0, 0], "radius": PERSON_M}
        motion = {"keyframes": moved.round(4).tolist(), "after": "vanish", "before": "absent"}
        unseen.append({"name": f"person {person}", "circle": shape, "motion": motion})
        at_start = [np.interp(0.0, moved[:, 0], moved[:, k]) for k in (1, 2)]
        if moved[0, 0] <= 0.0 and np.hypot(*(np.array(at_start) - start)) < APART_M:
            return None
    if np.hypot(*(goal - start)) < LEAST_M:
        return None
    return vs.Mission.model_validate(
        {
            "world": {"unseen": unseen},
            "robot": {
                "radius_m": RADIUS_M,
                "clearance_m": 0.0,
                "max_speed_mps": SPEED_MPS,
                "max_accel_mps2": ACCEL_MPS2,
                "sensor": {"range_m": REACH_M},
                "moving": {"max_speed_mps": FASTEST_MPS, "safety": safety},
            },
            "route": {"start": start.round(3).tolist(), "goal": goal.round(3).tolist()},
        }
    )


def is_frozen(run: vs.Run) -> bool:
    """Whether it stood though it could have driven off along its way and touched nobody."""
    goes = run.speeds > 1e-3
    ends = np.flatnonzero(np.diff(np.concatenate(([True], goes, [True])).astype(int)))
    for first, last in ends.reshape(-1, 2).tolist():
        begin, end = run.times[first], run.times[last - 1]
        if end - begin < STOOD_S or last >= len(run.times):
            continue
        late = np.linspace(0.0, AHEAD_S, 161)
        rise = np.minimum(late, SPEED_MPS / ACCEL_MPS2)
        gone = 0.5 * ACCEL_MPS2 * rise**2 + SPEED_MPS * (late - rise)
        place = run.path.project(run.positions[first])
        at = float(run.path.distance(place.u)) + gone
        places = run.path.at_distance(np.minimum(at, run.path.length))
        gaps = run.moving.distance(places, 0.5 * (begin + end) + late)
        if gaps.min() > RADIUS_M:
            return True
    return False


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--crossings", type=int, default=60)
    parser.add_argument("--safety", choices=("passive", "none"), default="passive")
    asked = parser.parse_args()
    tracks, random = tracks_in(asked.folder), np.random.default_rng(0)
    clean, moving, late, standing, frozen, arrived, spent = 0, 0, 0, 0, 0, 0, []
    while len(spent) < asked.crossings:
        mission = crossing(tracks, random, asked.safety)
        if mission is None:
            continue
        began = clock.process_time()
        run = vs.simulate(mission, step=LOOK_S)
        spent.append(clock.process_time() - began)
        assert run.encounters is not None
        touched = run.encounters.contacts
        under_way = [one for one in touched if one.robot_speed > 0.0]
        clean += run.reached and not touched
        arrived += run.reached
        late += sum(one.appeared_within_braking_time for one in under_way)
        moving += sum(not one.appeared_within_braking_time for one in under_way)
        standing += bool(touched) and not under_way
        frozen += is_frozen(run)
    print(f"{clean} of {len(spent)} clean, {arrived} arrive, {frozen} frozen")
    print(
        f"contacts under way {moving}, with who appeared within braking time {late}; "
        f"only run into while standing {standing}"
    )
    print(f"a drive takes {np.median(spent):.2f} s of work")


if __name__ == "__main__":
    main()
