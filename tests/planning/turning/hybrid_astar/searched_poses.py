"""Worlds in which poses are searched for, and what is promised of what is found."""

import math
from functools import cache

import numpy as np
import pytest
import shapely
from shapely import affinity

from viaspline.curve.certificate import certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_search import (
    SEARCH_EFFORTS,
)
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    NotFound,
)
from viaspline.world.world import World

RHO, RAMP = 4.0, 1.0
DISC = Requirements(radius=0.5, clearance=0.1)
CAR = Requirements(
    radius=0.9, clearance=0.1, footprint=((-1.0, -0.9), (3.2, -0.9), (3.2, 0.9), (-1.0, 0.9))
)


@cache
def open_world():
    return World([], bounds=(-40, -40, 40, 40))


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


@cache
def walls():
    parts = [box(5, -20, 6, 3), box(5, 4.6, 6, 20), box(14, -20, 15, -4), box(14, -2.4, 15, 20)]
    return World(parts, bounds=(-20, -20, 30, 20))
