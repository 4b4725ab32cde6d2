"""From a course that may be blocked to a path that is proven clear."""

from __future__ import annotations

from dataclasses import replace

from viaspline.curve.certificate import certify
from viaspline.curve.path import Path, PathVia, ViaKind
from viaspline.detour.account import Account
from viaspline.detour.blocked import explain_tight_leg, refuse_blocked_vias
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course, lay
from viaspline.detour.detoured import Detoured
from viaspline.detour.fit import CLEAR, tighten, too_close
from viaspline.detour.passing import Passed, Task
from viaspline.detour.route import Floats
from viaspline.world.world import World

ROUNDS = 40  # every round lowers the slack of the legs that are still too close


def clear_course(course: Course, world: World, brief: Brief) -> tuple[Course, Floats, Account]:
    """Lead every blocked leg round what stands in its way; leave the others alone.

    Returns:
        (course, spans (m, 4, d), account of the groups that were met).

    Raises:
        NoPathError: When a via point has no room, or there is no way between two of them.
    """
    refuse_blocked_vias(course, world, brief)
    task: Task | None = None
    passed: dict[int, Passed] = {}
    for _ in range(ROUNDS):
        spans = lay(course)
        close = too_close(world, spans, brief.required)
        if (close == CLEAR).all():
            return course, spans, Account(course, spans, world, brief, passed)
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


def find_path(course: Course, world: World, brief: Brief) -> Detoured:
    """A proven path along a course.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    cleared, spans, account = clear_course(course, world, brief)
    path = Path(spans, path_vias(cleared))
    certificate = certify(path, world, brief.kept, radius=brief.radius)
    return Detoured(path, certificate, account)


def path_vias(course: Course, first_span: int = 0) -> tuple[PathVia, ...]:
    """The via points of a course as they lie on its spline, from span ``first_span`` on."""
    vias: list[PathVia] = []
    u = first_span
    for k, leg in enumerate(course.legs):
        vias.append(_on_path(course, k, u))
        vias += [
            PathVia("detour", tuple(point.tolist()), "detour", float(u + course.pieces * j))
            for j, point in enumerate(leg.points, start=1)
        ]
        u += course.pieces * len(leg.slack)
    if course.closed:
        vias.append(replace(_on_path(course, 0, u), index=len(course.vias)))
    else:
        vias.append(_on_path(course, len(course.vias) - 1, u))
    return tuple(vias)


def _on_path(course: Course, k: int, u: int) -> PathVia:
    via = course.vias[k]
    kind: ViaKind = "detour" if via.index is None else "user"
    return PathVia(via.name, tuple(via.at.tolist()), kind, float(u), via.dwell, via.index)
