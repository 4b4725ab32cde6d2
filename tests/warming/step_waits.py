"""What a step of the navigator waits for, in worlds that no warming has driven through.

``python tests/warming/step_waits.py lidar+footprint``: one kind of mission, in a process that is
new; says as JSON what was compiled, loaded and imported inside of steps, and how long the first
step with a scan and the longest took. ``--timed lidar+footprint`` says what steps cost as well, in
the thread's own time: of one that took long it is the least of three times that it is done, for on
a busy machine that time grows as well. ``--every``: so for each sensor with each drive and body.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from contextlib import suppress
from itertools import product
from typing import Any

import numpy as np

import viaspline as vs
from viaspline.kernels.compile_events import compile_progress
from viaspline.kernels.kernel_cache import KernelCache
from viaspline.robot.navigator import Navigator
from viaspline.robot.simulator import STEP_S
from viaspline.warming.mission_kind import MissionKind, kind_named, kind_of
from viaspline.warming.small_missions import robot_of

SENSORS = ("untold", "plain", "lidar")
MOVERS = ("", "differential", "ackermann+turning", "skid_steer", "omnidirectional", "localization")
BODIES = ("", "footprint", "turning")
SAFE = ("passive", "lidar+passive", "lidar+differential+passive", "lidar+footprint+passive")
LONG_S, REPEATED = 0.04, 2
"""A step that took longer is done so often again [s]."""
COARSE_S = 0.15
"""From step to step where only what is compiled, loaded and imported counts [s]."""
PACKAGES = ("viaspline", "numba", "numpy", "scipy", "shapely", "matplotlib")


class Waits:
    """Counts what is compiled, loaded and imported inside of steps."""

    def __init__(self, repeated: int) -> None:
        self.repeated = repeated
        self.inside, self.longest, self.first_scan = False, 0.0, 0.0
        self.cpu: dict[str, list[float]] = {"under_way": [0.0], "standing": [0.0]}
        self.compiled: list[str] = []
        self.loaded: list[str] = []
        self.imported: list[str] = []

    def watch(self) -> None:
        load, step = KernelCache.load_overload, Navigator.step

        def told(cache: Any, sig: Any, context: Any) -> Any:
            found = load(cache, sig, context)
            if self.inside and found is not None:
                self.loaded.append(cache._py_func.__name__)
            return found

        def stepped(nav: Any, state: Any, sensed: Any, now: float) -> Any:
            before, began = set(sys.modules), time.perf_counter()
            sensed = sensed if isinstance(sensed, vs.Scan) else list(sensed)
            self.inside, start = True, time.thread_time()
            try:
                return step(nav, state, sensed, now)
            finally:
                spent = [time.thread_time() - start]
                self.inside = False
                took = time.perf_counter() - began
                while spent[0] > LONG_S and len(spent) <= self.repeated:
                    start = time.thread_time()
                    step(nav, state, sensed, now)
                    spent.append(time.thread_time() - start)
                self.cpu["under_way" if abs(state.speed) > 1e-3 else "standing"].append(min(spent))
                new = (name for name in sys.modules if name not in before)
                self.imported += [name for name in new if name.partition(".")[0] in PACKAGES]
                self.longest = max(self.longest, took)
                if isinstance(sensed, vs.Scan) and not self.first_scan:
                    self.first_scan = took

        KernelCache.load_overload = told  # type: ignore[method-assign]
        Navigator.step = stepped  # type: ignore[method-assign]

    def heard(self, kernel: str) -> None:
        if self.inside:
            self.compiled.append(kernel)


def missions(kind: MissionKind) -> list[vs.Mission]:
    """A yard with all kinds of shapes and things that move, a comb of pockets, a wood."""
    robot = robot_of(kind)
    if "lidar" in kind.parts:
        robot["sensor"] = {"lidar": {"range_m": 6, "fov_deg": 360, "beams": 240}}
    cart = {"circle": {"center": [0, 0], "radius": 0.4},
            "motion": {"keyframes": [[0, 9, 6], [9, 9, -6]], "after": "loop"}}  # fmt: skip
    truck = {"polygon": [[-1, -0.4], [1, -0.4], [1, 0.4], [-1, 0.4]],
             "motion": {"from": [34, 0.3], "velocity_mps": [-0.4, 0]}}  # fmt: skip
    yard = {
        "bounds": [-3, -9, 38, 9],
        "known": [
            {"polygon": [[4, -1], [6, -1], [6, 1], [4, 1]]},
            {"polygon": [[20, -9], [21, -9], [21, -1.5], [20, -1.5]]},
            {"polygon": [[20, 1.6], [21, 1.6], [21, 9], [20, 9]]},
        ],
        "unseen": [
            {"circle": {"center": [11.5, 0.4], "radius": 0.9}},
            {"capsule": {"from": [15, -2], "to": [15, 1], "radius": 0.15}},
            {"polygon": [[25, -0.7], [27, -0.7], [26, 1.4]]},
            cart, truck,
        ],
    }  # fmt: skip
    comb = [[[6, -4], [6, 4]], *([[3.5, y], [6, y]] for y in (-4, -1.5, 1.5, 4))]
    walls = [{"capsule": {"from": a, "to": b, "radius": 0.1}} for a, b in comb]
    trees = [{"circle": {"center": [3 + 1.9 * (k % 6) + 0.4 * (k // 6 % 2), 1.7 * (k // 6) - 5],
                         "radius": 0.2}} for k in range(42)]  # fmt: skip
    routes = (
        {"start": [0, 0], "via": [{"at": [17, -1], "dwell_s": 1}, [30, 2]], "goal": [35, -3]},
        {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [9, 0]},
        {"start": [0, -1], "goal": [15, 2]},
    )
    worlds = (yard, {"bounds": [-6, -7, 12, 7], "unseen": walls}, {"unseen": trees})
    return [
        vs.Mission.model_validate({"world": world, "robot": robot, "route": route})
        for world, route in zip(worlds, routes, strict=True)
    ]


def told_by_hand(mission: vs.Mission) -> None:
    """A robot without a sensor, which is told of what stands and moves all the same."""
    robot = mission.robot.model_copy(update={"sensor": None})
    nav = Navigator(mission.model_copy(update={"robot": robot}), warm=False)
    rock = vs.Obstacle(circle={"center": (11, 0.2), "radius": 0.8}, name="rock")
    person = vs.Obstacle(circle={"center": (0, 0), "radius": 0.3})
    state = nav.reference(0.0)
    for tick in range(400):
        now = 0.05 * tick
        walker = vs.MovingSighting(0, person, (14.0, 6.0 - 0.6 * now, 0.0), (0.0, -0.6))
        _, nav = nav.step(state, [rock, walker] if now > 2.0 else [], now)
        state = nav.reference(now + 0.05)


def waits(name: str, repeated: int = 0, step: float = STEP_S) -> dict[str, Any]:
    """Drive a kind of mission after it was warmed, and say what steps waited for."""
    kind, watched = kind_named(name), Waits(repeated)
    began = time.perf_counter()
    given = missions(kind)
    navigator = Navigator(given[0])
    warmed = time.perf_counter() - began
    assert kind_of(navigator.mission) == kind, (kind_of(navigator.mission), kind)
    watched.watch()
    outcomes = []
    with compile_progress(watched.heard):
        for mission in given:
            with suppress(vs.PlanningError):
                run = vs.simulate(mission, step=step)
                outcomes.append([run.reached, len(run.replans)])
        if "untold" in name:
            told_by_hand(given[0])
    return {
        "kind": name, "compiled": watched.compiled, "loaded": watched.loaded,
        "imported": watched.imported, "steps": sum(map(len, watched.cpu.values())),
        "outcomes": outcomes,
        "warmed_s": round(warmed, 2), "first_scan_ms": round(1e3 * watched.first_scan, 1),
        "longest_ms": round(1e3 * watched.longest, 1),
        "cpu_ms": {
            how: (1e3 * np.quantile(spent, (0.5, 0.99, 1.0))).round(1).tolist()
            for how, spent in watched.cpu.items()
        },
    }  # fmt: skip


def every() -> list[str]:
    """Each sensor with each drive and each body, and robots that are to be at rest in time."""
    words = product(SENSORS, MOVERS, BODIES)
    named = ["+".join(filter(None, dict.fromkeys("+".join(filter(None, w)).split("+"))))
             for w in words]  # fmt: skip
    return list(dict.fromkeys((*named, *SAFE)))


if __name__ == "__main__":
    if sys.argv[1:] == ["--every"]:
        for one in every():
            subprocess.run([sys.executable, __file__, "--timed", one], check=False)
    elif sys.argv[1] == "--timed":
        print(json.dumps(waits(sys.argv[2], REPEATED)), flush=True)
    else:
        print(json.dumps(waits(sys.argv[1], step=COARSE_S)), flush=True)
