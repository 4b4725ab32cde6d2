"""From a course that may be blocked to a path that is proven clear."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import certify
from viaspline.curve.path import Path, PathVia, ViaKind
from viaspline.detour.blocked import explain_tight_leg, refuse_blocked_vias
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course, lay
from viaspline.detour.detoured import Detoured
from viaspline.detour.fit import CLEAR, tighten, too_close
from viaspline.detour.ledger import LedgerEntry
from viaspline.detour.measure import measure
from viaspline.detour.route import Floats
from viaspline.detour.sides import pass_groups
from viaspline.kernels.groups import group_labels
from viaspline.world.world import World

ROUNDS = 40  # every round lowers the slack of the legs that are still too close


def clear_course(
    course: Course, world: World, brief: Brief
) -> tuple[Course, Floats, tuple[LedgerEntry, ...]]:
    """Lead every blocked leg round what stands in its way; leave the others alone.

    Returns:
        (course, spans (m, 4, d), ledger).

    Raises:
        NoPathError: When a via point has no room, or there is no way between two of them.
    """
    refuse_blocked_vias(course, world, brief)
    groups: NDArray[np.int64] | None = None
    passed: dict[int, tuple[LedgerEntry, ...]] = {}
    for _ in range(ROUNDS):
        spans = lay(course)
        close = too_close(world, spans, brief.required)
        if (close == CLEAR).all():
            return course, spans, _ledger(course, spans, passed, world, brief)
        if groups is None:
            groups = group_labels(world.packed, 2 * brief.required)
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
            result = pass_groups(course, leg, world, brief, hit[hit >= 0].tolist(), groups)
            course = result.fitted.course
            passed[leg] = result.entries
    raise explain_tight_leg(course, leg, world, brief)


def _ledger(
    course: Course,
    spans: Floats,
    passed: dict[int, tuple[LedgerEntry, ...]],
    world: World,
    brief: Brief,
) -> tuple[LedgerEntry, ...]:
    """All entries, with the chosen curves as they lie in the end.

    A leg that was led round after its neighbour has turned the tangents at the via point between
    them; what was not chosen stays as it was weighed.
    """
    first = course.first_spans()
    entries: list[LedgerEntry] = []
    for leg in sorted(passed):
        laid = spans[first[leg] : first[leg + 1]]
        chosen = passed[leg][0].chosen if passed[leg] else None  # all entries of a leg share it
        if chosen is None or np.array_equal(chosen.spans, laid):
            entries += passed[leg]
            continue
        cost = asdict(measure(laid, world, brief))  # fields of a candidate as well
        points = course.legs[leg].points
        entries += [_as_laid(entry, spans=laid, vias=points, **cost) for entry in passed[leg]]
    return tuple(entries)


def _as_laid(entry: LedgerEntry, **curve: Any) -> LedgerEntry:
    """The entry with other values for the curve that was chosen."""
    candidates = (replace(c, **curve) if c.chosen else c for c in entry.candidates)
    return replace(entry, candidates=tuple(candidates))


def find_path(course: Course, world: World, brief: Brief) -> Detoured:
    """A proven path along a course.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    cleared, spans, ledger = clear_course(course, world, brief)
    path = Path(spans, path_vias(cleared))
    certificate = certify(path, world, brief.clearance, radius=brief.radius)
    return Detoured(path, certificate, ledger)


def path_vias(course: Course, first_span: int = 0) -> tuple[PathVia, ...]:
    """The via points of a course as they lie on its spline, from span ``first_span`` on."""
    vias: list[PathVia] = []
    u = first_span
    for k, leg in enumerate(course.legs):
        vias.append(_on_path(course, k, u))
        vias += [
            PathVia("detour", tuple(point.tolist()), "detour", float(u + j))
            for j, point in enumerate(leg.points, start=1)
        ]
        u += len(leg.slack)
    if course.closed:
        vias.append(replace(_on_path(course, 0, u), index=len(course.vias)))
    else:
        vias.append(_on_path(course, len(course.vias) - 1, u))
    return tuple(vias)


def _on_path(course: Course, k: int, u: int) -> PathVia:
    via = course.vias[k]
    kind: ViaKind = "detour" if via.index is None else "user"
    return PathVia(via.name, tuple(via.at.tolist()), kind, float(u), via.dwell, via.index)
