"""The path that a good driver would take: how far the planner's is from it, a table a question.

    python benchmarks/driven_well.py TABLE [--seed 0] [--worlds N] [--maps FOLDER] [--detours HOW]

    turns            how often the path turns the other way, in the examples, and its taut route
    best-vector      time, length and bending over those of the best curve of the same kind, in
                     vector worlds; 40 of them
    best-maps        the same on 10 crops of the maps in FOLDER, and on as many maps of rooms
    best-examples    the same in the examples, but for those with a body that is no disc
    street           what the street example loses to its corners
    straight         vector worlds at 5 m/s, 1 m/s²: time over that of the straight line; 40
    sharp            random missions of four via points: how many are sharp, or turn back; 1,000
    fatter           the same missions for robots that keep more: how many of their paths would be
                     sooner for the robot itself, which they are clear for as well; 100
    rounds           rounds of five places, some of them stations, on the maps of a warehouse and
                     a depot: how many are sharper than the body, or have a corner where they
                     don't stop, and the time of all; 50 on each
    stations         missions with stations, in the open, among discs, as rounds, on maps: the time
                     over that in one curve (turn_on_spot: never), dwells counted, how many have
                     corners, and what planning takes over that of the curve; 60 each
    signs            random missions, vector worlds, crops, rooms: how many turn the other way more
                     than twice as often as the taut route and twice for each via point; 20 each
    lanes            share of lanes over a lake that the path stays within 1 m of, and of how many
                     it is less than 1 - 4 x (islands' width / lane), of them of how many that are
                     more than ten times as long, which are kept unless it is said; 20
    times            of a plan: vector worlds, crops of the maps in FOLDER; 20

With --detours local or short, lakes and vector worlds say how, else it is chosen: the best curve of
a world in which the lane is kept is one that doesn't keep it.

Times are the least under the mission's limits of speed and acceleration (across the path as along
it, where it has none), dwells left out. All figures come from samples of the exact curve and from
shapely, none from the plan's own report. Put another checkout's ``src`` in ``PYTHONPATH`` to
measure that.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import shapely
from best_curve import UnsolvedError, fastest, gentlest
from driven_missions import (
    crop,
    four_vias,
    indoor_round,
    lake,
    rooms,
    vector_world,
    with_stations,
)
from driven_plan import DrivenPlan
from driving_time import DrivingLimits, straight_time
from path_shape import turning_sides
from timing import clock, in_turn
from worlds import length

import viaspline as vs

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
NEAR_LANE_M, LANE_STEP_M = 1.0, 0.25
SHARP_M = 0.1  # radius
PLAN_ROUNDS = 5
FATTER = (1.3, 1.7, 2.2, 3.0)  # times as much room as is required

Named = tuple[str, vs.Mission]


def turns(asked: argparse.Namespace) -> None:
    print(f"{'example':18s}  turns  taut  detours  length m  / taut")
    for name, mission in examples():
        driven = DrivenPlan.of(mission)
        taut = driven.taut
        print(
            f"{name:18s} {driven.shape.sign_changes():6d} {turning_sides(taut):5d} "
            f"{driven.detours:8d} {driven.shape.length:9.1f} "
            f"{driven.shape.length / length(taut):7.4f}",
            flush=True,
        )


def best_vector(asked: argparse.Namespace) -> None:
    worlds = ((f"vector {k}", vector_world(k)) for k in seeds(asked, 40))
    beside_the_best((name, with_detours(mission, asked)) for name, mission in worlds)


def best_maps(asked: argparse.Namespace) -> None:
    picked = list(seeds(asked, 10))
    beside_the_best((f"crop {k}", crop(k, asked.maps)) for k in picked)
    beside_the_best((f"rooms {k}", rooms(k)) for k in picked)


def best_examples(asked: argparse.Namespace) -> None:
    beside_the_best(
        (name, mission.model_copy(update={"route": mission.route.model_copy(update={"laps": 1})}))
        for name, mission in examples()
        if mission.robot.footprint is None
    )


def beside_the_best(missions: Iterator[Named]) -> None:
    """Of each, what it takes over the best curve of its kind.

    Time and length are over those of the fastest curve; peak curvature and bending over those of
    the gentlest that takes no more than 0.2 % longer.
    """
    names = ("time", "length", "peak 1/m", "/ best", "bending", "/ best", "turns", "best s")
    print(f"{'':18s} " + " ".join(f"{name:>8s}" for name in names))
    ratios = []
    for name, mission in missions:
        try:
            driven = DrivenPlan.of(mission)
            seconds, fast = clock(lambda driven=driven: fastest(driven.task))
            further, gentle = clock(lambda driven=driven, fast=fast: gentlest(driven.task, fast))
        except (UnsolvedError, vs.PlanningError) as error:
            print(f"{name:18s} {type(error).__name__} {error}", flush=True)
            continue
        shape = driven.shape
        row = (driven.driving_time / fast.time, shape.length / fast.length,
               shape.peak / gentle.peak, shape.bending / gentle.bending)  # fmt: skip
        ratios.append(row)
        print(
            f"{name:18s} {row[0]:8.4f} {row[1]:8.4f} {shape.peak:8.3f} {row[2]:8.2f} "
            f"{shape.bending:8.3f} {row[3]:8.2f} {shape.sign_changes():8d} "
            f"{seconds + further:8.1f}",
            flush=True,
        )
    for name, values in (("median", np.median(ratios, axis=0)), ("worst", np.max(ratios, axis=0))):
        print(
            f"{name:18s} {values[0]:8.4f} {values[1]:8.4f} {'':8s} {values[2]:8.2f} "
            f"{'':8s} {values[3]:8.2f}"
        )


def street(asked: argparse.Namespace) -> None:
    driven = DrivenPlan.of(vs.load(EXAMPLES / "street.yaml"))
    limits = DrivingLimits.of(driven.plan.mission.robot)
    stops = [at for via, at in driven.plan.path.stops if via.dwell > 0.0]
    runs = np.diff([0.0, *stops, driven.shape.length])
    straight = sum(straight_time(float(run), limits) for run in runs)
    time, top = driven.driving_time, driven.shape.length / limits.speed
    print(f"driven {time:.1f} s, dwells left out; {driven.shape.length:.1f} m at speed {top:.1f} s")
    print(f"stops and starts {straight - top:.1f} s, lost to corners {time - straight:.1f} s")


def straight(asked: argparse.Namespace) -> None:
    ratios = []
    for seed in seeds(asked, 40):
        mission = with_detours(vector_world(seed), asked)
        route, limits = mission.route, DrivingLimits.of(mission.robot)
        least = straight_time(float(np.hypot(*np.subtract(route.goal.at, route.start.at))), limits)
        ratios.append(DrivenPlan.of(mission).driving_time / least)
    print(f"time over the straight line's: median {np.median(ratios):.4f}, worst {max(ratios):.4f}")


def sharp(asked: argparse.Namespace) -> None:
    shapes, refused = [], 0
    for seed in seeds(asked, 1000):
        mission = four_vias(seed)
        try:
            shapes.append(DrivenPlan.of(mission).shape)
        except vs.PlanningError:
            refused += 1
    print(f"planned {len(shapes)}, refused {refused}")
    for radius in (SHARP_M, mission.robot.radius_m):
        share = np.mean([shape.is_sharper(radius) for shape in shapes])
        print(f"sharper than {radius} m anywhere: {share:.2%}")
    print(f"with a corner: {np.mean([shape.corners > 0 for shape in shapes]):.2%}")
    turned = np.mean([shape.near_turns() > 0 for shape in shapes])
    print(f"with a span that nearly turns back on itself: {turned:.2%}")


def fatter(asked: argparse.Namespace) -> None:
    sooner = []
    for seed in seeds(asked, 100):
        mission = four_vias(seed)
        robot = mission.robot
        needed = robot.radius_m + robot.clearance_m
        kept = (robot.clearance_m, *(times * needed - robot.radius_m for times in FATTER))
        found = []
        for clearance in kept:
            its = robot.model_copy(update={"clearance_m": clearance})
            try:
                plan = vs.plan(mission.model_copy(update={"robot": its}))
            except vs.PlanningError:
                plan = None
            found.append(np.inf if plan is None else plan.trajectory.duration)
        if np.isfinite(found[0]):
            sooner.append(1.0 - min(found) / found[0])
    late = np.mean(np.array(sooner) > 0.005)
    print(
        f"sooner by more than 0.5 %: {late:.0%} of {len(sooner)}, by {np.mean(sooner):.2%} in the "
        f"mean of all and {max(sooner):.1%} at most"
    )


def rounds(asked: argparse.Namespace) -> None:
    for name in ("warehouse", "depot"):
        shapes, times, refused = [], [], 0
        for seed in seeds(asked, 50):
            mission = indoor_round(seed, EXAMPLES / "maps" / f"{name}.yaml")
            try:
                found = DrivenPlan.of(mission)
            except vs.PlanningError:
                refused += 1
                continue
            shapes.append(found.between_stations)
            times.append(found.plan.trajectory.duration)
        radius = mission.robot.radius_m
        print(f"{name}: planned {len(shapes)}, refused {refused}, driven {sum(times):.1f} s")
        sharp = np.mean([any(part.is_sharper(radius) for part in parts) for parts in shapes])
        print(f"sharper than {radius} m anywhere, or with a corner: {sharp:.2%}")


def stations(asked: argparse.Namespace) -> None:
    kinds: dict[str, Callable[[int], vs.Mission]] = {
        "open": lambda k: with_stations(k, discs=0, closed=False),
        "discs": lambda k: with_stations(k, discs=12, closed=False),
        "rounds": lambda k: with_stations(k, discs=0, closed=True),
        "rounds among discs": lambda k: with_stations(k, discs=12, closed=True),
        "warehouse": lambda k: indoor_round(k, EXAMPLES / "maps" / "warehouse.yaml"),
        "depot": lambda k: indoor_round(k, EXAMPLES / "maps" / "depot.yaml"),
    }
    print(f"{'':18s}  plans  with corners  time mean    least   worst   all s  work")
    for name, make in kinds.items():
        ratios, total, work, turned = [], 0.0, np.zeros(2), 0
        for mission in map(make, seeds(asked, 60)):
            robot = mission.robot.model_copy(update={"turn_on_spot": "never"})
            curve = mission.model_copy(update={"robot": robot})
            plans: dict[str, vs.Plan] = {}
            try:
                spent, plans = in_turn(
                    {"as asked": lambda mission=mission: vs.plan(mission),
                     "curve": lambda curve=curve: vs.plan(curve)}, 2,
                )  # fmt: skip
            except vs.PlanningError:
                continue
            own, other = (plans[each].trajectory.end_time for each in ("as asked", "curve"))
            turned += len(plans["as asked"].drivability.turns_on_spot) > 0
            ratios.append(own / other)
            total += own
            work += (spent["as asked"], spent["curve"])
        print(
            f"{name:18s} {len(ratios):6d} {turned:13d} {np.mean(ratios):10.4f} {min(ratios):8.3f} "
            f"{max(ratios):7.4f} {total:7.0f} {work[0] / work[1]:5.2f}",
            flush=True,
        )


def signs(asked: argparse.Namespace) -> None:
    kinds: dict[str, Callable[[int], vs.Mission]] = {
        "four vias": four_vias, "vector": vector_world, "crops": lambda k: crop(k, asked.maps),
        "rooms": rooms,
    }  # fmt: skip
    for name, make in kinds.items():
        found = []
        for mission in map(make, seeds(asked, 20)):
            try:
                driven = DrivenPlan.of(with_detours(mission, asked))
            except vs.PlanningError:
                continue
            allowed = 2 * turning_sides(driven.taut) + 2 * len(mission.route.via)
            found.append((driven.shape.sign_changes(), allowed))
        changes, allowed = np.array(found).T
        print(
            f"{name:10s} {len(found):4d} planned; changes of sign: median {np.median(changes):.0f},"
            f" most {changes.max()}; more than allowed: {np.sum(changes > allowed)}",
            flush=True,
        )


def lanes(asked: argparse.Namespace) -> None:
    print("lake  lanes  share kept  worst lane  taut routes'  time s")
    kept: list[float] = []
    found: list[tuple[bool, bool]] = []
    times_s = 0.0
    for seed in seeds(asked, 20):
        mission = with_detours(lake(seed), asked)
        driven = DrivenPlan.of(mission)
        shares, weights = zip(*(near_lane(leg) for leg in driven.legs), strict=True)
        taut = [near_lane(leg)[0] for leg in driven.taut_legs]
        kept.append(float(np.average(shares, weights=weights)))
        times_s += driven.driving_time
        for leg, share in zip(driven.legs, shares, strict=True):
            part = width(mission, leg) / length(leg[[0, -1]])
            found.append((share < 1.0 - 4.0 * part, part < 0.1))
        print(
            f"{seed:4d} {len(shares):6d} {kept[-1]:11.3f} {min(shares):11.3f} "
            f"{np.average(taut, weights=weights):13.3f} {driven.driving_time:7.1f}",
            flush=True,
        )
    print(f"median {np.median(kept):.3f}, least {min(kept):.3f}; driven in {times_s:.0f} s")
    less, long = np.array(found).T
    print(f"{less.sum()} of {len(less)} lanes keep less than 1 - 4 x (islands' width / lane),")
    print(
        f"{less[long].sum()} of {long.sum()} that are more than ten times as long as that is wide"
    )


def width(mission: vs.Mission, leg: np.ndarray) -> float:
    """Of the islands that block the line between a leg's ends [m].

    Along the line or across it, whichever is more of each.
    """
    ends = leg[[0, -1]]
    along = (ends[1] - ends[0]) / length(ends)
    across = np.array((-along[1], along[0]))
    required = mission.robot.radius_m + mission.robot.clearance_m
    total = 0.0
    for island in mission.world.known:
        ring = np.array(island.polygon or [island.circle.center])
        radius = island.circle.radius if island.circle is not None else 0.0
        core = shapely.MultiPoint(ring).convex_hull
        if shapely.distance(core, shapely.LineString(ends)) < radius + required:
            total += float(max(np.ptp(ring @ along), np.ptp(ring @ across))) + 2.0 * radius
    return total


def near_lane(leg: np.ndarray) -> tuple[float, float]:
    """Share of the line between a leg's ends that has the leg near it, and its length [m]."""
    lane = shapely.LineString(leg[[0, -1]])
    places = lane.interpolate(np.arange(0.0, lane.length, LANE_STEP_M))
    near = shapely.dwithin(shapely.LineString(leg), places, NEAR_LANE_M)
    return float(np.mean(near)), float(lane.length)


def times(asked: argparse.Namespace) -> None:
    for name, make in (("vector", vector_world), ("crops", lambda k: crop(k, asked.maps)),
                       ("rooms", rooms)):  # fmt: skip
        found = []
        for mission in map(make, seeds(asked, 20)):
            spent, _ = in_turn({"plan": lambda mission=mission: vs.plan(mission)}, PLAN_ROUNDS)
            found.append(1e3 * spent["plan"])
        print(
            f"{name:8s} median {np.median(found):8.2f} ms, worst {max(found):8.2f} ms", flush=True
        )


def with_detours(mission: vs.Mission, asked: argparse.Namespace) -> vs.Mission:
    """With the detours that are asked for, if any are."""
    if asked.detours is None:
        return mission
    route = mission.route.model_copy(update={"detours": asked.detours})
    return mission.model_copy(update={"route": route})


def seeds(asked: argparse.Namespace, usual: int) -> range:
    """Of the worlds that are asked for."""
    return range(asked.seed, asked.seed + (asked.worlds or usual))


def examples() -> Iterator[Named]:
    """All examples of one robot in the plane."""
    for file in sorted((*EXAMPLES.glob("*.yaml"), *EXAMPLES.glob("*.plan"))):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", vs.MissionWarning)
            loaded = vs.load(file)
        if isinstance(loaded, vs.Mission) and not loaded.is_spatial:
            yield file.stem, loaded


TABLES: dict[str, Callable[[argparse.Namespace], None]] = {
    "turns": turns,
    "best-vector": best_vector,
    "best-maps": best_maps,
    "best-examples": best_examples,
    "street": street,
    "straight": straight,
    "sharp": sharp,
    "fatter": fatter,
    "rounds": rounds,
    "stations": stations,
    "signs": signs,
    "lanes": lanes,
    "times": times,
}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("table", choices=TABLES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--worlds", type=int)
    parser.add_argument("--detours", choices=("local", "short"))
    parser.add_argument("--maps", type=Path, default=EXAMPLES / "maps")
    asked = parser.parse_args()
    TABLES[asked.table](asked)


if __name__ == "__main__":
    main()
