"""The certificate in space-time, against samples of half a millisecond by numpy and shapely."""

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.moving_certificate import certify_moving, keeps_from_moving
from viaspline.trajectory.retime import retime
from viaspline.trajectory.timed_body import TimedBody
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

Floats = NDArray[np.float64]
seeds = st.integers(0, 100_000)
SAMPLE_S = 0.0005


# Of missions as they are written: where the frame of an obstacle is, and how far a point is from it


def frames_of(motion: dict[str, Any], times: Floats) -> Floats:
    """x, y, heading of a frame at instants, (n, 3); nan where it isn't there."""
    if "from" in motion:
        places = np.asarray(motion["from"]) + times[:, None] * np.asarray(motion["velocity_mps"])
        return np.column_stack((places, np.zeros(times.size)))
    keys = np.array([[*key, 0.0][:4] for key in motion["keyframes"]])
    first, last = keys[0, 0], keys[-1, 0]
    local = times.copy()
    if motion["after"] == "loop":
        local = first + np.mod(times - first, last - first)
    if motion["after"] == "bounce":
        local = first + np.abs(
            np.mod(times - first + last - first, 2 * (last - first)) - last + first
        )
    frames = np.column_stack([np.interp(local, keys[:, 0], column) for column in keys.T[1:]])
    frames[:, 2] = np.deg2rad(frames[:, 2])
    before = motion.get("before") or ("absent" if motion["after"] == "vanish" else "stay")
    if motion["after"] in ("stay", "vanish") and before == "absent":
        frames[local < first] = np.nan
    if motion["after"] == "vanish":
        frames[local >= last] = np.nan
    return frames


def signed_distance(obstacle: Obstacle, places: Floats) -> Floats:
    """From places in the frame of an obstacle to it; negative inside."""
    if obstacle.circle is not None:
        return np.hypot(*(places - obstacle.circle.center).T) - obstacle.circle.radius
    points = shapely.points(places)
    if obstacle.capsule is not None:
        line = shapely.LineString([obstacle.capsule.from_, obstacle.capsule.to])
        return np.asarray(shapely.distance(points, line)) - obstacle.capsule.radius
    shape = shapely.Polygon(obstacle.polygon)
    outside, inside = shapely.distance(points, shape), shapely.distance(points, shape.exterior)
    return np.where(outside > 0.0, outside, -inside)


def distances(obstacle: Obstacle, motion: dict[str, Any], places: Floats, times: Floats) -> Floats:
    """From places at instants to an obstacle, less how far off it may be; infinite without it."""
    frames = frames_of(motion, times)
    c, s = np.cos(frames[:, 2]), np.sin(frames[:, 2])
    x, y = (places - frames[:, :2]).T
    there = ~np.isnan(x)
    found = np.full(times.size, np.inf)
    own = np.column_stack((c * x + s * y, c * y - s * x))[there]
    found[there] = signed_distance(obstacle, own)
    error = motion.get("error", {})
    growth = error.get("growth_mps", 0.0) * np.maximum(times, 0.0)
    return found - error.get("position_m", 0.0) - growth


def drive(path: PiecewiseCubic, law: Trajectory, hold: float) -> tuple[Floats, Floats]:
    """Instants every half a millisecond, and where the robot is."""
    end = law.end_time + hold
    times = np.append(np.arange(law.start_time, end, SAMPLE_S), end)
    along = np.asarray(law.distance_at(times))
    return times, path.at_distance(np.minimum(along, path.length) if not path.closed else along)[
        :, :2
    ]


# Random drives and motions


def random_shape(rng: np.random.Generator) -> dict[str, Any]:
    size = 10.0 ** rng.uniform(-1.3, 0.2)
    kind = rng.choice(["disc", "off-centre", "capsule", "polygon"])
    if kind == "disc":
        return {"circle": {"center": (0.0, 0.0), "radius": size}}
    offset = rng.uniform(-1, 1, 2)
    if kind == "off-centre":
        return {"circle": {"center": tuple(offset.tolist()), "radius": size}}
    if kind == "capsule":
        to = offset + rng.uniform(-2, 2, 2)
        return {"capsule": {"from": tuple(offset), "to": tuple(to), "radius": size}}
    angle = np.sort(rng.uniform(0, 2 * np.pi, 6) + np.arange(6) * 1e-2)
    reach = size * rng.uniform(0.3, 2, 6)
    return {"polygon": np.column_stack((reach * np.cos(angle), reach * np.sin(angle))) + offset}


def random_motion(rng: np.random.Generator, duration: float) -> dict[str, Any]:
    motion: dict[str, Any] = {}
    if rng.random() < 0.3:
        motion["from"] = rng.uniform(-4, 12, 2).tolist()
        motion["velocity_mps"] = rng.uniform(-2, 2, 2).tolist()
    else:
        count = int(rng.integers(1, 8))
        after = str(rng.choice(["loop", "bounce", "stay", "vanish"] if count > 1 else ["stay"]))
        gaps = rng.uniform(0.05, 1.0, count) * duration * rng.choice([0.1, 0.5])
        times = rng.uniform(-0.2, 0.5) * duration + np.cumsum(gaps)
        columns = [times, rng.uniform(-4, 12, count), rng.uniform(-4, 12, count)]
        if rng.random() < 0.5:
            columns.append(rng.uniform(-400, 400, count))
        motion["keyframes"] = np.column_stack(columns).tolist()
        motion["after"] = after
        if after == "stay" and rng.random() < 0.3:
            motion["before"] = "absent"
    if rng.random() < 0.4:
        motion["error"] = {
            "position_m": float(rng.uniform(0, 0.3)), "growth_mps": float(rng.uniform(0, 0.2)),
        }  # fmt: skip
    return motion


def random_drive(rng: np.random.Generator) -> tuple[PiecewiseCubic, Trajectory, float]:
    path = CardinalSpline(
        rng.uniform(0, 8, (rng.integers(2, 6), int(rng.choice([2, 2, 2, 3])))),
        slack=float(rng.choice([0.0, 0.3, 0.5, 1.0])),
        closed=bool(rng.random() < 0.15),
    )
    limits = Limits(
        max_speed=float(rng.uniform(1, 5)), max_accel=float(rng.uniform(0.3, 3)),
        max_lateral_accel=float(rng.uniform(0.3, 3)) if rng.random() < 0.7 else None,
        max_jerk=float(rng.uniform(0.5, 5)) if rng.random() < 0.15 else None,
    )  # fmt: skip
    stations = [
        Station(float(rng.uniform(0, path.length)), float(rng.uniform(0, 3)))
        for _ in range(rng.integers(0, 3))
    ]
    law = retime(path, limits, stations, start_time=float(rng.choice([0.0, 7.3])))
    return path, law, float(rng.choice([0.0, 0.0, 2.5]))


@given(seeds)
def test_the_bound_is_proven_and_within_a_millimetre(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path, law, hold = random_drive(rng)
    motions = [random_motion(rng, law.duration) for _ in range(rng.integers(0, 9))]
    obstacles = [Obstacle(**random_shape(rng), motion=motion) for motion in motions]
    radius, required = rng.uniform(0, 1, 2)
    found = certify_moving(
        path, law, MovingObstacles(obstacles), required, radius=radius, hold=hold
    )
    times, places = drive(path, law, hold)
    sampled = [distances(*pair, places, times) for pair in zip(obstacles, motions, strict=True)]
    least = min((float(values.min()) for values in sampled), default=math.inf) - radius
    assert found.clearance <= least + 1e-9
    assert found.holds == (found.clearance >= required - PROOF_SLACK_M)
    if found.obstacle is None:
        assert found.clearance == math.inf
        return
    # how near it is at the place and time that are named, by the oracle
    at, when = np.array([found.tightest_at]), np.array([found.tightest_at_s])
    assert law.start_time <= when[0] <= law.end_time + hold
    there = min(
        float(distances(*pair, at, when + nudge)[0])
        for pair in zip(obstacles, motions, strict=True)
        for nudge in (-1e-9, 0.0, 1e-9)  # on either side of a jump
    )
    assert there - radius >= found.clearance - 1e-6
    assert there - radius <= found.clearance + PROOF_TOLERANCE_M + 1e-6
    np.testing.assert_allclose(path.at_distance(found.tightest_distance)[:2], at[0], atol=1e-6)
    np.testing.assert_allclose(law.distance_at(when[0]), found.tightest_distance, atol=1e-6)


# A polygonal body


def body_distances(
    obstacle: Obstacle, motion: dict[str, Any], body: Floats, poses: Floats, times: Floats
) -> Floats:
    """From a body in poses at instants to an obstacle; 0 where they overlap; less its error."""
    frames = frames_of(motion, times)
    there = ~np.isnan(frames[:, 0])
    found = np.full(times.size, np.inf)
    grown = 0.0
    core = obstacle.polygon
    if obstacle.circle is not None:
        core, grown = [obstacle.circle.center] * 3, obstacle.circle.radius
    if obstacle.capsule is not None:
        ends = obstacle.capsule.from_, obstacle.capsule.to
        core, grown = [ends[0], ends[1], ends[0]], obstacle.capsule.radius
    bodies = shapely.polygons(placed(body, poses[there]))
    make = shapely.polygons if obstacle.polygon is not None else shapely.linestrings
    gaps = shapely.distance(bodies, make(placed(np.array(core), frames[there])))
    found[there] = np.maximum(gaps - grown, 0.0)
    error = motion.get("error", {})
    growth = error.get("growth_mps", 0.0) * np.maximum(times, 0.0)
    return found - error.get("position_m", 0.0) - growth


def placed(corners: Floats, frames: Floats) -> Floats:
    """Corners (k, 2) in frames (n, 3): (n, k, 2)."""
    c, s = np.cos(frames[:, 2:]), np.sin(frames[:, 2:])
    x, y = corners.T
    return np.stack((frames[:, :1] + c * x - s * y, frames[:, 1:2] + s * x + c * y), axis=2)


BODY = np.array([(-0.4, -0.5), (1.5, -0.5), (1.5, 0.2), (0.2, 0.3), (-0.4, 0.5)])


@given(seeds)
def test_a_polygonal_body_is_proven_as_it_is(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path, law, hold = random_drive(rng)
    held = float(rng.uniform(-3, 3)) if rng.random() < 0.4 else None
    motions = [random_motion(rng, law.duration) for _ in range(rng.integers(1, 5))]
    obstacles = [Obstacle(**random_shape(rng), motion=motion) for motion in motions]
    found = certify_moving(
        path, law, MovingObstacles(obstacles), 0.3, radius=0.1, footprint=BODY, heading=held,
        hold=hold,
    )  # fmt: skip
    if found.obstacle is None:
        return

    def least(times: Floats) -> float:
        u = path.parameter(np.minimum(law.distance_at(times), path.length))
        headings = np.full(times.size, held) if held is not None else path.heading(u)
        poses = np.column_stack((path.evaluate(u)[:, :2], headings))
        return min(
            float(body_distances(*pair, BODY, poses, times).min())
            for pair in zip(obstacles, motions, strict=True)
        )

    end = law.end_time + hold
    # the last instant belongs to the corner of a closed curve: there the heading is another one
    sampled = np.arange(law.start_time + 1e-6, end - 1e-6, 0.01)
    assert found.clearance <= least(sampled) - 0.1 + 1e-9
    if not path.closed:
        there = least(found.tightest_at_s + np.array([-1e-9, 0.0, 1e-9])) - 0.1
        assert found.clearance <= there + 1e-6
        assert there <= found.clearance + PROOF_TOLERANCE_M + 1e-6


@given(seeds)
def test_it_is_told_alone_whether_a_body_keeps_what_is_asked(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path, law, hold = random_drive(rng)
    motions = [random_motion(rng, law.duration) for _ in range(rng.integers(1, 5))]
    moving = MovingObstacles([Obstacle(**random_shape(rng), motion=motion) for motion in motions])
    held = float(rng.uniform(-3, 3)) if rng.random() < 0.3 else None
    known = certify_moving(
        path, law, moving, 0.3, radius=0.1, footprint=BODY, heading=held, hold=hold
    ).clearance

    def keeps(clearance: float) -> bool:
        return keeps_from_moving(TimedBody(path, law, 0.1, BODY, held, hold), moving, clearance)

    less, more = float(rng.uniform(0.0, 0.5)), float(rng.uniform(0.0, 0.5))
    assert keeps(min(known, 10.0) - 2.0 * PROOF_SLACK_M - less)
    if known < math.inf:
        assert not keeps(known + PROOF_TOLERANCE_M + 2.0 * PROOF_SLACK_M + more)


# Named examples


def disc(radius: float, **motion: Any) -> Obstacle:
    return Obstacle(circle={"center": (0.0, 0.0), "radius": radius}, motion=motion)


def straight(*points: tuple[float, float]) -> CardinalSpline:
    return CardinalSpline(points, tension=1.0)


LIMITS = Limits(max_speed=2.0, max_accel=1.0)


def test_two_that_meet_head_on_overlap_by_all_of_both() -> None:
    path = straight((0, 0), (20, 0))
    oncoming = disc(1.0, **{"from": (20, 0), "velocity_mps": (-1, 0)})
    found = certify_moving(path, retime(path, LIMITS), MovingObstacles([oncoming]), 0.5, radius=0.5)
    assert found.clearance == pytest.approx(-1.5, abs=1e-3)
    assert not found.holds


def test_one_that_drives_beside_the_robot_keeps_its_distance() -> None:
    path = straight((0, 0), (20, 0))
    law = retime(path, LIMITS)
    beside = disc(
        0.5, keyframes=[(t, float(law.distance_at(t)), 2.0) for t in (0, 2, 10, 12)], after="stay"
    )
    found = certify_moving(path, law, MovingObstacles([beside]), 0.9, radius=0.5)
    assert found.clearance == pytest.approx(1.0, abs=1e-3)
    assert found.holds


def test_what_comes_after_the_end_counts_as_long_as_the_robot_is_to_stand_there() -> None:
    path = straight((0, 0), (4, 0))
    law = retime(path, LIMITS)
    late = MovingObstacles([disc(0.5, keyframes=[(0, 4, 9), (9, 4, 0)], after="stay")])
    assert certify_moving(path, law, late, 0.5).holds
    held = certify_moving(path, law, late, 0.5, hold=20.0)
    assert held.clearance == pytest.approx(-0.5, abs=1e-3)
    assert held.tightest_at_s >= 9.0 - 1e-3
    assert held.tightest_at == pytest.approx((4.0, 0.0))


def test_a_stop_is_exposed_while_it_lasts() -> None:
    path = straight((0, 0), (10, 0))
    crossing = MovingObstacles([disc(0.5, **{"from": (5, -30), "velocity_mps": (0, 1)})])
    assert certify_moving(path, retime(path, LIMITS), crossing, 1.0).holds
    waiting = retime(path, LIMITS, [Station(5.0, dwell=60.0)])
    found = certify_moving(path, waiting, crossing, 1.0)
    assert found.clearance == pytest.approx(-0.5, abs=1e-3)
    assert found.tightest_at_s == pytest.approx(30.0, abs=0.1)


def test_both_sides_of_a_jump_at_the_seam_of_a_loop_count() -> None:
    path = straight((0, 0), (20, 0))
    law = retime(path, LIMITS)
    jumping = disc(0.5, keyframes=[(0, 11, 8), (6.5, 11, 2)], after="loop")
    found = certify_moving(path, law, MovingObstacles([jumping]), 1.0)
    assert found.obstacle == "moving obstacle 1"
    assert found.clearance == pytest.approx(1.5, abs=1e-3)  # as it jumps away from (11, 2)
    assert found.tightest_at_s == pytest.approx(6.5, abs=1e-6)


def test_nothing_is_near_where_nothing_is() -> None:
    path = straight((0, 0), (20, 0))
    law = retime(path, LIMITS)
    gone = disc(0.5, keyframes=[(-9, 0, 0), (-5, 3, 0)], after="vanish")
    for moving in (MovingObstacles(), MovingObstacles([gone])):
        found = certify_moving(path, law, moving, 1.0)
        assert found.clearance == math.inf
        assert found.obstacle is None
        assert found.holds


def test_a_long_body_turns_on_the_spot_at_a_corner() -> None:
    path = straight((0, 0), (5, 0), (5, 5))
    law = retime(path, Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=1.0))
    body = [(-0.5, -0.2), (2.0, -0.2), (2.0, 0.2), (-0.5, 0.2)]
    # at 45 degrees from the corner, where neither leg of the way has the body
    lamp = disc(0.1, keyframes=[(0, 6.6, 1.6)], after="stay")
    found = certify_moving(path, law, MovingObstacles([lamp]), 0.0, footprint=body)
    across = math.hypot(1.6, 1.6) - math.hypot(2.0, 0.2) - 0.1
    assert found.clearance == pytest.approx(across, abs=2e-3)
    assert found.tightest_at == pytest.approx((5.0, 0.0), abs=1e-2)
    turned = found.heading
    assert turned is not None
    assert 0.5 < turned < 1.1


def test_what_makes_no_sense_is_refused_by_name() -> None:
    path = straight((0, 0), (20, 0))
    law, none = retime(path, LIMITS), MovingObstacles()
    with pytest.raises(GeometryError, match="hold"):
        certify_moving(path, law, none, 1.0, hold=math.inf)
    with pytest.raises(GeometryError, match="clearance"):
        certify_moving(path, law, none, math.nan)
    with pytest.raises(GeometryError, match="moving"):
        certify_moving(path, law, [5], 1.0)  # type: ignore[arg-type]
    with pytest.raises(GeometryError, match="law of this path"):
        certify_moving(straight((0, 0), (5, 0)), law, none, 1.0)
