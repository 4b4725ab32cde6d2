"""From a course that may be blocked to a spline that is clear."""

from __future__ import annotations

from viaspline.planning.alternatives.fit import CLEAR, tighten, too_close, untied
from viaspline.planning.alternatives.lead_round import Passed, Task
from viaspline.planning.alternatives.record import Account
from viaspline.planning.problem.requirements import Brief
from viaspline.planning.problem.spline_path import Laid
from viaspline.planning.problem.via_sequence import Course, lay
from viaspline.planning.routing.route_refusals import explain_tight_leg, refuse_blocked_vias
from viaspline.world.world import World

ROUNDS = 60  # every round lowers slack, of spans that loop or of legs that are too close


def lay_clear(course: Course, world: World, brief: Brief) -> tuple[Laid, Account]:
    """Lay the spline of a course, and lead every blocked leg round what stands in its way.

    The other legs are left alone.

    Returns:
        The curve, and the account of the groups that were met.

    Raises:
        NoPathError: When a via point has no room, or there is no way between two of them.
    """
    refuse_blocked_vias(course, world, brief)
    task: Task | None = None
    passed: dict[int, Passed] = {}
    for _ in range(ROUNDS):
        spans = lay(course)
        loose = untied(course, spans)
        if loose is not course:
            course = loose
            continue
        close = too_close(world, spans, brief.required)
        if (close == CLEAR).all():
            laid = Laid.through(course, spans, course.first_spans(), _detours(course))
            return laid, Account(laid, world, brief, passed)
        if task is None:
            task = Task.of(course, world, brief)
        first = course.first_spans()
        for leg in range(len(course.legs)):
            hit = close[first[leg] : first[leg + 1]]
            hit = hit[hit != CLEAR]
            if not hit.size:
                continue
            if leg in passed:  # a neighbour that was led round has turned its tangents
                tightened = tighten(course, leg, world, brief.required)
                if tightened is not None:
                    course = tightened.course
                    continue
            passed[leg] = task.lead_round(course, leg, hit[hit >= 0].tolist())
            course = passed[leg].fitted.course
    raise explain_tight_leg(course, leg, world, brief)


def _detours(course: Course) -> list[int]:
    """The spans that begin at the detour via points of a course."""
    first = course.first_spans().tolist()
    return [
        u + course.pieces * j
        for u, leg in zip(first, course.legs, strict=False)
        for j in range(1, len(leg.slack))
    ]
