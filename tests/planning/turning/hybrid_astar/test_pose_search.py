import dataclasses
import math
from functools import cache

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapely import affinity

from viaspline.curve.certificate import certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.jit import kernel
from viaspline.kernels.turning import dubins
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError, WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_search import (
    SEARCH_EFFORTS,
    pose_problems,
)
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.row_layers import SHARE_AFTER_FIRST
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.planning.turning.hybrid_astar.shortcut_search import FIRST_SLICE, ShortcutSearch
from viaspline.world.world import World

RHO, RAMP = 4.0, 1.0
DISC = Requirements(radius=0.5, clearance=0.1)
CAR = Requirements(
    radius=0.9, clearance=0.1, footprint=((-1.0, -0.9), (3.2, -0.9), (3.2, 0.9), (-1.0, 0.9))
)


@cache
def open_world():
    return World([], bounds=(-40, -40, 40, 40))


@kernel
def dubins_length(dx, dy, start, goal, rho):
    return dubins.dubins_length(dx, dy, start, goal, rho)


def find_poses(world, requirements, rho, ramp, start, goal, efforts=SEARCH_EFFORTS):
    """The one chain of a row of two places, or why there is none."""
    lots = WorkBudget(math.inf)
    found = find_row(world, requirements, rho, ramp, [start], [goal], lots, efforts)
    return found if isinstance(found, NotFound) else found[0]


def box(x0, y0, x1, y1):
    return Obstacle(polygon=[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def is_sound(chain, world, requirements, start, goal, rho=RHO):
    """Check all that is promised of a chain."""
    assert isinstance(chain, Chain), chain
    curve = PiecewiseCubic(chain.spans)
    assert curve.evaluate(0.0) == pytest.approx((start.x, start.y), abs=1e-12)
    assert curve.evaluate(curve.domain[1]) == pytest.approx((goal.x, goal.y), abs=1e-12)
    at = np.linspace(*curve.domain, 4001)
    heading = curve.heading(at)
    assert math.remainder(heading[0] - start.heading, math.tau) == pytest.approx(0, abs=1e-8)
    assert math.remainder(heading[-1] - chain.end.heading, math.tau) == pytest.approx(0, abs=1e-8)
    if goal.headings:
        gaps = [abs(math.remainder(heading[-1] - each, math.tau)) for each in goal.headings]
        assert min(gaps) < 1e-8
    assert np.abs(curve.curvature(at)).max() * rho < 1.003
    assert curve.curvature_jumps().max(initial=0.0) * rho < 1e-6
    assert curve.length == pytest.approx(chain.length, rel=1e-5)
    if requirements.footprint is None:
        assert certify(curve, world, requirements.kept, radius=requirements.radius).holds
    else:
        assert gap_of(world, requirements, curve.evaluate(at), heading) > requirements.kept - 1e-3


def gap_of(world, requirements, places, headings):
    body = shapely.Polygon(requirements.footprint)
    walls = shapely.union_all([shapely.Polygon(o.polygon) for o in world.obstacles])
    swept = [
        affinity.translate(
            affinity.rotate(body, h, origin=(0, 0), use_radians=True), *place.tolist()
        )
        for place, h in zip(places, headings, strict=True)
    ]
    gap = min((walls.distance(one) for one in swept), default=math.inf) if walls else math.inf
    low, high = np.reshape(world.bounds, (2, 2))
    corners = shapely.get_coordinates(swept)
    return min(gap, (corners - low).min(), (high - corners).min())


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


@cache
def walls():
    parts = [box(5, -20, 6, 3), box(5, 4.6, 6, 20), box(14, -20, 15, -4), box(14, -2.4, 15, 20)]
    return World(parts, bounds=(-20, -20, 30, 20))


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


def test_a_row_of_places_joins_with_headings_that_fit():
    start = Pose(-10, 0, 0)
    goals = [Goal(5.5, 3.8), Goal(14.5, -3.2), Goal(22, 5, (1.0,))]
    chains = find_row(walls(), DISC, RHO, RAMP, [start], goals, WorkBudget(9.0))
    assert not isinstance(chains, NotFound)
    for chain, goal in zip(chains, goals, strict=True):
        is_sound(chain, walls(), DISC, start, goal)
        start = chain.end


def test_a_row_says_which_place_cannot_be_come_to():
    goals = [Goal(0, 5), Goal(5.5, 0), Goal(22, 5)]
    found = find_row(walls(), DISC, RHO, RAMP, [Pose(-10, 0, 0)], goals, WorkBudget(9.0))
    assert isinstance(found, NotFound)
    assert (found.reason, found.goal) == (Reason.GOAL_TAKEN, 1)


def test_a_row_says_that_a_place_cannot_be_come_to_from_anywhere():
    """A dead end is left by its open side, but only come to backwards; all around is open."""
    pocket = [box(-1.2, -1, 8, -0.8), box(-1.2, 0.8, 8, 1), box(-1.2, -0.8, -1, 0.8)]
    world = World(pocket)
    start, goals = Pose(0, 0, 0.0), [Goal(20, 9), Goal(0, 0, (0.0,))]
    found = find_row(world, DISC, RHO, RAMP, [start], goals, WorkBudget(9.0))
    assert isinstance(found, NotFound)
    assert (found.reason, found.goal) == (Reason.GOAL_SHUT_IN, 1)
    one = find_row(world, DISC, RHO, RAMP, [start], goals[:1], WorkBudget(9.0))
    assert isinstance(one, tuple)


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


def test_headings_at_a_place_in_a_corner_are_told_from_what_comes_after_it():
    # by the shortest arrivals there the robot can't leave it again
    room, needs = World(bounds=(0, 0, 12, 12)), Requirements(radius=0.3, clearance=0.0)
    start, goals = Pose(5.82, 1.04, -2.49), [Goal(11.06, 11.57), Goal(7.8, 5.05, (1.31,))]
    chains = find_row(room, needs, 1.0, 1.0, [start], goals, WorkBudget(12.0))
    for chain, goal in zip(chains, goals, strict=True):
        is_sound(chain, room, needs, start, goal, 1.0)
        start = chain.end


def test_a_proof_is_none_where_a_little_sharper_turns_come_through():
    far = DISC.required + RHO - 0.03
    world = World([box(-60, far, 60, far + 1)], bounds=(-70, -70, 70, 70))
    found = find_poses(world, DISC, RHO, RHO, Pose(0, 0, math.pi / 2), Goal(20, -12))
    assert isinstance(found, NotFound)
    assert found.reason is Reason.CLOSE


def row_in_steps(limit, finished):
    """What a row of places comes to in steps that may spend so much, and how many those were."""
    start, goals = Pose(-10, 0, 0), [Goal(5.5, 3.8), Goal(14.5, -3.2), Goal(22, 5, (1.0,))]
    for step in range(1, 500):
        needs = dataclasses.replace(DISC, budget=WorkBudget(limit, finished=dict(finished)))
        try:
            return find_row(walls(), needs, RHO, RAMP, [start], goals, WorkBudget(9.0)), step
        except SpentBudgetError:
            assert needs.budget.spent <= limit
            assert needs.budget.has_gained
            finished = needs.budget.finished
    raise AssertionError("it doesn't end")


def test_a_search_that_is_stopped_and_taken_up_comes_to_what_it_comes_to_at_once():
    at_once, one = row_in_steps(math.inf, {})
    in_steps, several = row_in_steps(0.05, {})
    assert one == 1
    assert several > 2
    for chain, other in zip(at_once, in_steps, strict=True):
        assert other.length == pytest.approx(chain.length, rel=1e-3)


def test_a_step_leaves_what_the_step_before_had_of_a_search_as_it_was():
    needs = dataclasses.replace(DISC, budget=WorkBudget(0.05))
    start, goals = Pose(-10, 0, 0), [Goal(5.5, 3.8), Goal(14.5, -3.2), Goal(22, 5, (1.0,))]
    with pytest.raises(SpentBudgetError):
        find_row(walls(), needs, RHO, RAMP, [start], goals, WorkBudget(9.0))
    before = needs.budget.finished
    rows = [row_in_steps(0.05, before) for _ in range(2)]
    (first, steps), (second, again) = rows
    assert steps == again
    for chain, other in zip(first, second, strict=True):
        np.testing.assert_array_equal(chain.spans, other.spans)


def shortcuts_of(problem, start, goal, segments):
    rho, ramp = problem.moves.sizes[:2].tolist()
    begin = np.array([start.x, start.y, start.heading])
    return ShortcutSearch(problem.search_window.cache, begin, goal, segments, rho, ramp)


def test_shortcuts_along_walls_are_looked_for_a_little_at_a_time():
    start, goal = Pose(-10, 0, 0), Goal(22, 5)
    places = np.array([(start.x, start.y), (goal.x, goal.y)])
    problem = next(pose_problems(walls(), DISC, RHO, RAMP, places, SEARCH_EFFORTS[0]))
    begin, to = np.array([[*dataclasses.astuple(start), 0.0]]), np.array([math.nan])
    tree = problem.forwards(begin, goal, to, SHARE_AFTER_FIRST)
    while not tree.is_over:
        tree.go_on()
    arrival, end = tree.arrivals()[0], np.array([goal.x, goal.y, math.nan])
    at_once = shortcuts_of(problem, start, end, arrival.segments)
    at_once.effort = 1 << 40
    while not at_once.is_over:
        at_once.go_on()
    search, steps = shortcuts_of(problem, start, end, arrival.segments), 0
    while not search.is_over:
        before, search, steps = search, search.copy(), steps + 1
        search.effort = FIRST_SLICE
        search.go_on()
        looked_up = search._cache.reckoned - before._cache.reckoned
        assert looked_up[0] + looked_up[1] // 5 < FIRST_SLICE + 2000  # with those of a last pair
    assert steps > 10
    assert search.length == at_once.length < arrival.cost
    np.testing.assert_array_equal(search.segments, at_once.segments)


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
