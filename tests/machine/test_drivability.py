"""How a path drives, against dense samples of it and finite differences."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path, PathVia
from viaspline.machine.drivability import BENT_1PM, Drivability
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.measure_drivability import drivability_of
from viaspline.machine.turns_on_spot import with_turns
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import SpotTurning
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

SAMPLES = 20_001


def path_of(curve: Any, dwells: dict[int, float] | None = None) -> Path:
    """A path through the joints of a curve, its via points named by their numbers."""
    spans = np.array(curve.spans)
    places = [*spans[:, 0].tolist(), spans[-1, 3].tolist()]
    stays = dwells or {}
    return Path(spans, [
        PathVia(f"via {k}", tuple(at), "user", float(k), stays.get(k, 0.0), k)
        for k, at in enumerate(places)
    ])  # fmt: skip


def timed(path: Path, robot: RobotSpec) -> Trajectory:
    stays = [Station(s, via.dwell, via.name) for via, s in path.stops if via.dwell > 0.0]
    return retime(path, limits_of(robot), with_turns(path, SpotTurning.of(robot), stays))


def driven(path: Path, robot: RobotSpec) -> tuple[Drivability, Trajectory]:
    law = timed(path, robot)
    return drivability_of(path, law, robot, World([])), law


def turned_by(points: np.ndarray) -> np.ndarray:
    """The angle between neighbouring steps of a polyline, left is positive."""
    steps = np.diff(points, axis=0)
    before, after = steps[:-1], steps[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, (before * after).sum(axis=1))


def spline(seed: int, robot: RobotSpec) -> tuple[Path, Drivability, Trajectory]:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0.0, 6.0, (int(rng.integers(3, 7)), 2)), axis=0)
    path = path_of(CardinalSpline(points, tension=float(rng.uniform(-0.5, 0.9))))
    return path, *driven(path, robot)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 2**32 - 1), jerk=st.sampled_from([None, 2.0]))
@example(seed=483, jerk=None)  # it was told of where the middle of a part isn't half of its way
def test_the_figures_bound_dense_samples_and_are_attained(seed: int, jerk: float | None) -> None:
    """Curvature by finite differences of positions, speed by differences of places in time."""
    robot = RobotSpec(max_speed_mps=3.0, max_lateral_accel_mps2=0.7, max_jerk_mps3=jerk)
    path, found, law = spline(seed, robot)
    u = np.linspace(*path.domain, SAMPLES)
    h = 1e-4
    u = u[(np.abs(u - np.round(u)) > 2 * h)]
    before, here, after = (path.evaluate(u + step) for step in (-h, 0.0, h))
    first, second = (after - before) / (2 * h), (after - 2 * here + before) / (h * h)
    speed = np.hypot(*first.T)
    cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    sound = speed > 1e-2 * speed.max()  # where differences are worth something
    for turn in found.turns_on_spot:  # what is turned within three millimetres is no bend
        sound &= np.abs(path.distance(u) - turn.place.distance) > 2e-3
    curvature = np.abs(cross[sound]) / speed[sound] ** 3
    at = np.asarray(law.speed_at(path.distance(u[sound])))
    rough = 1e-3 * curvature.max() + 1e-5
    assert curvature.max() <= 1.0 / found.sharpest_radius + rough
    assert np.max(curvature * at**2) <= found.max_lateral_accel * (1 + 2e-4) + 1e-3
    assert found.max_lateral_accel <= 0.7 * (1 + 1e-9)
    assert found.max_lateral_at is not None
    there = found.max_lateral_at.distance  # it is attained where it is told of
    at_it = path.parameter(there) + 1e-6 * np.array([-1.0, 0.0, 1.0])  # it may jump there
    bent = np.abs(path.curvature(np.clip(at_it, 0.0, len(path.spans)))).max()
    attained = float(bent) * float(law.speed_at(there)) ** 2
    assert found.max_lateral_accel <= attained * (1 + 5e-4) + 1e-6
    assert found.sharpest is not None
    s = found.sharpest.distance  # a turn over a very short way, by positions
    step = min(1e-3 * found.sharpest_radius, 1e-3)
    places = path.at_distance(np.clip(s + step * np.array([-2, -1, 0, 1, 2]), 0.0, path.length))
    bends = np.abs(turned_by(places)) / step
    if step < s < path.length - step:
        assert bends.max() * found.sharpest_radius > 0.45  # half of it where the curvature jumps


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 2**32 - 1))
def test_signs_change_as_often_as_in_dense_samples(seed: int) -> None:
    path, found, _ = spline(seed, RobotSpec())
    u = np.linspace(*path.domain, 10 * SAMPLES)
    curvature = np.asarray(path.curvature(u))
    bent = curvature[np.abs(curvature) > BENT_1PM]
    sampled = int(np.count_nonzero(np.diff(np.sign(bent))))
    assert sampled <= found.sign_changes <= sampled + 2  # a peak may hide between two samples


@settings(deadline=None, max_examples=40)
@given(turn=st.floats(100, 175), reach=st.floats(0.02, 0.3), heading=st.floats(-math.pi, math.pi))
def test_a_turn_by_more_than_120_degrees_within_the_body_is_nearly_a_cusp(
    turn: float, reach: float, heading: float
) -> None:
    """A line there, a bend round one control point, and a line back: all it turns is in the bend.

    The oracle adds up the turns of a polyline where it bends more than the body's circle.
    """
    ahead = np.array([math.cos(heading), math.sin(heading)])
    way = heading + math.radians(turn)
    back = np.array([math.cos(way), math.sin(way)])
    p0, p3 = -reach * ahead, reach * back
    spans = [
        np.linspace(p0 - 10 * ahead, p0, 4),
        [p0, p0 / 3, p3 / 3, p3],
        np.linspace(p3, p3 + 10 * back, 4),
    ]
    path = Path(spans, vias=[])
    robot = RobotSpec(radius_m=0.6)
    found, _ = driven(path, robot)
    bend = path.evaluate(np.linspace(1.0, 2.0, 40_001))
    length = np.hypot(*np.diff(bend, axis=0).T)
    turns = turned_by(bend)
    sharp = np.abs(turns) / length[1:] > 1.0 / 0.6
    total = math.degrees(np.abs(turns[sharp]).sum())
    if abs(total - 120) > 0.5:
        assert len(found.near_cusps) == (1 if total > 120 else 0)
    if found.near_cusps:
        (cusp,) = found.near_cusps
        assert math.degrees(cusp.turn) == pytest.approx(total, abs=0.5)
        assert cusp.length == pytest.approx(length[1:][sharp].sum(), rel=1e-2)
        assert cusp.length <= cusp.turn * 0.6
        assert "nearly a cusp" in found.reasons[0].text


def test_a_near_cusp_is_passed_as_slowly_as_the_limit_across_the_path_asks() -> None:
    path = Path([[(0, 0), (10, 5), (0, 10), (10, 0)]], vias=[])
    robot = RobotSpec(max_speed_mps=3.0)
    found, law = driven(path, robot)
    assert found.sharpest is not None
    slowest = float(law.speed_at(found.sharpest.distance))
    assert slowest == pytest.approx(math.sqrt(found.sharpest_radius), rel=0.06)
    assert found.max_lateral_accel <= 1.0 + 1e-9
    assert [math.degrees(cusp.turn) > 120 for cusp in found.near_cusps] == [True]


@pytest.mark.parametrize("shift", [0.0, 4e6])
def test_a_straight_path_at_an_odd_angle_has_no_sharpest_place(shift: float) -> None:
    points = shift + np.array([(15.5, 8.0), (16.8, 4.9), (18.0, 2.0)])
    points[1] = points[0] + 0.4 * (points[2] - points[0])
    found, _ = driven(path_of(CardinalSpline(points)), RobotSpec(max_lateral_accel_mps2=0.5))
    assert (found.sharpest_radius, found.sharpest) == (math.inf, None)
    assert (found.max_lateral_accel, found.max_lateral_at) == (0.0, None)


@pytest.mark.parametrize("robot", [{"max_yaw_rate_degps": 90}, {}])
@pytest.mark.parametrize("beyond", [1e-6, 1e-4, 0.01, 0.1])
def test_a_turn_within_a_millimetre_is_a_stop_and_a_turn_like_a_cusp(
    beyond: float, robot: dict[str, float]
) -> None:
    """It takes what the true cusp takes, but for the heading that it hasn't got to turn."""
    cusp, near = (path_of(CardinalSpline([(0, 0), (5, 0), (2, y)])) for y in (0.0, beyond))
    (told, law), (found, timed_near) = (driven(one, RobotSpec(**robot)) for one in (cusp, near))
    (turn,), (other,) = found.turns_on_spot, told.turns_on_spot
    assert (turn.speed, found.near_cusps) == (0.0, ())
    assert abs(turn.turn) > math.pi / 2
    assert turn.time == pytest.approx(abs(turn.turn) / math.radians(90) if robot else 0.0)
    assert turn.place.distance == pytest.approx(other.place.distance, abs=0.02)
    driving, taken = law.duration - other.time, timed_near.duration - turn.time
    bends = (math.pi - abs(turn.turn)) / math.radians(90)  # before and behind the turn
    assert driving - 0.1 <= taken <= driving + 0.1 + bends
    assert found.verdict == "rough"
    assert not any("yaw rate" in reason.text for reason in found.reasons)


def test_a_cusp_inside_of_a_span_is_a_turn_on_the_spot_that_nobody_asked_for() -> None:
    path = Path([[(0, 0), (10, 10), (0, 10), (10, 0)]], vias=[])
    found, law = driven(path, RobotSpec(max_yaw_rate_degps=90, turn_on_spot="vias"))
    (turn,) = found.turns_on_spot
    assert (turn.turn, turn.time, turn.asked, turn.speed) == (math.pi, pytest.approx(2), False, 0.0)
    assert turn.place.distance == pytest.approx(path.length / 2)
    assert law.stations[0].name == "turn"
    assert found.verdict == "rough"


@pytest.mark.parametrize(("slowest", "told"), [(1e-7, 0.0), (0.01, 0.01)])
def test_a_cusp_is_stood_at_where_its_place_is_known_no_better(slowest: float, told: float) -> None:
    """Laps behind each other know their places no better than their length allows."""
    path = Path([[(0, 0), (10, 10), (0, 10), (10, 0)]], vias=[])
    half, brake = path.length / 2, (1.0 - slowest**2) / path.length
    law = replace(
        timed(path, RobotSpec()), stations=(), distances=np.array([0.0, half, path.length]),
        speeds=np.array([1.0, slowest, 1.0]), accelerations=np.array([-brake, brake]),
    )  # fmt: skip
    (turn,) = drivability_of(path, law, RobotSpec(), World([])).turns_on_spot
    assert turn.speed == pytest.approx(told, rel=0.1)


@pytest.mark.parametrize(
    ("where", "asked"),
    [("never", [False, False]), ("stations", [False, True]), ("vias", [True] * 2)],
)
def test_a_corner_is_asked_for_where_the_robot_may_turn(where: Any, asked: list[bool]) -> None:
    square = CardinalSpline([(0, 0), (4, 0), (4, 4), (0, 4)], tension=1.0)
    path = path_of(square, {2: 5.0})
    found, _ = driven(path, RobotSpec(turn_on_spot=where))
    assert [turn.asked for turn in found.turns_on_spot] == asked
    assert found.verdict == ("good" if all(asked) else "rough")
    assert (found.sharpest_radius, found.sharpest) == (math.inf, None)
    assert len(found.reasons) == asked.count(False)


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 2**32 - 1), tension=st.sampled_from([1.0, 0.0]))
def test_the_corner_at_the_seam_of_a_round_counts_as_those_inside_of_it(
    seed: int, tension: float
) -> None:
    """A round begins anywhere: where it does, no corner is lost, and none is made."""
    places = np.random.default_rng(seed).uniform(0.0, 30.0, (5, 2))
    robot = RobotSpec(radius_m=0.0)
    told = []
    for first in range(2):
        ring = CardinalSpline(np.roll(places, first, axis=0), tension=tension, closed=True)
        path = path_of(ring)
        law = timed(path, robot)
        found = drivability_of(path, law, robot, World([]), closed=True)
        told.append(sorted(abs(turn.turn) for turn in found.turns_on_spot))
        assert (found.verdict == "rough") == bool(found.turns_on_spot)
        assert len(found.turns_on_spot) == len(places) or tension == 0.0
        inside = drivability_of(path, law, robot, World([])).turns_on_spot
        assert len(found.turns_on_spot) - len(inside) == (tension == 1.0)
    assert told[0] == pytest.approx(told[1])


@settings(deadline=None, max_examples=60)
@given(
    length=st.floats(1.0, 300.0), heading=st.floats(0.0, 6.3), at=st.floats(0.2, 0.8),
    far=st.floats(-50.0, 50.0), yaw=st.sampled_from([None, 90.0]),
)  # fmt: skip
def test_a_straight_line_is_driven_through_where_its_parameter_stands_still(
    length: float, heading: float, at: float, far: float, yaw: float | None
) -> None:
    """P' = (w - at)² ahead: the place goes straight on, and so does the robot."""
    steps = np.array([at * at, at * at - at, (1.0 - at) ** 2]) / 3.0
    along = np.concatenate(([0.0], np.cumsum(steps)))
    ahead = np.array([math.cos(heading), math.sin(heading)])
    span = far + np.outer(along / along[3] * length, ahead)
    path = Path([span], [])
    robot = RobotSpec(max_speed_mps=2.0, max_accel_mps2=0.5, max_yaw_accel_degps2=yaw)
    found, law = driven(path, robot)
    assert found.verdict == "good"
    ramps = min(1.0, (length * 0.5 / 4.0) ** 0.5)  # share of the top speed that is reached
    least = 2.0 * ramps * 4.0 + max(length - 8.0 * ramps**2, 0.0) / 2.0
    assert law.duration == pytest.approx(least, rel=1e-6 if yaw is None else 1e-3)


def test_a_corner_that_no_limit_slows_down_is_said_to_jump() -> None:
    corner = CardinalSpline([(0, 0), (9, 0), (9, 9)], tension=1.0)
    path = path_of(corner)
    robot = RobotSpec(max_lateral_accel_mps2="unlimited", turn_on_spot="vias")
    found, _ = driven(path, robot)
    (turn,) = found.turns_on_spot
    assert turn.speed == pytest.approx(2.0)
    assert "its heading jumps by 90° at 2 m/s near via 1" in found.reasons[0].text


def test_a_time_law_that_is_too_fast_is_told_with_its_limit(bends: Any) -> None:
    path = path_of(bends)
    law = retime(path, Limits(max_speed=6.0, max_accel=3.0, max_lateral_accel=2.0))
    found = drivability_of(path, law, RobotSpec(max_speed_mps=2.0), World([]))
    said = " ".join(why.text for why in found.reasons)
    for words in ("speed is", "acceleration is", "braking is", "acceleration across the path is"):
        assert words in said
    assert "more than 1 m/s²" in said


def test_jumps_of_curvature_are_those_of_the_joints_that_are_driven(bends: Any) -> None:
    path = path_of(bends)
    found, _ = driven(path, RobotSpec())
    jumps = path.curvature_jumps()
    assert found.curvature_jumps == np.count_nonzero(jumps > BENT_1PM)
    assert found.largest_jump == jumps.max()
    assert found.largest_jump_at is not None
    assert found.largest_jump_at.near == f"via {jumps.argmax() + 1}"
    smooth = path_of(CardinalSpline([(0, 0), (15, 4), (25, -4), (40, 8)], tangents="continuous"))
    assert driven(smooth, RobotSpec())[0].curvature_jumps == 0


def test_the_yaw_rate_of_a_drive_is_kept_and_told() -> None:
    path = path_of(CardinalSpline([(0, 0), (3, 0), (3, 3), (6, 3)]))
    slow = RobotSpec(max_yaw_rate_degps=20)
    law = timed(path, RobotSpec())
    found = drivability_of(path, law, slow, World([]))
    assert any("yaw rate" in why.text for why in found.reasons)
    assert not any("yaw rate" in why.text for why in driven(path, slow)[0].reasons)


def test_a_straight_line_drives_well() -> None:
    found, _ = driven(Path([[(0, 0), (3, 1), (6, 2), (9, 3)]], vias=[]), RobotSpec())
    assert (found.verdict, found.sharpest, found.max_lateral_accel) == ("good", None, 0.0)
    assert (found.near_cusps, found.turns_on_spot, found.sign_changes) == ((), (), 0)


def test_a_curve_in_space_is_measured_as_it_climbs() -> None:
    angle = np.linspace(0, 4, 9)
    helix = CardinalSpline(np.column_stack((5 * np.cos(angle), 5 * np.sin(angle), 2 * angle)))
    path = path_of(helix)
    found, _ = driven(path, RobotSpec(max_lateral_accel_mps2=0.3))
    radius = (25 + 4) / 5  # of a helix
    h = 1e-4  # by the angle between tangents, at its free ends it isn't a helix
    u = np.linspace(h, 8 - h, SAMPLES)
    u = u[np.abs(u - np.round(u)) > 2 * h]
    tangents = [path.tangent(u + step) for step in (-h, h)]
    angles = np.linalg.norm(tangents[1] - tangents[0], axis=1)
    bends = angles / (np.asarray(path.distance(u + h)) - np.asarray(path.distance(u - h)))
    assert 1.0 / found.sharpest_radius == pytest.approx(bends.max(), rel=1e-2)
    middle = (u > 3) & (u < 5)
    assert 1.0 / bends[middle].mean() == pytest.approx(radius, rel=0.05)
    assert 0.2 < found.max_lateral_accel <= 0.3
    assert found.reasons == ()
    assert found.sign_changes == 0
