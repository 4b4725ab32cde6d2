"""What every path has to keep, whoever asks for it.

Tested through ``planning/test_plan_drive``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from functools import cached_property

from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec, TurnOnSpot
from viaspline.mission.route_spec import Detours
from viaspline.mission.spline_spec import SplineSpec, Tangents
from viaspline.mission.spot_turning import SpotTurning, foreseen_turning
from viaspline.planning.problem.least_width import least_width
from viaspline.planning.problem.objective import Objective
from viaspline.planning.problem.parts_found import PartsFound
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.problem.shared_searches import SharedSearches
from viaspline.planning.problem.work_budget import Progress, Value, WorkBudget
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_in_lines import told_in_lines

LEAST_KEPT_M = 1e-5  # even by a point without clearance, so that touching is not crossing


@told_in_lines
@dataclass(frozen=True, kw_only=True, eq=False)
class Requirements(ComparedByValue):
    """The robot's needs and the curve's shape.

    Attributes:
        radius: The robot's body [m].
        clearance: Free space kept between the body and every obstacle [m].
        preferred: Free space beyond that, kept where it costs little time [m].
        spline: Tension and knots.
        tangents: Which ones.
        goal_heading_deg: Heading with which the path arrives at the goal [deg]; None if it is free.
        footprint: The body if it is a polygon: its corners, x forward and y left [m]; ``radius``
            is that of the largest disc in it then.
        tracking_error: How far beside its path the robot may get [m]; kept in addition.
        turn_radius: The radius of the tightest circle that the robot can drive [m]; None if it
            has no limit.
        turns_on_spot: Where it may stand and turn.
        turning: How it does.
        objective: By what paths are chosen.
        detours: Whether they keep to the line between via points; None: where that is long beside
            what stands in it.
        budget: What may be spent on looking for a path; None: as much as it takes.
        shared: Searches that other plans of the mission have in common with this one, if any.
        poses: What all searches among poses may spend together; None: each as much as usual.
        parts: What parts have come to of the path that is laid with these; None: they aren't kept.
            Other requirements that are made of these don't have them.
    """

    radius: float
    clearance: float
    preferred: float = 0.0
    spline: SplineSpec = field(default_factory=SplineSpec)
    tangents: Tangents = "cardinal"
    goal_heading_deg: float | None = None
    footprint: tuple[tuple[float, float], ...] | None = None
    tracking_error: float = 0.0
    turn_radius: float | None = None
    turns_on_spot: TurnOnSpot = "stations"
    turning: SpotTurning = field(default_factory=SpotTurning)
    objective: Objective = field(default_factory=lambda: Objective("time", Pace.of(RobotSpec())))
    detours: Detours | None = None
    budget: WorkBudget | None = None
    shared: SharedSearches | None = field(default=None, compare=False, repr=False)
    poses: WorkBudget | None = field(default=None, compare=False, repr=False)
    parts: PartsFound | None = field(default=None, init=False, compare=False, repr=False)

    def spend(self, cost: float) -> None:
        """Take what the next step of a search costs off its budget [s of the reference machine].

        Raises:
            SpentBudgetError: When less is left.
        """
        if self.budget is not None:
            self.budget.spend(cost)

    @property
    def spent(self) -> float:
        """What of the budget is spent [s of the reference machine]; nothing without one."""
        return 0.0 if self.budget is None else self.budget.spent

    def once(self, asked: Hashable, part: Callable[[], Value]) -> Value:
        """What a part of a search comes to, which later steps of the search find done.

        Args:
            asked: All that it depends on besides these requirements.
            part: Does it.
        """
        if self.budget is None:
            return part()
        return self.budget.once((self.unbudgeted, asked), part)

    def recalled(self, asked: Hashable, part: Callable[[], Value]) -> Value:
        """What a small part comes to: without a budget as well it is kept while a path is laid.

        Args:
            asked: All that it depends on besides these requirements.
            part: Does it.
        """
        if self.budget is None and self.parts is not None:
            return self.parts.once(asked, part)
        return self.once(asked, part)

    def keeping_parts(self) -> Requirements:
        """These for one path that is laid: what small parts of it come to is kept.

        A budget keeps what its parts come to by itself.
        """
        if self.budget is not None:
            return self
        kept = replace(self)
        object.__setattr__(kept, "parts", PartsFound())
        return kept

    def taken_up(self, asked: Hashable, begin: Callable[[], Progress]) -> Progress:
        """A part of a search that is stopped and goes on; see ``WorkBudget``.

        Args:
            asked: All that it depends on besides these requirements.
            begin: Begins it.
        """
        if self.budget is None:
            return begin()
        return self.budget.taken_up((self.unbudgeted, asked), begin)

    def spend_on_part(self, cost: float) -> None:
        """Take off what a step costs of a part that is taken up again; see ``WorkBudget``."""
        if self.budget is not None:
            self.budget.spend_on_part(cost)

    @cached_property
    def unbudgeted(self) -> Requirements:
        """These for as long as it takes: parts of searches are kept by them."""
        return self if self.budget is None else replace(self, budget=None)

    @property
    def without_tension(self) -> Requirements:
        """These of what has none: lines and turns, and ways among poses."""
        return replace(self.unbudgeted, spline=SplineSpec())

    def within(self, budget: WorkBudget) -> Requirements:
        """These with what may be spent.

        Parts of searches are kept by the same ``unbudgeted`` in every step, and not by another one
        that has to be compared with it number by number.
        """
        within = replace(self, budget=budget)
        vars(within)["unbudgeted"] = self.unbudgeted
        return within

    @property
    def is_free_disc(self) -> bool:
        """Whether a disc drives that can follow any curve."""
        return self.turn_radius is None and self.footprint is None

    @property
    def turns_at_rest(self) -> bool:
        """Whether a robot that has stopped may go on in any direction."""
        return self.turn_radius is None or self.turns_on_spot != "never"

    @property
    def disc_radius(self) -> float:
        """The radius of a body that is a disc; 0 for a polygon, which no disc is added to [m]."""
        return self.radius if self.footprint is None else 0.0

    @property
    def outer_radius(self) -> float:
        """Distance of the body's farthest point from its reference point [m]."""
        return max((math.hypot(*corner) for corner in self.footprint or ()), default=self.radius)

    @property
    def is_cardinal(self) -> bool:
        """Whether the paper's own curve is asked for, of a robot that can follow it."""
        return self.is_free_disc and self.tangents == "cardinal"

    @property
    def may_be_local(self) -> bool:
        """Whether there may be legs that keep to the line between their via points."""
        if self.detours is None:
            return self.objective.is_time
        return self.detours == "local"

    @property
    def has_own_tension(self) -> bool:
        """Whether the mission says how taut the spline is to be."""
        return self.spline.has_own_tension

    @property
    def kept(self) -> float:
        """Free space that the body on the path keeps, so that the driven one has its clearance."""
        return self.clearance + self.tracking_error

    @property
    def least(self) -> float:
        """Free space that is kept, at least what is more than a touch [m]."""
        return max(self.kept, LEAST_KEPT_M)

    @cached_property
    def required(self) -> float:
        """Distance that the path itself keeps from every obstacle [m]."""
        return max(self.radius + self.kept, LEAST_KEPT_M)

    @cached_property
    def narrowest_gap(self) -> float:
        """The width that a gap has at least if the body gets through, however it moves [m].

        A convex body gets through no gap that is narrower than the body itself at its narrowest:
        G. Strang, "The width of a chair", American Mathematical Monthly 89, 1982.
        """
        across = 0.0 if self.footprint is None else least_width(self.footprint)
        return max(across + 2.0 * self.kept, 2.0 * self.required)

    @property
    def around(self) -> float:
        """Distance that the path keeps if the body is taken for the disc around it [m]."""
        return self.outer_radius + self.kept

    @property
    def within_around(self) -> tuple[float, ...]:
        """Less than that, for a body that is no disc: the least first, and halfway to it [m]."""
        if self.footprint is None:
            return ()
        return (self.required, 0.5 * (self.required + self.around))

    def reduced_to(self, distance: float) -> Requirements:
        """These where the path keeps another distance from every obstacle [m]."""
        return replace(self, clearance=distance - self.radius - self.tracking_error)

    @classmethod
    def of(cls, mission: Mission, tracking_error: float = 0.0) -> Requirements:
        """The requirements of a mission.

        Args:
            mission: What is asked for.
            tracking_error: How far beside its path the robot gets, if the mission doesn't say [m].
        """
        robot, goal = mission.robot, mission.route.goal
        return cls(
            radius=robot.inner_radius,
            clearance=robot.clearance_m,
            preferred=robot.prefer_clearance_m,
            spline=mission.spline,
            tangents=mission.tangents,
            goal_heading_deg=None if goal is None else goal.heading_deg,
            footprint=robot.footprint,
            tracking_error=(
                tracking_error if robot.tracking_error_m is None else robot.tracking_error_m
            ),
            turn_radius=robot.turn_radius,
            turns_on_spot=robot.turns_on_spot,
            turning=foreseen_turning(robot),
            objective=Objective(mission.route.optimise, Pace.of(robot, mission.world.speed_zones)),
            detours=mission.route.detours,
        )
