"""DynaBARN: worlds of moving discs, their motion known, planned in space and time.

    python benchmarks/dynabarn.py FOLDER [--traffic | --unseen [--lidar] [--passive]]

FOLDER has DynaBARN's worlds as JSON: start, goal, obstacles with a radius, a period and keyframes
t, x, y, which begin again at their end. A robot of radius 0.25 m, 2 m/s and 1 m/s² goes from the
start to the goal. With ``--traffic`` it sets out in the middle of the traffic: from five places
and times in every world. Every plan is sampled every half millisecond by numpy alone. With
``--unseen`` nothing is known: a range sensor of 10 m shows places and velocities, at three phases
of every world's motion; a drive is clean if it arrives and touches nothing. With ``--lidar`` it is
one of 270°, 10 m and 720 beams; with ``--passive`` the robot is held to passive safety among what
is no faster than 2 m/s.
"""

from __future__ import annotations

import argparse
import json
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

import viaspline as vs

RADIUS_M, SPEED_MPS, ACCEL_MPS2 = 0.25, 2.0, 1.0
SAMPLE_S = 5e-4
PLACES = 5  # in the traffic of every world


def mission_of(world: dict[str, Any], start: Any, depart: float) -> vs.Mission:
    """A world as a mission."""
    known = [
        {
            "name": one["name"],
            "circle": {"center": [0, 0], "radius": one["radius_m"]},
            "motion": {"keyframes": one["keyframes_t_x_y"], "after": "loop"},
        }
        for one in world["obstacles"]
    ]
    return vs.Mission.model_validate(
        {
            "world": {"known": known},
            "robot": {
                "radius_m": RADIUS_M,
                "clearance_m": 0.0,
                "max_speed_mps": SPEED_MPS,
                "max_accel_mps2": ACCEL_MPS2,
            },
            "route": {"start": start, "goal": world["goal"], "depart_s": depart},
        }
    )


def places_at(world: dict[str, Any], times: np.ndarray) -> np.ndarray:
    """Where the discs are, (times, discs, 2): linear between keyframes, again and again."""
    found = []
    for one in world["obstacles"]:
        frames = np.array(one["keyframes_t_x_y"])
        begin, period = frames[0, 0], frames[-1, 0] - frames[0, 0]
        local = begin + np.mod(times - begin, period)
        found.append(
            np.column_stack([np.interp(local, frames[:, 0], frames[:, k]) for k in (1, 2)])
        )
    return np.stack(found, axis=1)


def least_gap(world: dict[str, Any], plan: vs.Plan) -> float:
    """The least distance between the robot and a disc, by samples [m]."""
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, SAMPLE_S)
    along = np.minimum(law.distance_at(times), plan.path.length)
    robot = np.asarray(plan.path.at_distance(along))
    radii = np.array([one["radius_m"] for one in world["obstacles"]])
    apart = np.hypot(*np.moveaxis(places_at(world, times) - robot[:, None], -1, 0))
    return float((apart - radii).min()) - RADIUS_M


def cases(world: dict[str, Any], number: int, traffic: bool) -> Iterator[tuple[Any, float]]:
    """Where and when the robot sets out."""
    if not traffic:
        yield world["start"], 0.0
        return
    random = np.random.default_rng(number)
    count = 0
    while count < PLACES:
        start = random.uniform(-7.0, 7.0, 2)
        depart = round(float(random.uniform(0.0, 60.0)), 2)
        radii = np.array([one["radius_m"] for one in world["obstacles"]])
        apart = np.hypot(*(places_at(world, np.array([depart]))[0] - start).T) - radii
        if apart.min() > RADIUS_M + 0.05:
            count += 1
            yield start.round(3).tolist(), depart


PHASES_S = (0.0, 7.0, 19.0)
LOOK_S = 0.1


RANGE = {"sensor": {"range_m": 10}}
LIDAR = {"sensor": {"lidar": {"range_m": 10, "fov_deg": 270, "beams": 720}}}
FASTEST_MPS = 2.0


def unseen(world: dict[str, Any], phase: float, robot: dict[str, Any]) -> vs.Mission:
    """A world that a sensor has to find, its motion that much farther on [s]."""
    data = mission_of(world, world["start"], 0.0).model_dump(by_alias=True, exclude_defaults=True)
    for item in data["world"]["known"]:
        item["motion"]["keyframes"] = [(t - phase, x, y) for t, x, y in item["motion"]["keyframes"]]
    data["world"] = {"unseen": data["world"]["known"]}
    data["robot"].update(robot)
    return vs.Mission.model_validate(data)


@contextmanager
def timed_steps() -> Iterator[list[float]]:
    """The time of the processor that each step of a navigator takes [s], as they come."""
    step, taken = vs.Navigator.step, []

    def timed(*args: Any, **keys: Any) -> Any:
        began = clock.thread_time()
        given = step(*args, **keys)
        taken.append(clock.thread_time() - began)
        return given

    vs.Navigator.step = timed  # type: ignore[method-assign]
    try:
        yield taken
    finally:
        vs.Navigator.step = step  # type: ignore[method-assign]


def drive_unseen(folder: Path, robot: dict[str, Any]) -> None:
    """Drive all worlds at all phases and say how that went."""
    first = sorted(folder.glob("*.json"))[0]
    vs.Navigator(unseen(json.loads(first.read_text()), 0.0, robot))  # which loads all kernels
    with timed_steps() as steps:
        _drive_all(folder, robot)
    median, few, most = 1e3 * np.percentile(steps, (50, 99, 100))
    print(f"a step takes {median:.2f} ms in the median, {few:.1f} at 99 %, {most:.0f} at most")


def _drive_all(folder: Path, robot: dict[str, Any]) -> None:
    clean, moving, late, standing, lost, spent = 0, 0, 0, 0, 0, []
    for file in sorted(folder.glob("*.json")):
        for phase in PHASES_S:
            mission = unseen(json.loads(file.read_text()), phase, robot)
            began = clock.process_time()
            run = vs.simulate(mission, step=LOOK_S)
            spent.append(clock.process_time() - began)
            assert run.encounters is not None
            contacts = run.encounters.contacts
            under_way = [contact for contact in contacts if contact.robot_speed > 0.0]
            in_time = [one for one in under_way if not one.appeared_within_braking_time]
            clean += run.reached and not contacts
            moving += bool(in_time)
            late += bool(under_way) and not in_time
            standing += bool(contacts) and not under_way
            lost += not run.reached and not contacts
    print(f"{clean} of {len(spent)} clean; touched under way {moving}, only what appeared within")
    print(
        f"braking time {late}; only while standing {standing}; not arrived, nothing touched {lost}"
    )
    print(f"a drive takes {np.median(spent):.2f} s of work")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--traffic", action="store_true")
    parser.add_argument("--unseen", action="store_true")
    parser.add_argument("--lidar", action="store_true")
    parser.add_argument("--passive", action="store_true")
    asked = parser.parse_args()
    if asked.unseen:
        robot: dict[str, Any] = dict(LIDAR if asked.lidar else RANGE)
        if asked.passive:
            robot["moving"] = {"max_speed_mps": FASTEST_MPS, "safety": "passive"}
        drive_unseen(asked.folder, robot)
        return
    taken, planned, gaps, refused = [], [], [], []
    for number, file in enumerate(sorted(asked.folder.glob("*.json"))):
        world = json.loads(file.read_text())
        for start, depart in cases(world, number, asked.traffic):
            mission = mission_of(world, start, depart)
            began = clock.perf_counter()
            try:
                plan = vs.plan(mission)
            except vs.PlanningError as error:
                refused.append(f"{file.stem} from {start} at {depart}: {error}")
                continue
            planned.append(clock.perf_counter() - began)
            taken.append(plan.trajectory.duration)
            gaps.append(least_gap(world, plan))
            assert plan.moving_certificate is not None
            assert gaps[-1] >= plan.moving_certificate.clearance - 1e-9, file
    print(f"planned {len(taken)}, not planned {len(refused)}")
    print(f"duration {np.mean(taken):.2f} s mean, {np.max(taken):.2f} s worst")
    print(
        f"least gap {min(gaps):.4f} m; plan {np.median(planned):.3f} s, {max(planned):.3f} s worst"
    )
    print(*refused, sep="\n")


if __name__ == "__main__":
    main()
