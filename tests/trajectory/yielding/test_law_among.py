"""The law on a fixed path among things that move: sampled and bounded."""

from typing import Any

import numpy as np
import pytest
from on_a_line import LIMITS, cart, line

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.world_spec import SpeedZone
from viaspline.planning.problem.method import Found
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding import leg_arrivals, no_law
from viaspline.trajectory.yielding.law_among import law_among
from viaspline.world.moving_obstacles import MovingObstacles

SAMPLE_S = 0.0005
SHAPES: tuple[dict[str, Any], ...] = (
    {"circle": {"center": (0, 0), "radius": 0.6}},
    {"circle": {"center": (0.5, 0.2), "radius": 0.4}},
    {"polygon": [(-1, -0.4), (1, -0.4), (1, 0.4), (-1, 0.4)]},
    {"polygon": [(0, 0), (1.2, -0.5), (0.4, 0), (1.2, 0.5)]},
    {"capsule": {"from": (-0.8, 0), "to": (0.8, 0), "radius": 0.3}},
)
KINDS = ("loop", "bounce", "stay", "vanish")


def bent(seed: int) -> CardinalSpline:
    """A winding path."""
    x = np.linspace(0.0, 24.0, 6)
    return CardinalSpline(np.stack((x, np.random.default_rng(seed).uniform(-3.0, 3.0, 6)), 1))


def crossing(rng: np.random.Generator, path: PiecewiseCubic, **error: float) -> Obstacle:
    """Something that turns and goes to and fro near a path."""
    count = int(rng.integers(2, 7))
    middle = path.at_distance(rng.uniform(0.15, 0.85) * path.length)
    places = middle + rng.uniform(-7.0, 7.0, (count, 2))
    steps = np.hypot(*np.diff(places, axis=0).T) / rng.uniform(0.4, 2.0)
    times = np.concatenate(([0.0], np.cumsum(np.maximum(steps, 0.2))))
    frames = np.column_stack((times, places, rng.uniform(-180.0, 180.0, count))).tolist()
    shape = SHAPES[int(rng.integers(len(SHAPES)))]
    after = KINDS[int(rng.integers(4))]
    return Obstacle(**shape, motion={"keyframes": frames, "after": after, "error": error})


def traffic(seed: int, path: PiecewiseCubic, count: int, **error: float) -> MovingObstacles:
    """Some of these, each going on in its own way."""
    rng = np.random.default_rng(seed)
    return MovingObstacles([crossing(rng, path, **error) for _ in range(count)])


def nearest_sampled(
    law: Trajectory, path: PiecewiseCubic, moving: MovingObstacles, hold: float = 0.0
) -> float:
    """The smallest distance of the robot's centre from a shape, every 0.5 ms [m]."""
    times = np.arange(law.start_time, law.end_time + hold, SAMPLE_S)
    places = path.at_distance(np.minimum(law.distance_at(times), path.length))
    return float(moving.distance(places, times).min())


def assert_kept(law: Trajectory, limits: Limits, static: Trajectory) -> None:
    """Speeds and accelerations are within the limits, and times within their pieces."""
    assert (np.diff(law.times) >= 0.0).all()
    assert (np.diff(law.distances) >= 0.0).all()
    accelerations = law.accelerations[np.diff(law.times) > 1e-9]
    assert accelerations.max() <= limits.max_accel * (1.0 + 1e-6)
    assert accelerations.min() >= -limits.brake * (1.0 + 1e-6)
    passed = 0.5 * (law.speeds[1:] + law.speeds[:-1]) * np.diff(law.times)
    assert np.allclose(np.diff(law.distances), passed, atol=1e-7)
    s = np.linspace(law.distances[0], law.distances[-1], 3000)
    assert (law.speed_at(s) <= static.speed_at(s) + 1e-4).all()
    assert law.distances[-1] == static.distances[-1]
    assert law.speeds[-1] == 0.0


@pytest.mark.parametrize(
    "seed", [*range(20), *(pytest.param(k, marks=pytest.mark.slow) for k in range(20, 40))]
)
def test_nothing_comes_too_near_between_samples_of_half_a_millisecond(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = line() if seed % 3 == 0 else bent(seed)
    limits = Limits(
        max_speed=rng.uniform(0.8, 3.0),
        max_accel=rng.uniform(0.4, 2.0),
        max_brake=rng.uniform(0.4, 2.0) if seed % 2 else None,
        max_lateral_accel=None if seed % 4 == 0 else 0.8,
    )
    moving = traffic(seed, path, int(rng.integers(1, 6)), position_m=0.05, growth_mps=0.01)
    required, hold = rng.uniform(0.1, 0.6), rng.uniform(0.0, 5.0)
    outcome = law_among(path, limits, moving=moving, required=required, hold=hold)
    if isinstance(outcome, Found):
        law = outcome.value
        assert outcome.cost == law.end_time
        assert nearest_sampled(law, path, moving, hold) >= required
        assert_kept(law, limits, retime(path, limits))


def test_most_of_such_drives_are_found() -> None:
    found = [
        law_among(bent(seed), LIMITS, moving=traffic(seed, bent(seed), 3), required=0.3)
        for seed in range(12)
    ]
    assert sum(isinstance(one, Found) for one in found) >= 8


@pytest.mark.parametrize("bends", [False, True], ids=["line", "bent"])
def test_where_nothing_is_in_the_way_it_is_the_static_law(bends: bool) -> None:
    path = bent(3) if bends else line()
    away = MovingObstacles([cart(15.0, -100.0, -1.0)])
    static = retime(path, LIMITS, [Station(9.0, dwell=2.0)])
    outcome = law_among(path, LIMITS, [Station(9.0, dwell=2.0)], moving=away, required=0.5)
    assert isinstance(outcome, Found)
    assert outcome.value.times.tobytes() == static.times.tobytes()
    assert outcome.value.distances.tobytes() == static.distances.tobytes()
    assert outcome.value.speeds.tobytes() == static.speeds.tobytes()


def test_the_same_traffic_gives_the_same_bytes() -> None:
    path = bent(1)
    one, two = (law_among(path, LIMITS, moving=traffic(5, path, 4), required=0.3) for _ in range(2))
    assert isinstance(one, Found)
    assert isinstance(two, Found)
    assert one.value.times.tobytes() == two.value.times.tobytes()


def test_a_wait_behind_a_crossing_cart_is_as_short_as_it_can_be() -> None:
    """The rear of the disc leaves the path as 15 - sqrt(1.5² - (t - 8)²); the robot goes by it."""
    outcome = law_among(line(), LIMITS, moving=MovingObstacles([cart(15, -8, 1)]), required=0.5)
    t = np.linspace(6.5, 9.5, 300_001)
    late = np.max(2.0 * t - 2.0 - (15.0 - np.sqrt(2.25 - (t - 8.0) ** 2))) / 2.0
    assert isinstance(outcome, Found)
    assert outcome.value.duration >= 17.0 + late - 1e-6
    assert outcome.value.duration <= 1.003 * (17.0 + late)


def fastest_by_brute_force(
    path: PiecewiseCubic, moving: MovingObstacles, required: float, step: float, until: float
) -> float:
    """The earliest arrival on a lattice of flags, checked at its instants alone [s]."""
    pitch = 0.5 * step * step
    count = round(path.length / pitch)
    levels = round(2.0 / step)
    points = path.at_distance(np.minimum(np.arange(count + 1) * pitch, path.length))
    now = np.zeros((levels + 1, count + 1), bool)
    now[0, 0] = True
    for n in range(1, round(until / step)):
        then = np.zeros_like(now)
        for k in range(levels + 1):
            for after in range(max(k - 1, 0), min(k + 1, levels) + 1):
                by = k + after
                then[after, by:] |= now[k, : count + 1 - by]
        now = then & (moving.distance(points, n * step) >= required)
        if now[0, count]:
            return n * step
    return np.inf


@pytest.mark.parametrize("seed", range(8))
def test_it_takes_a_hundredth_longer_than_a_finer_lattice_at_most(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = line(12.0)
    discs = []
    for _ in range(4):
        x, speed = rng.uniform(3.0, 10.0), rng.uniform(0.5, 1.5)
        discs.append(cart(x, -speed * rng.uniform(2.0, 8.0), speed, 0.5))
    moving = MovingObstacles(discs)
    best = fastest_by_brute_force(path, moving, 0.3, 0.05, 30.0)
    outcome = law_among(path, LIMITS, moving=moving, required=0.3)
    assert isinstance(outcome, Found)
    assert outcome.value.duration <= 1.01 * best


def test_a_station_is_left_alone_while_something_passes_over_it() -> None:
    moving = MovingObstacles([cart(15.0, -10.0, 1.0)])
    station = Station(15.0, dwell=4.0, name="pump")
    outcome = law_among(line(), LIMITS, [station], moving=moving, required=0.5)
    assert isinstance(outcome, Found)
    law = outcome.value
    assert law.stations == (station,)
    assert nearest_sampled(law, line(), moving) >= 0.5
    stays = np.flatnonzero((np.diff(law.distances) == 0.0) & (law.distances[:-1] == 15.0))
    assert np.diff(law.times)[stays].sum() >= 4.0 - 1e-9
    assert law.duration < 27.0


@pytest.mark.parametrize("hold", [0.0, 3.0])
def test_a_stay_at_the_end_is_part_of_a_law_that_waits(hold: float) -> None:
    stops = [Station(15.0, dwell=1.0), Station(30.0, dwell=4.0)]
    # it crosses the way as the robot comes, and the end while the robot would still stand there
    moving = MovingObstacles([cart(8.0, -5.0, 1.0), cart(30.0, -23.0, 1.0)])
    outcome = law_among(line(), LIMITS, stops, moving=moving, required=0.5, hold=hold)
    assert isinstance(outcome, Found)
    law = outcome.value
    for stop in stops:
        assert np.ptp(law.times[law.distances == stop.distance]) == pytest.approx(stop.dwell)
    assert law.end_time == outcome.cost
    assert nearest_sampled(law, line(), moving, hold) >= 0.5
    assert_kept(law, LIMITS, retime(line(), LIMITS, stops))


def test_zones_and_slow_bends_are_kept_while_waiting() -> None:
    zone = SpeedZone(polygon=[(8, -9), (12, -9), (12, 9), (8, 9)], max_speed_mps=0.5)
    limits = Limits(max_speed=2, max_accel=1, max_lateral_accel=0.4, max_brake=0.7)
    path = bent(2)
    moving = traffic(2, path, 3)
    outcome = law_among(path, limits, moving=moving, required=0.3, zones=[zone])
    assert isinstance(outcome, Found)
    assert nearest_sampled(outcome.value, path, moving) >= 0.3
    assert_kept(outcome.value, limits, retime(path, limits, zones=[zone]))


@pytest.mark.parametrize("speed", [0.37, 1.0, 1.93, 2.6])
def test_a_start_under_way_is_kept(speed: float) -> None:
    moving = MovingObstacles([cart(15.0, -6.0, 1.0)])
    outcome = law_among(
        line(), LIMITS, moving=moving, required=0.5, start=4.0, start_speed=speed, start_time=1.0
    )
    assert isinstance(outcome, Found)
    law = outcome.value
    assert (law.distances[0], law.speeds[0], law.times[0]) == (4.0, speed, 1.0)
    assert law.accelerations.min() >= -1.0 - 1e-6
    assert nearest_sampled(law, line(), moving) >= 0.5


@pytest.mark.parametrize("name", ["required", "hold"])
def test_numbers_that_make_no_sense_are_refused(name: str) -> None:
    numbers = {"required": 0.5, "hold": 0.0, name: -1.0}
    with pytest.raises(GeometryError, match=name):
        law_among(line(), LIMITS, moving=MovingObstacles(), **numbers)


def test_a_corner_at_the_robot_s_own_place_but_for_rounding_costs_no_search_of_its_own() -> None:
    corner = Path(
        [np.linspace(0.0, 1.0, 4)[:, None] * (0.26, 0.0),
         (0.26, 0.0) + np.linspace(0.0, 1.0, 4)[:, None] * (0.0, 20.0)], vias=[],
    )  # fmt: skip
    across = {"from": (-6.0, 10.0), "velocity_mps": (1.0, 0.0)}
    moving = MovingObstacles([Obstacle(circle={"center": (0, 0), "radius": 1}, motion=across)])
    limits = Limits(max_speed=2, max_accel=1, max_lateral_accel=1)
    spent, ends = [], []
    for before in (0.0, 1e-12):
        budget = WorkBudget(1.0)
        found = law_among(
            corner, limits, moving=moving, required=0.5, start=0.26 - before, budget=budget
        )
        assert isinstance(found, Found)
        spent.append(budget.spent)
        ends.append(found.value.end_time)
    assert ends[1] == pytest.approx(ends[0])
    assert spent[1] <= 1.1 * spent[0]


@pytest.mark.parametrize("seed", range(6))
def test_a_search_that_pauses_comes_to_what_it_comes_to_at_once(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = bent(seed)

    def told() -> object:
        outcome = law_among(path, LIMITS, moving=traffic(seed, path, 6), required=0.6, hold=20.0)
        if isinstance(outcome, Found):
            return outcome.value.times.tobytes()
        return outcome

    at_once = told()
    for module in (leg_arrivals, no_law):
        monkeypatch.setattr(module, "PAUSE_WORDS", 1)
    assert told() == at_once


@pytest.mark.parametrize("apart", [1e-12, 1e-9, 1e-7])
@pytest.mark.parametrize("at", [1.5, 3.0, 14.5])
def test_stations_that_rounding_keeps_apart_are_one_station(at: float, apart: float) -> None:
    """A lattice between the two had places that are nearer to each other than numbers can be."""
    cart = Obstacle(
        circle={"center": (0, 0), "radius": 1},
        motion={"from": (at + 0.5, -8.0), "velocity_mps": (0, 1.0)},
    )
    moving, other = MovingObstacles([cart]), max(at + apart, float(np.nextafter(at, 99.0)))
    two = [Station(at, 2.0), Station(other, 3.0)]
    found = law_among(line(), LIMITS, two, moving=moving, required=0.5)
    one = law_among(line(), LIMITS, [Station(other, 5.0)], moving=moving, required=0.5)
    assert isinstance(found, Found) == isinstance(one, Found)
    if isinstance(found, Found) and isinstance(one, Found):
        assert found.value.duration == pytest.approx(one.value.duration, abs=2e-3)
