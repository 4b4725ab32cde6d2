"""From a course that may be blocked to a spline that is clear."""

from __future__ import annotations

from viaspline.planning.alternatives.fit import CLEAR, tighten, too_close, untied
from viaspline.planning.alternatives.lead_round import DetourProblem, Passed
from viaspline.planning.alternatives.record import Account
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence, lay
from viaspline.planning.routing.route_refusals import explain_tight_leg, refuse_blocked_vias
from viaspline.world.world import World

ROUNDS = 60  # every round lowers slack, of spans that loop or of legs that are too close


def lay_clear(
    sequence: ViaSequence, world: World, requirements: Requirements
) -> tuple[SplinePath, Account]:
    """Lay the spline of a course, and lead every blocked leg round what stands in its way.

    The other legs are left alone.

    Returns:
        The curve, and the account of the groups that were met.

    Raises:
        NoPathError: When a via point has no room, or there is no way between two of them.
    """
    refuse_blocked_vias(sequence, world, requirements)
    task: DetourProblem | None = None
    passed: dict[int, Passed] = {}
    for _ in range(ROUNDS):
        spans = lay(sequence)
        loose = untied(sequence, spans)
        if loose is not sequence:
            sequence = loose
            continue
        close = too_close(world, spans, requirements.required)
        if (close == CLEAR).all():
            spline_path = SplinePath.through(
                sequence, spans, sequence.first_spans(), _detours(sequence)
            )
            return spline_path, Account(spline_path, world, requirements, passed)
        if task is None:
            task = DetourProblem.of(sequence, world, requirements)
        first = sequence.first_spans()
        for leg in range(len(sequence.legs)):
            hit = close[first[leg] : first[leg + 1]]
            hit = hit[hit != CLEAR]
            if not hit.size:
                continue
            if leg in passed:  # a neighbour that was led round has turned its tangents
                tightened = tighten(sequence, leg, world, requirements.required)
                if tightened is not None:
                    sequence = tightened.sequence
                    continue
            passed[leg] = task.lead_round(sequence, leg, hit[hit >= 0].tolist())
            sequence = passed[leg].fitted.sequence
    raise explain_tight_leg(sequence, leg, world, requirements)


def _detours(sequence: ViaSequence) -> list[int]:
    """The spans that begin at the detour via points of a course."""
    first = sequence.first_spans().tolist()
    return [
        u + sequence.pieces * j
        for u, leg in zip(first, sequence.legs, strict=False)
        for j in range(1, len(leg.slack))
    ]
