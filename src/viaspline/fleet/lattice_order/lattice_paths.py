"""The paths of a dense fleet, and in which order its robots pass: both from a search on a lattice.

The lattice gives who is in which cell when. Cells are joined to lines as straight as the world and
the other robots allow, corners are rounded, and the steps are kept beside the path: they say who
passes first wherever two paths come near each other. Steps are not times: timing makes the laws.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.fleet.lattice_order.cell_lattice import CellLattice, lattice_over
from viaspline.fleet.lattice_order.lattice_motions import lattice_motions
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.fleet.lattice_order.rounded_path import rounded_lines
from viaspline.fleet.lattice_order.solve_lattice import WORK, LatticePlan, solve_lattice
from viaspline.handed_in import number_from
from viaspline.kernels.arrays import Floats, Steps
from viaspline.machine.machine_limits import limits_of
from viaspline.planner import Plan
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.trajectory.retime import retime
from viaspline.whole_plan import stations
from viaspline.world.world import World

CHORD_M = 0.25
"""Length of the chords that a path is taken for [m]."""
MOST_LATER = 3.0
"""Of the longest drive: who departs later than that does so after all others anyway."""
STANDING_SHARE = 0.1
"""Of the rounding of a corner, where a robot stands: others pass there meanwhile."""
SAME_M = 1e-6
"""Places that are no farther apart are one [m]."""


@dataclass(frozen=True)
class LatticeShape:
    """How near paths keep to the cells of a lattice.

    Attributes:
        rounds: In which they are made straighter.
        rounding: Of a cell, how far the rounding of a corner may be from it.
    """

    rounds: int
    rounding: float


SHAPES = (
    LatticeShape(3, 0.3), LatticeShape(3, 0.05), LatticeShape(0, 0.3), LatticeShape(0, 0.05)
)  # fmt: skip
"""The quickest first. In dense fleets straighter and rounder paths come near each other where the
lattice has no order for them: then the best of the others is taken."""


@dataclass(frozen=True, eq=False)
class PassingSteps:
    """At which step of the lattice's order a robot is where on its path.

    Attributes:
        distances: Along its path, not decreasing [m], (k,).
        steps: Not decreasing, (k,).
    """

    distances: Floats
    steps: Floats

    def at(self, distances: Floats) -> Floats:
        """The steps at which it is at such distances along its path [m], of any shape."""
        return np.interp(distances, self.distances, self.steps)


@dataclass(frozen=True, eq=False)
class LatticePaths:
    """Paths through a lattice, and the order in which they are driven.

    Attributes:
        plans: By name, each with the law that its robot would drive alone.
        steps: Who is where before whom, by name.
    """

    plans: dict[str, Plan]
    steps: dict[str, PassingSteps]


@dataclass(frozen=True, eq=False)
class LatticeOrder:
    """Who is in which cell of a lattice when: the order in which robots pass each other.

    Attributes:
        plans: As the robots would drive if they were alone, by name.
        lattice: Its cells.
        solved: Who is in which of them when.
        reach: How far each robot keeps others away on its part [m], (n,).
        kept: What the centre of each keeps of the world [m], (n,).
        soonest: The step at which each may set out, (n,).
    """

    plans: dict[str, Plan]
    lattice: CellLattice
    solved: LatticePlan
    reach: Floats
    kept: Floats
    soonest: Steps

    def paths(self, shape: LatticeShape) -> LatticePaths:
        """The paths that are driven in this order.

        Args:
            shape: How near they keep to the cells.
        """
        many, cell = list(self.plans.values()), self.lattice.cell
        world, lines = many[0].world, [_line(plan) for plan in many]
        motions = lattice_motions(
            self.solved, self.lattice, world, lines, self.reach, self.kept, self.soonest,
            shape.rounds,
        )  # fmt: skip
        laid: dict[str, Plan] = {}
        steps: dict[str, PassingSteps] = {}
        for robot, (name, plan) in enumerate(self.plans.items()):
            begin = float(motions.sets_out[robot])
            if begin >= 0.0:
                length = plan.path.length
                laid[name] = plan
                steps[name] = PassingSteps(
                    np.array([0.0, 0.0, length]), np.array([0.0, begin, begin + length / cell])
                )
                continue
            places, when = motions.vertices(robot)
            laid[name], steps[name] = _laid(plan, places, when, world, shape.rounding * cell)
        return LatticePaths(laid, steps)


def lattice_paths(
    plans: Mapping[str, Plan],
    separation: float,
    work: int = WORK,
    leaving: Collection[str] = (),
    shape: LatticeShape = SHAPES[0],
) -> LatticePaths | NoLatticeOrder:
    """Lay the paths of robots anew, so that all can pass each other in an order that is known.

    It takes robots that go from a start to a goal, with nothing on the way, and that can stop and
    turn anywhere; their starts and goals have to lie on a square lattice with room for one robot in
    each cell, a thousandth or so beside it.

    Args:
        plans: As the robots would drive if they were alone.
        separation: Free space between any two bodies [m].
        work: States and choices of each search on the lattice, at most.
        leaving: The robots that leave the world when they have arrived.
        shape: How near they keep to its cells.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> bounds = {"bounds": [-1, -1, 7, 7]}
        >>> go = lambda start, goal: plan(Mission.model_validate(
        ...     {"world": bounds, "route": {"start": start, "goal": goal},
        ...      "robot": {"radius_m": 0.4, "clearance_m": 0.1}}))
        >>> paths = lattice_paths({"a": go((0, 0), (6, 0)), "b": go((6, 0), (0, 0))}, 0.2)
        >>> [plan.certificate.holds for plan in paths.plans.values()]
        [True, True]
    """
    separation = number_from("separation", separation)
    if not plans:
        return LatticePaths({}, {})
    order = lattice_order(plans, separation, work, leaving)
    return order if isinstance(order, NoLatticeOrder) else order.paths(shape)


def lattice_order(
    plans: Mapping[str, Plan],
    separation: float,
    work: int = WORK,
    leaving: Collection[str] = (),
) -> LatticeOrder | NoLatticeOrder:
    """Search for an order in which robots can pass each other on a lattice.

    Args:
        plans: As for ``lattice_paths``, of one robot at least.
        separation: Free space between any two bodies [m].
        work: States and choices of each search on the lattice, at most.
        leaving: The robots that leave the world when they have arrived.
    """
    wrong = _unfit(plans)
    if wrong is not None:
        return wrong
    many = list(plans.values())
    starts, goals = (np.array([plan.path.stops[k][0].at for plan in many]) for k in (0, -1))
    reach = np.array(
        [one.mission.robot.outer_radius + one.tracking_error + 0.5 * separation for one in many]
    )
    kept = np.array([Requirements.of(one.mission, one.tracking_error).around for one in many])
    apart = 2.0 * float(reach.max())
    lattice = lattice_over(many[0].world, starts, goals, apart, float(kept.max()))
    if isinstance(lattice, NoLatticeOrder):
        return lattice
    soonest = _departures(many, lattice.cell)
    leaves = np.array([name in leaving for name in plans], np.bool_)
    solved = solve_lattice(
        lattice.neighbours, lattice.starts, lattice.goals, departs=soonest, leaves=leaves, work=work
    )
    if isinstance(solved, NoLatticeOrder):
        return solved
    return LatticeOrder(dict(plans), lattice, solved, reach, kept, soonest)


def _departures(plans: Sequence[Plan], cell: float) -> Steps:
    """The step of the lattice at which each robot may set out, (n,).

    The first one sets out in the first step. Who comes long after all others have arrived comes
    after a round number of steps.
    """
    departs = np.array([plan.mission.route.depart_s for plan in plans])
    durations = np.array([plan.trajectory.duration for plan in plans])
    fastest = max(limits_of(plan.mission.robot).max_speed for plan in plans)
    later = np.minimum(departs - departs.min(), MOST_LATER * durations.max(initial=0.0))
    steps: Steps = np.floor(later * fastest / cell).astype(np.int32)
    return steps


def _line(plan: Plan) -> Floats:
    """Places along a path, near enough to each other to see who meets whom [m], (k, 2)."""
    count = max(math.ceil(plan.path.length / CHORD_M), 1)
    distances = np.linspace(0.0, plan.path.length, count + 1)
    return np.ascontiguousarray(plan.path.at_distance(distances))


def _unfit(plans: Mapping[str, Plan]) -> NoLatticeOrder | None:
    """Why robots can't be led over a lattice, if they can't."""
    world = next(iter(plans.values())).world
    for name, plan in plans.items():
        route = plan.mission.route
        if plan.path.dimension != 2 or plan.path.closed or route.closed or route.laps != 1:
            reason = f"'{name}' goes on a round, or in space"
        elif len(plan.path.stops) != 2:
            reason = f"'{name}' has via points"
        elif plan.mission.robot.turn_radius is not None or len(plan.mission.world.moving) > 0:
            reason = f"'{name}' can't stop and turn wherever it has to"
        elif any(
            getattr(end, "heading_deg", None) is not None for end in (route.start, route.goal)
        ):
            reason = f"'{name}' is to start or to arrive with a heading"
        elif plan.world.sided.size:
            reason = f"'{name}' is to pass something on one side"
        elif plan.world is not world and plan.world.obstacles != world.obstacles:
            reason = f"'{name}' has a map of its own"
        else:
            continue
        return NoLatticeOrder("gave up", reason, "leave it out")
    return None


def _laid(
    plan: Plan, places: Floats, when: Floats, world: World, farthest: float
) -> tuple[Plan, PassingSteps]:
    """The plan along straight lines, and when it is at their corners."""
    moves = np.hypot(*np.diff(places, axis=0).T) > SAME_M
    if not moves.any():
        return plan, PassingSteps(np.array([0.0, plan.path.length]), when[[0, -1]])
    corner = np.concatenate([[0], np.cumsum(moves)])  # places that are one have one corner
    own = np.concatenate([[True], moves])
    limits = limits_of(plan.mission.robot)
    across = limits.max_lateral_accel
    widest = limits.max_speed**2 / across if across else farthest
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    stands = np.bincount(corner)[1:-1] > 1
    near = np.where(stands, STANDING_SHARE * farthest, farthest)
    lines = rounded_lines(places[own], world, requirements.around, widest, near)
    begin, end = plan.path.stops[0][0], plan.path.stops[-1][0]
    vias = (replace(begin, u=0.0), replace(end, u=float(len(lines.spans))))
    path = Path(lines.spans, vias)
    robot = plan.mission.robot
    law = retime(
        path, limits, stations(path, robot), zones=plan.mission.world.speed_zones,
        start_time=plan.trajectory.start_time,
    )  # fmt: skip
    certificate = proven(path, world, requirements)
    steps = PassingSteps(np.asarray(path.distance(lines.middles))[corner], when)
    return replace(plan, path=path, certificate=certificate, account=None, trajectory=law), steps
