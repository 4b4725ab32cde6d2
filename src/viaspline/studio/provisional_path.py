"""The path of a body with a drive while somebody drags: soon, of a disc, not yet driven.

A plan of such a mission searches for the body with all its corners, and is driven in trials until
it keeps enough. What is laid here does neither. It is a sketch of where the path will run, nothing
of it is proven, and whoever shows it says so.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from viaspline.errors import ViasplineError
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import is_driven
from viaspline.mission.strip import has_line
from viaspline.planning.methods.ordered import SPLINE_METHODS, PathMethod
from viaspline.planning.methods.spline_as_is import SplineAsItIs
from viaspline.planning.methods.turns_on_shortest import TurnsOnShortest
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.whole_plan import in_order

MOST_WORK_S = 0.04
"""What each attempt may cost [s of the reference machine]."""

TURNS: tuple[PathMethod, ...] = (SplineAsItIs(), TurnsOnShortest())


@dataclass(frozen=True)
class ProvisionalPath:
    """Where a path will about run.

    Attributes:
        spans: Its Bézier control polygons, shape (m, 4, 2) [m].
        left_out: What is yet to be done about it, in words.
    """

    spans: Floats
    left_out: tuple[str, ...]


def provisional_path(mission: Mission, tracking_error: float = 0.0) -> ProvisionalPath | None:
    """A path for the widest disc in the body, with the robot's turning circle if it is soon found.

    Args:
        mission: In the plane.
        tracking_error: How far beside its path the robot got in the trials of a plan before [m].

    Returns:
        None where none is found soon: of a corridor's line, or where the way is narrow.

    Example:
        >>> cart = {"footprint": [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]],
        ...         "drive": {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 30}}}
        >>> mission = Mission.model_validate({
        ...     "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
        ...     "route": {"start": [0, 0], "goal": [50, 0]}, "robot": cart,
        ... })
        >>> found = provisional_path(mission)
        >>> found.left_out
        ('it is not yet driven', 'it is of the widest disc in the body')
        >>> found.spans[0, 0].tolist(), found.spans[-1, 3].tolist()
        ([0.0, 0.0], [50.0, 0.0])
    """
    if has_line(mission.route):
        return None
    disc = _disc(mission.robot)
    for robot, methods, error in (
        (disc, TURNS, tracking_error),
        (_free(disc), SPLINE_METHODS, 0.0),
    ):
        try:
            spans = _spans(_simple(mission, robot), methods, error)
        except ViasplineError:
            continue  # the plan will say why there is none, if there is none
        return ProvisionalPath(spans, tuple(_left_out(mission, robot)))
    return None


def _left_out(mission: Mission, laid_for: RobotSpec) -> list[str]:
    said = []
    if is_driven(mission.robot):
        said.append("it is not yet driven")
    if mission.robot.footprint is not None:
        said.append("it is of the widest disc in the body")
    if laid_for.turn_radius != mission.robot.turn_radius:
        said.append("its turning circle is not kept")
    if mission.world.moving:
        said.append("what moves is not looked at")
    return said or ["it is not yet weighed"]


def _spans(mission: Mission, methods: tuple[PathMethod, ...], error: float) -> Floats:
    """The spans of a path, laid by the first of some methods that finds one."""
    served, world = in_order(mission)
    requirements = replace(Requirements.of(served, error), budget=WorkBudget(MOST_WORK_S))
    if requirements.is_cardinal:
        methods = SPLINE_METHODS  # the paper's curve has no turns beside it
    spline_path, _ = lay_path(via_sequence_of(served), world, requirements, methods)
    return spline_path.spans[:, :, :2]


def _simple(mission: Mission, robot: RobotSpec) -> Mission:
    """A mission for another robot, whose paths are chosen by their length: that is soon told."""
    route = mission.route.model_copy(update={"optimise": "length"})
    tension = None if mission.spline.tension == "auto" else mission.spline.tension
    spline = mission.spline.model_copy(update={"tension": tension})
    return mission.model_copy(update={"robot": robot, "route": route, "spline": spline})


def _disc(robot: RobotSpec) -> RobotSpec:
    more = {"prefer_clearance_m": 0.0}
    if robot.footprint is None:
        return robot.model_copy(update=more)
    return robot.model_copy(update={**more, "footprint": None, "radius_m": robot.inner_radius})


def _free(robot: RobotSpec) -> RobotSpec:
    """A robot that follows any curve."""
    return robot.model_copy(update={"drive": None, "min_turn_radius_m": None})
