"""Random fleets told in another way: turned, moved far off, mirrored, renamed, shuffled, scaled.

    python benchmarks/transformed_fleets.py [FLEETS] [--seed 1] [--first 0] [--only RELATION ...]

What is asked is the same each time, so as many robots have to be served, in as much time, to a
hundredth; patrols, which never end, are planned for as many laps as others need. Fleets are those
of ``odd_fleets.py``, some with swapped ends, in rings and in crowds, and no two robots have the
same priority. Every plan is held to the oracle of samples of ``odd_fleets.py`` as well.
"""

from __future__ import annotations

import argparse
import math
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from odd_fleets import KINDS, faults_of_plan, random_fleet

import viaspline as vs
from viaspline.errors import PlanningError, ViasplineError
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.mission.robot_parts import RobotSpec

Fleet = dict[str, Any]
LATER = 0.01
"""By so much of their times all robots together may be later or sooner."""
LENGTHS = (
    "radius_m", "clearance_m", "max_speed_mps", "max_accel_mps2", "max_brake_mps2",
    "max_lateral_accel_mps2", "max_jerk_mps3", "min_turn_radius_m",
)  # fmt: skip


def drawn(random: np.random.Generator) -> Fleet:
    """A fleet: mostly one of ``odd_fleets.py``."""
    what = random.random()
    if what < 0.55:
        return random_fleet(random)
    names = [str(name) for name in random.choice(list(KINDS), 2)]
    count = int(random.integers(3, 9)) if what < 0.85 else int(random.integers(10, 24))
    starts = _apart(random, count)
    if what < 0.7:
        goals = np.roll(starts, 1, axis=0)
    elif what < 0.85:
        turn = np.linspace(0.0, math.tau, count, endpoint=False) + random.uniform(0.0, 1.0)
        ring = max(3.2 * count / math.tau, 4.0) * np.column_stack([np.cos(turn), np.sin(turn)])
        starts = np.round(ring + 12.0, 2)
        goals = np.roll(starts, -int(random.integers(1, count)), axis=0)
    else:
        goals = _apart(random, count)
    fleet = [
        {
            "name": f"r{k}",
            "robot": str(random.choice(names)),
            "route": {"start": starts[k].tolist(), "goal": goals[k].tolist()},
            "priority": float(random.integers(0, 3)),
            "depart_s": float(random.choice([0.0, 0.0, 4.0])),
            "rest": "leave" if random.random() < 0.2 else "stay",
        }
        for k in range(count)
    ]
    robots = {name: KINDS[name] for name in names}
    return {"separation_m": 0.3, "world": {"known": []}, "robots": robots, "fleet": fleet}


def _apart(random: np.random.Generator, count: int) -> np.ndarray:
    """Places that are 2.6 m apart at least, (count, 2)."""
    found: list[np.ndarray] = []
    side = max(16.0, 4.5 * math.sqrt(count))
    while len(found) < count:
        place = random.uniform(0.0, side, 2).round(2)
        if not found or np.hypot(*(np.array(found) - place).T).min() > 2.6:
            found.append(place)
    return np.array(found)


@dataclass(frozen=True)
class Similarity:
    """A way to lay the plane onto itself.

    Attributes:
        turn: By how much it is turned [rad].
        off: By how much it is moved then [m].
        is_mirrored: Whether left and right change places, before that.
        scale: By how much all lengths are longer.
    """

    turn: float = 0.0
    off: tuple[float, float] = (0.0, 0.0)
    is_mirrored: bool = False
    scale: float = 1.0

    def at(self, place: Any) -> list[float]:
        """Where a place comes to [m]."""
        x, y = place
        y = -y if self.is_mirrored else y
        c, s = math.cos(self.turn), math.sin(self.turn)
        if math.isclose(self.turn % (0.5 * math.pi), 0.0):
            c, s = round(c), round(s)  # bounds stay bounds
        return [
            self.scale * (c * x - s * y) + self.off[0],
            self.scale * (s * x + c * y) + self.off[1],
        ]

    def of(self, fleet: Fleet) -> Fleet:
        """A fleet in the world as it is laid then."""
        world = dict(fleet["world"])
        world["known"] = [self._shape(one) for one in world["known"]]
        if "bounds" in world:
            x0, y0, x1, y1 = world["bounds"]
            corners = np.array([self.at((x0, y0)), self.at((x1, y1))])
            world["bounds"] = [*corners.min(axis=0).tolist(), *corners.max(axis=0).tolist()]
        return {
            **fleet,
            "separation_m": self.scale * fleet["separation_m"],
            "world": world,
            "robots": {name: self._kind(one) for name, one in fleet["robots"].items()},
            "fleet": [{**one, "route": self._route(one["route"])} for one in fleet["fleet"]],
        }

    def _shape(self, shape: dict[str, Any]) -> dict[str, Any]:
        circle = shape["circle"]
        center, radius = self.at(circle["center"]), self.scale * circle["radius"]
        return {**shape, "circle": {"center": center, "radius": radius}}

    def _kind(self, kind: dict[str, Any]) -> dict[str, Any]:
        if self.scale == 1.0:
            return kind
        found = dict(kind)
        for key in LENGTHS:
            if key in found:
                found[key] = self.scale * found[key]
        if "footprint" in found:
            found["footprint"] = (self.scale * np.array(found["footprint"])).tolist()
        if "drive" in found:
            wheels = found["drive"]["ackermann"]
            longer = {**wheels, "wheelbase_m": self.scale * wheels["wheelbase_m"]}
            found["drive"] = {"ackermann": longer}
        return found

    def _route(self, route: dict[str, Any]) -> dict[str, Any]:
        found = dict(route)
        for key in ("start", "goal"):
            if key in found:
                found[key] = self._point(found[key])
        if "via" in found:
            found["via"] = [self._point(one) for one in found["via"]]
        return found

    def _point(self, point: Any) -> Any:
        if isinstance(point, dict):
            return {**point, "at": self.at(point["at"])}
        return self.at(point)


def limits_told(fleet: Fleet) -> Fleet:
    """A fleet in which each kind says its limits, so that they can be scaled."""
    robots = {}
    for name, kind in fleet["robots"].items():
        robot = RobotSpec.model_validate(kind)
        told = {key: getattr(robot, key, None) for key in LENGTHS}
        robots[name] = {**{k: v for k, v in told.items() if v is not None}, **kind}
        if "footprint" in kind:
            robots[name].pop("radius_m", None)
    return {**fleet, "robots": robots}


def told_apart(fleet: Fleet) -> Fleet:
    """A fleet no two robots of which have the same priority."""
    members = fleet["fleet"]
    order = np.argsort([-one["priority"] for one in members], kind="stable")
    rank = {int(k): float(len(members) - i) for i, k in enumerate(order)}
    return {**fleet, "fleet": [{**one, "priority": rank[k]} for k, one in enumerate(members)]}


def shuffled(fleet: Fleet, random: np.random.Generator) -> Fleet:
    members = [fleet["fleet"][k] for k in random.permutation(len(fleet["fleet"]))]
    return {**fleet, "fleet": members}


def renamed(fleet: Fleet, random: np.random.Generator) -> Fleet:
    names = [f"{chr(97 + k % 26)}{k}" for k in random.permutation(len(fleet["fleet"]))]
    members = [
        {**one, "name": name} for one, name in zip(fleet["fleet"], names, strict=True)
    ]  # fmt: skip
    return {**fleet, "fleet": members}


def departing_later(fleet: Fleet, later: float) -> Fleet:
    members = [{**one, "depart_s": one["depart_s"] + later} for one in fleet["fleet"]]
    return {**fleet, "fleet": members}


def with_one_far_off(fleet: Fleet) -> Fleet:
    far = {
        "name": "far", "robot": fleet["fleet"][0]["robot"], "depart_s": 0.0, "priority": -5.0,
        "rest": "stay", "route": {"start": [900.0, 900.0], "goal": [920.0, 905.0]},
    }  # fmt: skip
    return {**fleet, "fleet": [*fleet["fleet"], far]}


Told = Callable[[Fleet, np.random.Generator], Fleet]
"""A fleet told in another way, which may be drawn by chance."""
RELATIONS: dict[str, Told] = {
    "shuffled": shuffled,
    "renamed": renamed,
    "turned": lambda f, r: Similarity(turn=_turn(f, r)).of(f),
    "far off": lambda f, r: Similarity(off=tuple(r.uniform(1e5, 1e6, 2).round(3))).of(f),
    "mirrored": lambda f, r: Similarity(is_mirrored=True).of(f),
    "scaled": lambda f, r: Similarity(scale=float(r.choice([0.5, 2.0, 4.0]))).of(f),
    "later": lambda f, r: departing_later(f, float(r.choice([17.0, 1000.25]))),
    "one far off": lambda f, r: f if "bounds" in f["world"] else with_one_far_off(f),
}


def _turn(fleet: Fleet, random: np.random.Generator) -> float:
    """By how much a fleet is turned: squarely, where there are bounds [rad]."""
    if "bounds" in fleet["world"]:
        return 0.5 * math.pi * int(random.integers(1, 4))
    return float(random.uniform(0.0, math.tau))


@dataclass(frozen=True)
class Outcome:
    """What comes of planning a fleet.

    Attributes:
        plan: None where it is refused as a whole.
        words: Why, then; else of each robot that isn't served whether that is proven.
        served: How many robots are.
        drives: How long they are under way, all together, and how long alone [s].
        took: [s].
    """

    plan: FleetPlan | None
    words: str
    served: int
    drives: tuple[float, float]
    took: float


def outcome_of(data: Fleet) -> Outcome:
    before = time.process_time()
    try:
        plan = vs.plan_fleet(vs.Fleet.model_validate(data))
    except PlanningError as error:
        return Outcome(None, f"{type(error).__name__}: {error}", 0, (0, 0), _since(before))
    except (ViasplineError, ValueError) as error:
        words = f"{type(error).__name__}: {str(error)[:200]}"
        return Outcome(None, words, 0, (0, 0), _since(before))
    served = [one for one in plan.plans if one != "far"]
    members = {one.name: one.mission.route.depart_s for one in plan.fleet.members}
    drives = sum(plan.plans[n].trajectory.end_time - members[n] for n in served)
    alone = sum(plan.alone[n] for n in served)
    words = ", ".join(f"{one.name} {one.outcome}" for one in plan.not_served)
    return Outcome(plan, words, len(served), (float(drives), float(alone)), _since(before))


def _since(before: float) -> float:
    return time.process_time() - before


def differences(one: Outcome, other: Outcome) -> Iterator[str]:
    """What of the second isn't as in the first."""
    if (one.plan is None) != (other.plan is None):
        yield f"REFUSED: {one.words!r} and {other.words!r}"
        return
    if one.plan is None or other.plan is None:
        if one.words.split(":")[0] != other.words.split(":")[0]:
            yield f"other error: {one.words!r} and {other.words!r}"
        return
    if one.served != other.served:
        yield f"SERVED: {one.served} and {other.served} of {len(one.plan.fleet.members)}"
        yield f"   {one.words} | {other.words}"
    kinds = [sorted(it.outcome for it in plan.not_served) for plan in (one.plan, other.plan)]
    if one.served == other.served and kinds[0] != kinds[1]:
        yield f"OUTCOME: {kinds[0]} and {kinds[1]}"
    for what, k in (("drives", 0), ("alone", 1)):
        a, b = one.drives[k], other.drives[k]
        lasts = one.plan.patrols is None and one.served == other.served
        if lasts and abs(a - b) > LATER * max(a, b):
            yield f"{what}: {a:.2f} s and {b:.2f} s"
    for which, found in (("first", one), ("second", other)):
        proof = found.plan.certificate if found.plan is not None else None
        if proof is not None and not proof.holds:
            yield f"PROOF of the {which}: {proof.separation}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fleets", nargs="?", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--longest", type=float, default=5.0, help="to plan one [s]")
    parser.add_argument("--only", nargs="*", default=list(RELATIONS))
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    fleets = pairs = told = 0
    for k in range(asked.first, asked.first + asked.fleets):
        data = told_apart(limits_told(drawn(np.random.default_rng([asked.seed, k]))))
        first = outcome_of(data)
        if first.plan is None or first.took > asked.longest:
            continue
        fleets += 1
        for name in asked.only:
            random = np.random.default_rng([asked.seed, k, list(RELATIONS).index(name)])
            second = outcome_of(RELATIONS[name](data, random))
            pairs += 1
            found = list(differences(first, second))
            if second.plan is not None and name != "far off":  # there samples are as coarse
                found += [f"SAMPLED {it}" for it in faults_of_plan(second.plan)]
            if second.took > 5.0 * first.took + 5.0:
                found.append(f"took {first.took:.1f} and {second.took:.1f} s")
            for words in found:
                told += 1
                print(f"{asked.seed} {k} {name}: {words}", flush=True)
        if (k + 1) % 10 == 0:
            print(f"… {k + 1}: {fleets} fleets, {pairs} pairs, {told} differences", flush=True)
    print(f"{fleets} fleets, {pairs} pairs, {told} differences")


if __name__ == "__main__":
    main()
