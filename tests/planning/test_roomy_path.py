"""Paths that keep more than is required: what they keep, what it costs, what stays open."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.roomy_path import MOST_LATER, MOST_LATER_S
from viaspline.planning.routing.spare_room import spare_room
from viaspline.world.grown_obstacle import grown_world

DISC = {"circle": {"center": [50, 1], "radius": 6}}
GAP = [
    {"name": "upper", "polygon": [[80, 1.2], [84, 1.2], [84, 40], [80, 40]]},
    {"name": "lower", "polygon": [[80, -40], [84, -40], [84, -1.2], [80, -1.2]]},
]
BODIES = (
    {"radius_m": 0.5},
    {"radius_m": 0.5, "min_turn_radius_m": 3.0},
    {"footprint": [[-0.5, -0.5], [1.5, -0.5], [1.5, 0.5], [-0.5, 0.5]]},
)


def _mission(known: list[Any], prefer: float, **robot: Any) -> vs.Mission:
    return vs.Mission.model_validate(
        {
            "world": {"known": known},
            "robot": {"clearance_m": 0.5, "prefer_clearance_m": prefer, **robot},
            "route": {"start": [0, 0], "goal": [100, 0]},
        }
    )


def _outline(obstacle: vs.Obstacle) -> Any:
    """The shape of an obstacle, by shapely alone."""
    if obstacle.circle is not None:
        return shapely.Point(obstacle.circle.center).buffer(obstacle.circle.radius, 256)
    if obstacle.capsule is not None:
        ends = (obstacle.capsule.from_, obstacle.capsule.to)
        return shapely.LineString(ends).buffer(obstacle.capsule.radius, 256)
    return shapely.Polygon(obstacle.polygon)


def _gap(plan: vs.Plan, index: int) -> float:
    """How near the robot's middle comes to an obstacle, by shapely [m]."""
    line = shapely.LineString(plan.path.evaluate(np.linspace(0, len(plan.path.spans), 20_001)))
    return float(line.distance(_outline(plan.world.obstacles[index])))


@pytest.mark.parametrize("robot", BODIES, ids=("disc", "turning circle", "polygon"))
def test_more_is_kept_where_it_costs_little(robot: dict[str, Any]) -> None:
    plain, roomy = (vs.plan(_mission([DISC], prefer, **robot)) for prefer in (0.0, 0.8))
    assert plain.preferred_clearance is None
    assert roomy.preferred_clearance is not None
    assert roomy.preferred_clearance.taken == 0.8
    assert plain.certificate.clearance < 0.6
    assert roomy.certificate.clearance > 1.29
    assert roomy.certificate.required == 0.5


def test_what_is_taken_is_the_most_that_costs_little() -> None:
    weighed = vs.plan(_mission([DISC], 8.0)).preferred_clearance
    assert weighed is not None
    most = weighed.duration + min(MOST_LATER * weighed.duration, MOST_LATER_S)
    assert weighed.most_duration == most
    *dear, taken = weighed.tried
    assert taken.taken
    assert taken.duration is not None
    assert taken.duration <= most
    assert dear
    assert all(one.duration is None or one.duration > most for one in dear)
    assert 0.0 < weighed.taken < 8.0


def test_a_narrow_gap_stays_open_and_the_rest_has_its_room() -> None:
    plan = vs.plan(_mission([DISC, *GAP], 0.8))
    assert plan.preferred_clearance is not None
    assert plan.preferred_clearance.taken == 0.8
    assert plan.certificate.holds
    assert _gap(plan, 0) > 0.5 + 0.5 + 0.79
    assert min(_gap(plan, 1), _gap(plan, 2)) >= 1.0 - 1e-6


def test_a_via_point_that_has_just_room_is_served() -> None:
    beside = {"name": "near the goal", "circle": {"center": [100, 4.05], "radius": 3}}
    plan = vs.plan(_mission([DISC, beside], 2.0))
    assert plan.certificate.holds
    assert _gap(plan, 0) > 1.0 + 0.4


def test_a_world_with_a_map_keeps_more_from_everything() -> None:
    blocked = np.zeros((80, 140), np.bool_)
    blocked[38:43, 65:75] = True
    yard = vs.Obstacle(grid=vs.Grid(blocked, resolution=1.0, origin=(-20.0, -40.0, 0.0)))
    mission = _mission([yard], 0.5)
    plan = vs.plan(mission)
    assert plan.preferred_clearance is not None
    assert plan.certificate.clearance >= 0.5 + plan.preferred_clearance.taken - 1e-6
    assert plan.preferred_clearance.taken > 0.0


def test_the_ledger_has_the_clearance_from_what_stands_there() -> None:
    plan = vs.plan(_mission([DISC], 0.8))
    (entry,) = plan.ledger
    assert entry.chosen is not None
    assert entry.chosen.clearance == pytest.approx(_gap(plan, 0) - 0.5, abs=0.02)
    assert entry.chosen.duration == pytest.approx(plan.trajectory.duration, rel=0.01)


@settings(max_examples=12, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(8, 92), st.floats(-12, 12), st.floats(0.5, 5)), min_size=1, max_size=8
    ),
    st.floats(0.1, 5),
)
def test_nothing_is_refused_that_there_is_without_it(
    discs: list[tuple[float, float, float]], prefer: float
) -> None:
    known = [{"circle": {"center": [x, y], "radius": radius}} for x, y, radius in discs]
    plain = vs.plan(_mission(known, 0.0))
    roomy = vs.plan(_mission(known, prefer))
    assert roomy.certificate.holds
    most = plain.trajectory.duration + min(0.01 * plain.trajectory.duration, 5.0)
    assert roomy.trajectory.duration <= most + 2e-3 * plain.trajectory.duration


@settings(max_examples=30, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(0, 60), st.floats(0, 60), st.floats(0.2, 4), st.integers(0, 2)),
        min_size=2, max_size=9,
    ),
    st.floats(0.1, 2), st.floats(0.1, 5),
)  # fmt: skip
def test_no_gap_is_closed_that_the_robot_fits_through(
    rows: list[tuple[float, float, float, int]], required: float, most: float
) -> None:
    obstacles = [_shape(*row) for row in rows]
    world, places = vs.World(obstacles), np.array([[-9.0, -9.0]])
    room = spare_room(world, places, required, most)
    assert ((room >= 0.0) & (room <= most)).all()
    outlines = [_outline(one) for one in obstacles]
    for i, one in enumerate(outlines):
        for j in range(i):
            gap = one.distance(outlines[j])
            if gap >= 2.0 * required + 1e-3:  # chords of the discs
                assert gap - room[i] - room[j] >= 2.0 * required - 1e-3
    grown = grown_world(world, room)
    x, y = np.meshgrid(np.linspace(-5, 65, 23), np.linspace(-5, 65, 23))
    points = np.column_stack((x.ravel(), y.ravel()))
    outside = (
        shapely.distance(np.array(outlines, object)[:, None], shapely.points(points)[None])
        - np.array(room)[:, None]
    )
    free = (outside > 0.0).all(axis=0)
    assert grown.distance(points)[free] == pytest.approx(outside.min(axis=0)[free], abs=1e-3)
    assert grown.names == world.names


def _shape(x: float, y: float, size: float, kind: int) -> vs.Obstacle:
    if kind == 0:
        return vs.Obstacle(circle={"center": (x, y), "radius": size})
    if kind == 1:
        return vs.Obstacle(capsule={"from": (x, y), "to": (x + size, y + 2.0), "radius": 0.3})
    corners = ((x, y), (x + size, y), (x + size, y + size), (x + 0.5 * size, y + 0.3 * size))
    return vs.Obstacle(polygon=corners, name=None)
