"""Routes among buildings, led over everything by a router of the test's own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.certificate import Certificate
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism
from viaspline.space.laying.laid_route import CurveShape
from viaspline.space.led_route import KnownWays
from viaspline.space.solve_route import solve_route
from viaspline.space.spatial_problem import SpatialProblem, SpatialVia
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.weighed_ways import TautWay
from viaspline.trajectory.limits import Limits
from viaspline.world.space.spatial_world import SpatialWorld

LIMITS = SpatialLimits(along=Limits(max_speed=8, max_accel=2, max_lateral_accel=2), climb=3)
ROOF = 30.0


class OverAll:
    """Goes over everything, two metres above all roofs or, which takes longer, ten."""

    def __init__(self, asked: SpatialProblem) -> None:
        self.asked = asked

    def gates(self, leg: int) -> Floats:
        return np.empty((0, 8))

    def ways(self, leg: int, proof: Certificate) -> list[TautWay]:
        found = []
        for above in (2.0, 10.0):
            inner = self.asked.places[leg : leg + 2].copy()
            inner[:, 2] = ROOF + above
            found.append(TautWay("over", inner, 200.0 + above))
        return found

    def defers(self, proof: Certificate) -> bool:
        return False

    def others(self, leg: int, proof: Certificate) -> list[TautWay]:
        return []

    def pulled(self, leg: int, way: Floats) -> Floats | None:
        return None


def blocks(seed: int) -> SpatialWorld:
    rng = np.random.default_rng(seed)
    found = []
    for x, y in rng.uniform(40, 160, (5, 2)).tolist():
        w, h, roof = rng.uniform(5, 20, 3).tolist()
        ring = RoundedRing([[(x, y), (x + w, y), (x + w, y + h), (x, y + h)]])
        found.append(Prism(ring, 0.0, min(roof + 10, ROOF)))
    return SpatialWorld.of(found, ground=0.0)


def problem(world: SpatialWorld, vias: list[list[float]], **more: object) -> SpatialProblem:
    points = [SpatialVia(f"via {k}", np.array(at, float), k) for k, at in enumerate(vias)]
    return SpatialProblem(
        world, points, 1.0, 0.5, LIMITS, CurveShape(np.zeros(len(vias) - 1)), **more
    )  # type: ignore[arg-type]


@settings(max_examples=15)
@given(seed=st.integers(0, 10_000))
def test_a_path_serves_every_via_point_and_keeps_its_clearance_everywhere(seed: int) -> None:
    world = blocks(seed)
    vias = [[10.0, 10, 20], [190, 190, 12], [10, 180, 25], [190, 20, 8]]
    asked = problem(world, vias)
    found = solve_route(asked, OverAll(asked))
    assert [via.name for via in found.path.vias if via.kind == "user"] == [
        "via 0", "via 1", "via 2", "via 3"
    ]  # fmt: skip
    for via in found.path.vias:
        assert np.array_equal(found.path.evaluate(via.u), via.at)
    assert found.certificate.holds
    places = found.path.at_distance(np.linspace(0, found.path.length, 4000))
    assert world.distance(places).min() >= 1.5 - 1e-6
    assert found.certificate.clearance <= world.distance(places).min() - 0.5 + 1e-9


def test_a_drone_takes_off_flies_its_laps_and_lands() -> None:
    round_trip = [[50.0, 50, 20], [90, 50, 20], [90, 90, 25], [50, 50, 20]]
    asked = problem(
        SpatialWorld.of([], ground=0.0), round_trip, laps=2,
        takeoff=np.array([50.0, 50, 0]), landing=np.array([50.0, 50, 0]),
    )  # fmt: skip
    found = solve_route(asked, OverAll(asked))
    names = [via.name for via in found.path.vias]
    assert names == [
        "via 0", "take-off", "via 1", "via 2", "via 3", "via 1", "via 2", "landing", "via 3"
    ]  # fmt: skip
    assert found.airborne[0] == 20.0
    assert np.isclose(found.path.length - found.airborne[1], 20.0)
    # Only where it stands on the ground is it near it, and there the ground doesn't count.
    assert found.certificate.clearance > 15.0
    for via in found.path.vias:
        assert np.allclose(found.path.evaluate(via.u), via.at)


def test_what_stands_in_the_way_of_a_take_off_counts() -> None:
    roof = Prism(RoundedRing([[(50.0, 50.0)]], 4.0), 8.0, 9.0)
    world = SpatialWorld.of([roof], ["roof"], ground=0.0)
    asked = problem(world, [[50.0, 50, 20], [90, 50, 20]], takeoff=np.array([50.0, 50, 0]))
    with pytest.raises(NoPathError, match="the climb of take-off") as error:
        solve_route(asked, OverAll(asked))
    assert error.value.obstacles == ("roof",)
    assert error.value.where[2] < 20.0


def test_ways_of_legs_that_another_problem_shares_are_looked_for_once() -> None:
    world = blocks(3)
    asked = problem(world, [[10.0, 10, 20], [190, 190, 12], [10, 180, 25], [190, 20, 8]])
    other = replace(asked, vias=(SpatialVia("here", np.array([20.0, 5, 20]), 0), *asked.vias[1:]))
    known: KnownWays = {}
    solve_route(asked, OverAll(asked), known)
    led = len(known)
    found = solve_route(other, OverAll(other), known)
    legs_anew = [key for key in list(known)[led:] if key[0].name != "here"]
    assert led > 1
    assert not legs_anew
    assert np.array_equal(found.path.spans, solve_route(other, OverAll(other)).path.spans)
