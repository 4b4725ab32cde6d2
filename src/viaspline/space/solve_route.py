"""From a spatial problem to a path that is proven clear.

The spline first; legs that aren't clear are led round what stands there, on the side that costs
least; then the curve is proven once more as a whole, with the upright legs of take-off and landing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import Final

import numpy as np

from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GaveUpError, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.space.cheapest_route import CheapestRoute
from viaspline.space.laying.clear_route import ClearRoute, StuckLegError
from viaspline.space.laying.corner_rounding import straight_span
from viaspline.space.laying.gentle_turns import DEARER, ROUND_DEARER, GentleTurns
from viaspline.space.laying.laid_route import LaidRoute, RouteLegs
from viaspline.space.laying.via_directions import via_directions
from viaspline.space.laying.via_turns import ROOMY
from viaspline.space.led_route import KnownWays, RouteLayer
from viaspline.space.leg_check import LegCheck, proven
from viaspline.space.part_of_path import part_of_path
from viaspline.space.route_law import LANDING, TAKE_OFF, cost_of
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_solution import SpatialSolution
from viaspline.space.weighed_ways import (
    WaysPast,
    away_from_things,
    least_radius,
)
from viaspline.space.without_ground import without_ground

FLIGHT, CLIMB, DESCENT = "flight", "climb of take-off", "descent to the landing"
"""The parts of a path."""

_UPRIGHT_REMEDIES: Final = {
    CLIMB: "begin where the sky is free",
    DESCENT: "land where the sky is free, or come from a lower place",
}


def solve_route(
    problem: SpatialProblem, router: WaysPast, known: KnownWays | None = None
) -> SpatialSolution:
    """Find a path.

    Args:
        problem: What is asked.
        router: What finds the ways past things.
        known: Ways of legs that were found for problems that differ in their via points alone;
            those that are found are added.

    Raises:
        NoPathError: When there is none, proven.
        GaveUpError: When none was found.
    """
    legs = RouteLegs.left_to_the_spline(
        problem.places, _directions(problem), problem.shape, ROOMY * least_radius(problem)
    )
    check = LegCheck(problem, cache(router.gates))
    layer = RouteLayer(problem, router, check, known={} if known is None else known)
    try:
        routes = CheapestRoute(layer).routes(legs)
    except StuckLegError as stuck:
        raise _gave_up(problem, stuck) from None
    first = problem.vias[0]
    turns = GentleTurns(
        least_radius(problem), layer.radius, layer.laid_anew, cost_of(problem),
        away_from_things(problem), router.pulled,
        is_rolling=first.dwell is None and first.direction is not None,
        dearer=DEARER if problem.objective == "length" else ROUND_DEARER,
    )  # fmt: skip
    found = turns.best_of(routes)
    path, airborne = _whole_path(problem, found)
    proofs = part_proofs(problem, path, airborne, layer.check.proof)
    part, proof = min(proofs.items(), key=lambda each: each[1].clearance)
    if not proof.holds:
        raise _not_clear(problem, proof, part, path)
    return SpatialSolution(path, proof, layer.account(found), airborne)


def _directions(problem: SpatialProblem) -> Floats:
    """Directions that are fixed at the via points, (n, 3), NaN where free.

    A round that has none where it closes passes there as the spline would, so that it closes
    smoothly; but not where it lands there, for it hovers before that.
    """
    free = np.full(3, np.nan)
    given = np.array([free if via.direction is None else via.direction for via in problem.vias])
    lands = problem.landing is not None
    if problem.is_round and not lands and np.isnan(given[[0, -1]]).all():
        places = problem.places
        around = np.array([places[-2], places[0], places[1]])
        none = np.empty((0, 3))
        seam = via_directions(around, (none, none), np.full((3, 3), np.nan))[1]
        given[0] = given[-1] = seam
    return given


def _gave_up(problem: SpatialProblem, stuck: StuckLegError) -> GaveUpError:
    first, last = problem.vias[stuck.leg], problem.vias[stuck.leg + 1]
    return GaveUpError(
        f"no smooth curve from '{first.name}' to '{last.name}' was found that keeps "
        f"{problem.clearance:g} m",
        where=stuck.place.tolist(),
        remedy="give the route a via point beside it, or ask for less clearance",
        tried=("the spline", "the taut ways with corners as tight as can be"),
        via=last.name,
    )


def _not_clear(
    problem: SpatialProblem, proof: Certificate, part: str, path: Path
) -> NoPathError | GaveUpError:
    """That a part of the path isn't proven clear.

    Straight up or down there is no other way; where via points are served in an order that was
    found, it isn't known before from where the robot comes down.
    """
    name = proof.obstacle or "an obstacle"
    kept = f"{problem.clearance:g} m are to be kept"
    near = f"comes within {max(proof.clearance, 0.0):.3g} m of '{name}', and {kept}"
    if part != FLIGHT:
        return NoPathError(
            f"the {part} {near}",
            where=proof.tightest_at,
            remedy=_UPRIGHT_REMEDIES[part],
            obstacles=(name,),
        )
    ahead = [via.name for via, distance in path.stops if distance > proof.tightest_distance]
    return GaveUpError(
        f"the best curve that was found {near}",
        where=proof.tightest_at,
        remedy="give the route a via point beside it, or ask for less clearance",
        tried=("all legs, each of which was clear alone",),
        via=ahead[0] if ahead else problem.vias[-1].name,
        obstacles=(name,),
    )


def _whole_path(problem: SpatialProblem, found: ClearRoute) -> tuple[Path, tuple[float, float]]:
    """All laps with the upright legs before and after, and from where to where it is airborne."""
    laid = found.laid
    count = len(laid.spans)
    spans = [laid.spans] * problem.laps
    vias: list[PathVia] = []
    for lap in range(problem.laps):
        vias += _lap_vias(problem, laid, lap, count)
    before = 0
    if problem.takeoff is not None:
        spans.insert(0, straight_span(problem.takeoff, laid.spans[0, 0])[None])
        before = 1
    if problem.landing is not None:
        spans.append(straight_span(laid.spans[-1, 3], problem.landing)[None])
    every = np.concatenate(spans)
    vias = [_moved(via, before) for via in vias]
    if problem.takeoff is not None:
        start = problem.vias[0]
        ground = PathVia(start.name, tuple(problem.takeoff.tolist()), "user", 0.0, 0.0, start.index)
        top = vias[0]
        vias[0] = PathVia(TAKE_OFF, top.at, "user", top.u, top.dwell, None)
        vias.insert(0, ground)
    if problem.landing is not None:
        goal = problem.vias[-1]
        at = tuple(problem.landing.tolist())
        top = vias[-1]
        vias[-1] = PathVia(LANDING, top.at, "user", top.u, top.dwell, None)
        vias.append(PathVia(goal.name, at, "user", float(len(every)), 0.0, goal.index))
    path = Path(every, vias)
    ends = np.asarray(path.distance([float(before), float(before + count * problem.laps)]))
    return path, (float(ends[0]), float(ends[1]))


def _lap_vias(problem: SpatialProblem, laid: LaidRoute, lap: int, count: int) -> list[PathVia]:
    """The via points of one lap in order; the seam belongs to the lap that begins there."""
    offset = lap * count
    points = len(problem.vias)
    found: list[PathVia] = []
    for k, via in enumerate(problem.vias):
        if lap > 0 and k == 0:
            continue
        u = float(offset + int(laid.joints[k]))
        index = via.index
        if index is not None and problem.laps > 1:
            index += lap * (points - 1)
        at = tuple(via.at.tolist())
        found.append(PathVia(via.name, at, "user", u, via.dwell or 0.0, index))
        if k < points - 1:
            found += [
                PathVia(
                    "detour", tuple(laid.spans[joint, 0].tolist()), "detour", offset + float(joint)
                )
                for joint in laid.detours[k].tolist()
                if joint < count
            ]
    return found


def _moved(via: PathVia, by: int) -> PathVia:
    return PathVia(via.name, via.at, via.kind, via.u + by, via.dwell, via.index)


Prove = Callable[[Floats], Certificate]
"""From the spans of a curve (m, 4, 3) [m] to what is proven of its clearance."""


def whole_proof(problem: SpatialProblem, path: Path, airborne: tuple[float, float]) -> Certificate:
    """What is proven of the whole path; on upright legs the ground doesn't count.

    Args:
        problem: Whose path it is.
        path: It.
        airborne: From where to where it flies [m].
    """
    proofs = part_proofs(problem, path, airborne, partial(proven, problem))
    return min(proofs.values(), key=lambda proof: proof.clearance)


def part_proofs(
    problem: SpatialProblem, path: Path, airborne: tuple[float, float], prove: Prove
) -> dict[str, Certificate]:
    """What is proven of each part of the path, by what the part is called.

    Args:
        problem: Whose path it is.
        path: It.
        airborne: From where to where it flies [m].
        prove: Of that part; what is known already of such a curve isn't proven again.
    """
    proofs = {FLIGHT: _proof(path, *airborne, prove)}
    upright = partial(proven_upright, problem)
    if problem.takeoff is not None:
        proofs[CLIMB] = _proof(path, 0.0, airborne[0], upright)
    if problem.landing is not None:
        proofs[DESCENT] = _proof(path, airborne[1], path.length, upright)
    return proofs


def proven_upright(problem: SpatialProblem, spans: Floats) -> Certificate:
    """What is proven of an upright leg's clearance, (m, 4, 3) [m]: the ground doesn't count."""
    world = without_ground(problem.world)
    return certify(PiecewiseCubic(spans), world, problem.clearance, radius=problem.radius)


def _proof(path: Path, first: float, last: float, prove: Prove) -> Certificate:
    """The proof of a part of the path, told in the whole one's parameters."""
    u0, u1 = np.asarray(path.parameter([first, last])).tolist()
    proof = prove(part_of_path(path, u0, u1).spans)
    return replace(
        proof,
        tightest_u=proof.tightest_u + u0,
        tightest_distance=proof.tightest_distance + first,
    )
