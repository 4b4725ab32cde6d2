import dataclasses
import math
from functools import cache

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from searched_poses import (
    CAR,
    DISC,
    RAMP,
    RHO,
    box,
    find_poses,
    gap_of,
    is_sound,
    open_world,
    walls,
)

from viaspline.curve.certificate import certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.jit import kernel
from viaspline.kernels.turning import dubins
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.turning.hybrid_astar.pose_search import (
    SEARCH_EFFORTS,
    pose_problems,
)
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.world.world import World


@kernel
def dubins_length(dx, dy, start, goal, rho):
    return dubins.dubins_length(dx, dy, start, goal, rho)


def test_in_the_open_it_is_little_longer_than_the_way_of_dubins():
    rng = np.random.default_rng(3)
    for _ in range(25):
        x, y = rng.uniform(-20, 20, 2)
        heading = rng.uniform(-math.pi, math.pi)
        start, goal = Pose(0, 0, 0), Goal(x, y, (heading,))
        chain = find_poses(open_world(), DISC, RHO, 0.4, start, goal)
        is_sound(chain, open_world(), DISC, start, goal)
        least = dubins_length(x, y, 0.0, heading, RHO)
        assert least - 1e-6 <= chain.length < 1.08 * least + 0.5


def test_a_goal_of_any_heading_is_come_to_straight():
    start, goal = Pose(0, 0, 0), Goal(15, 8)
    chain = find_poses(open_world(), DISC, RHO, RAMP, start, goal)
    is_sound(chain, open_world(), DISC, start, goal)
    assert chain.length < 1.02 * dubins_length(15, 8, 0.0, chain.end.heading, RHO)


def test_of_the_allowed_headings_one_is_taken():
    start, goal = Pose(0, 0, 0), Goal(12, 0, (math.pi, 0.1, -1.5))
    chain = find_poses(open_world(), DISC, RHO, RAMP, start, goal)
    is_sound(chain, open_world(), DISC, start, goal)
    assert chain.end.heading == 0.1


def test_a_disc_gets_through_two_doors():
    start, goal = Pose(-10, 0, 0), Goal(22, 5, (1.0,))
    chain = find_poses(walls(), DISC, RHO, RAMP, start, goal)
    is_sound(chain, walls(), DISC, start, goal)


@cache
def yard():
    parked = [box(x, y, x + 2.0, y + 5.0) for x in (0, 2.6, 8.2, 10.8) for y in (0, 14)]
    return World(parked, bounds=(-12, -1, 25, 20))


def test_a_car_drives_out_of_one_bay_and_into_another():
    start, goal = Pose(6.4, 1.5, math.pi / 2), Goal(7.0, 15.5, (math.pi / 2,))
    chain = find_poses(yard(), CAR, RHO, RAMP, start, goal)
    is_sound(chain, yard(), CAR, start, goal)


def test_backing_out_of_a_bay_is_not_asked_for():
    start, inside = Pose(-8, 9.5, 0.0), Pose(6.4, 17, math.pi / 2)
    closed = World([*yard().obstacles, box(4, 19.1, 9, 19.5)], bounds=yard().bounds)
    chain = find_poses(closed, CAR, RHO, RAMP, start, Goal(6.4, 15.0, (math.pi / 2,)))
    is_sound(chain, closed, CAR, start, Goal(6.4, 15.0, (math.pi / 2,)))
    assert gap_of(closed, CAR, np.array([[6.4, 15.0]]), [math.pi / 2]) > CAR.kept
    stuck = Pose(6.4, 15.0, math.pi / 2)
    found = find_poses(closed, CAR, RHO, RAMP, stuck, Goal(start.x, start.y, (0.0,)))
    assert isinstance(found, NotFound)
    assert found.reason is Reason.START_SHUT_IN
    found = find_poses(closed, CAR, RHO, RAMP, start, Goal(6.4, 15.0, (-math.pi / 2,)))
    assert isinstance(found, NotFound)
    assert found.reason is Reason.GOAL_SHUT_IN
    found = find_poses(closed, CAR, RHO, RAMP, start, Goal(inside.x, inside.y, (0.0,)))
    assert found.reason is Reason.GOAL_TAKEN


def test_the_same_task_gives_the_same_bytes():
    start, goal = Pose(-10, 0, 0), Goal(22, 5)
    one, two = (find_poses(walls(), DISC, RHO, RAMP, start, goal) for _ in range(2))
    assert one.spans.tobytes() == two.spans.tobytes()


def test_a_mirrored_world_has_a_way_of_about_the_same_length():
    mirrored = World(
        [Obstacle(polygon=[(x, -y) for x, y in o.polygon]) for o in walls().obstacles],
        bounds=walls().bounds,
    )
    one = find_poses(walls(), DISC, RHO, RAMP, Pose(-10, 0, 0), Goal(22, 5, (1.0,)))
    two = find_poses(mirrored, DISC, RHO, RAMP, Pose(-10, 0, 0), Goal(22, -5, (-1.0,)))
    assert one.length == pytest.approx(two.length, rel=0.03)


def test_a_car_gets_out_of_a_bay_with_short_moves_and_across_a_field_with_long_ones():
    lane = [box(-60, -60, -0.25, -3), box(3.05, -60, 60, -3), box(-60, 5.5, -9, 60)]
    world = World([*lane, box(-9, 5.5, 60, 60)], bounds=(-60, -60, 60, 60))
    start, goal = Pose(1.4, -30.0, math.pi / 2), Goal(40.0, 1.0, (0.0,))
    chain = find_poses(world, CAR, RHO, RAMP, start, goal)
    is_sound(chain, world, CAR, start, goal)


def test_what_a_window_shows_a_mere_edge_of_is_driven_in_a_greater_one():
    """Two aisles are joined beyond the first window, at whose edge the disc can't turn."""
    rho, edge = 1.0, 0.05
    top = 3.0 * rho - edge  # the window ends farther by what the disc keeps
    world = World([box(-3.0, -30.0, 3.0, top)], bounds=(-30.0, -30.0, 30.0, 30.0))
    start, goal = Pose(-5.0, 0.0, -0.5 * math.pi), Goal(5.0, 0.0, (-0.5 * math.pi,))
    chain = find_poses(world, DISC, rho, 0.2 * rho, start, goal, SEARCH_EFFORTS[:1])
    assert isinstance(chain, Chain), chain
    curve = PiecewiseCubic(chain.spans)
    assert curve.evaluate(len(chain.spans)) == pytest.approx((goal.x, goal.y), abs=1e-9)
    assert certify(curve, world, DISC.clearance, radius=DISC.radius).holds


def reachable(world, radius, start, goal, step=0.5, side=0.25, sectors=96):
    """Whether a point goes with sudden turns from near a pose to near a place: all states."""
    turns = np.array([-1.0, -0.5, 0.0, 0.5, 1.0]) * step / RHO
    open_, seen = [start], set()
    while open_:
        x, y, heading = open_.pop()
        if math.hypot(x - goal[0], y - goal[1]) < 1.0:
            return True
        half = heading + 0.5 * turns
        places = np.column_stack((x + step * np.cos(half), y + step * np.sin(half)))
        middles = 0.5 * (places + np.array([x, y]))
        clear = np.minimum(world.distance(places), world.distance(middles)) > radius
        for place, turn in zip(places[clear].tolist(), turns[clear].tolist(), strict=True):
            turned = (heading + turn) % math.tau
            key = (*(round(v / side) for v in place), round(turned / math.tau * sectors))
            if key not in seen:
                seen.add(key)
                open_.append((*place, turned))
    return False


@pytest.mark.parametrize("width", [5.0, 7.0, 20.0])
def test_what_is_refused_is_out_of_reach_even_with_sudden_turns(width):
    # a yard with a gate behind the robot: it has to turn round in the yard
    far = width + 1
    yard = [box(-1, -1, far, 0), box(-1, width, far, far), box(width, 0, far, width)]
    yard += [box(-1, 0, 0, 0.5 * width - 1), box(-1, 0.5 * width + 1, 0, width)]
    world = World(yard, bounds=(-14, -4, width + 4, width + 4))
    start, goal = Pose(1.5, 0.5 * width, 0.0), Goal(-8, 0.5 * width)
    found = find_poses(world, DISC, RHO, 0.4, start, goal)
    if isinstance(found, NotFound):
        assert found.reason is Reason.START_SHUT_IN
        pose = (start.x, start.y, start.heading)
        assert not reachable(world, DISC.required, pose, (goal.x, goal.y))
    else:
        is_sound(found, world, DISC, start, goal)
    assert isinstance(found, Chain) == (width > 10.0)


def test_a_way_begins_with_an_arc_that_a_longer_ramp_has_no_room_for():
    # on the side of the disc there is none; past the corner of the box an arc keeps 0.95 m of 0.8,
    # with a ramp of half its radius 0.55 m
    ring = [(19.364, 20.592), (18.169, 21.644), (17.117, 20.448), (18.312, 19.396)]
    known = [Obstacle(polygon=ring), Obstacle(circle={"center": (17.835, 25.077), "radius": 1.899})]
    world = World(known, bounds=(-3, -3, 39, 39))
    needs = Requirements(radius=0.5, clearance=0.3)
    start, goal = Pose(15.166, 22.712, -0.30859), Goal(35.097, 19.765)
    chain = find_poses(world, needs, 1.6, 1.6, start, goal)
    is_sound(chain, world, needs, start, goal, 1.6)


@settings(max_examples=8)
@given(
    st.floats(0.5, 6.0), st.floats(0.6, 1.5), st.sampled_from([-0.01, 0.02, 0.1]),
    st.floats(-math.pi, math.pi),
)  # fmt: skip
@example(4.0, math.pi / 2, 0.02, 0.0)
@example(4.0, math.pi / 2, -0.01, 0.0)
def test_a_robot_turns_away_from_a_wall_wherever_its_circle_leaves_room(rho, towards, spare, askew):
    """Driving towards a wall it comes nearer to it by ``rho * (1 - cos(towards))``, and no less."""
    far = DISC.required + rho * (1.0 - math.cos(towards) + spare)
    c, s = math.cos(askew), math.sin(askew)

    def turned(x, y):
        return c * x - s * y, s * x + c * y

    corners = [(-15 * rho, far), (15 * rho, far), (15 * rho, far + 1), (-15 * rho, far + 1)]
    edge = 25.0 * rho
    wall = Obstacle(polygon=[turned(*place) for place in corners])
    world = World([wall], bounds=(-edge, -edge, edge, edge))
    start, goal = Pose(0.0, 0.0, towards + askew), Goal(*turned(5.0 * rho, -3.0 * rho))
    found = find_poses(world, DISC, rho, rho, start, goal)
    if spare < 0.0:
        assert isinstance(found, NotFound)
    else:
        is_sound(found, world, DISC, start, goal, rho)


def body_problem(requirements):
    places = np.array([(0.0, 0.0), (20.0, 0.0)])
    return next(pose_problems(open_world(), requirements, RHO, RAMP, places, SEARCH_EFFORTS[-1]))


def test_a_search_turns_round_at_a_gap_that_is_too_narrow_without_seeing_all_before_it():
    side = 2.0 * DISC.required - 0.06
    low, high = -0.5 * side, 0.5 * side
    shut = World(
        [box(9.5, -15.0, 10.0, low), box(9.5, high, 10.0, 30.0)], bounds=(-20, -15, 40, 40)
    )
    found = find_poses(shut, DISC, RHO, RAMP, Pose(0, 0, 0), Goal(25.0, 0.0))
    assert isinstance(found, Chain)
    assert found.expanded < 20_000


def test_a_body_is_looked_at_no_more_finely_than_what_is_kept_round_it_asks_for():
    wide = dataclasses.replace(CAR, clearance=2.0)
    near, far = body_problem(CAR), body_problem(wide)
    assert len(far.search_window.body.discs) < len(near.search_window.body.discs)
    assert far.search_window.pace > 2.0 * near.search_window.pace


def test_a_point_has_moves_of_no_more_places_than_a_body():
    point = body_problem(Requirements(radius=0.0, clearance=0.0))
    assert point.moves.places.shape[1] < 2000
