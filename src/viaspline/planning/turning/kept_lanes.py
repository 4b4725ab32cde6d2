"""Which legs keep to the lines between their via points, and the bends with which they do.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import LOCAL_LEG_S
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import LegBends, RowBends, bends_of_legs
from viaspline.planning.turning.lane import Lane
from viaspline.planning.turning.lane_stays import LegLane
from viaspline.planning.turning.lane_turns import LaneTurns
from viaspline.planning.turning.local_detours import LANE_REACHES, local_bends
from viaspline.planning.turning.turning_problem import TurningProblem
from viaspline.planning.turning.wide_turns import MAX_NARROWINGS

DEAR_LANE = 1.1  # driven time of a leg on its line over the shortest way's; nobody asked for that


@dataclass(frozen=True)
class KeptLanes:
    """The lanes of a problem that its paths keep to where they can.

    Attributes:
        problem: What is to be driven.
    """

    problem: TurningProblem

    @property
    def are_any(self) -> bool:
        """Whether there is a leg on its shortest way that is to keep to its line, or get to it."""
        return any(self._shortest_local)

    @property
    def lines(self) -> tuple[Lane | None, ...]:
        """The line that each leg keeps to on its shortest way, or gets to; None without one."""
        return tuple(
            None if bends is None else Lane.of(self.problem.sequence.whole_leg(leg))
            for leg, bends in enumerate(self._shortest_local)
        )

    def bends_along(self, taut_paths: Sequence[TautPath]) -> Iterator[RowBends]:
        """The bends of legs along taut paths, those first that keep most to the lines of vias."""
        short = tuple(LegBends.along(taut_path) for taut_path in taut_paths)
        stretched = []
        for reach in LANE_REACHES:
            local = self._local_legs(taut_paths, reach)
            if not any(local):
                break
            stretched.append(local)
            yield tuple(mine or its for mine, its in zip(local, short, strict=True))
        if stretched and len(short) > 1:
            choices = zip(*stretched, short, strict=True)
            yield tuple(self._first_that_fits(k, legs) for k, legs in enumerate(choices))
        yield short

    def _first_that_fits(self, leg: int, choices: Sequence[LegBends | None]) -> LegBends:
        """The first of some bends of a leg round which it can be laid by itself, else the last."""
        alone = self._alone(leg)
        *local, short = [bends for bends in choices if bends is not None]
        for bends in local:
            row = bends_of_legs(alone, [bends])
            if self.problem.turns_round(row, self.problem.sharpest) is not None:
                return bends
        return short

    def _alone(self, leg: int) -> ViaSequence:
        """A leg by itself, from rest to rest."""
        sequence = self.problem.sequence
        return replace(sequence, vias=sequence.ends(leg), legs=(sequence.legs[leg],), closed=False,
                       start_tangent=None, end_tangent=None, parts_of=())  # fmt: skip

    def _local_legs(
        self, taut_paths: Sequence[TautPath], reach: float
    ) -> tuple[LegBends | None, ...]:
        """The bends of every leg that keeps to its line, None where it takes the shortest way."""
        if not self.problem.requirements.may_be_local:
            return (None,) * len(taut_paths)
        if reach > LANE_REACHES[0]:
            return self._kept_to_lanes(taut_paths, reach)
        known = zip(self.problem.shortest_row.taut_paths, self._shortest_local, strict=True)
        turns = self._lane_turns(reach)
        return tuple(
            bends if taut_path is shortest else self._on_other_side(leg, taut_path, turns)
            for leg, (taut_path, (shortest, bends)) in enumerate(
                zip(taut_paths, known, strict=True)
            )
        )

    def _on_other_side(self, leg: int, taut_path: TautPath, turns: LaneTurns) -> LegBends | None:
        """The bends of a leg on another side: it keeps to its line if it does on its shortest way.

        Where that is dear there, it is left here as well if it is dear.
        """
        is_kept = self._shortest_local[leg] is not None
        lay = self._local if is_kept else self._worth_keeping
        return lay(leg, taut_path, turns)

    @cached_property
    def _shortest_local(self) -> tuple[LegBends | None, ...]:
        """Those of the legs of the shortest row; other rows differ from it in a leg or two."""
        taut_paths = self.problem.shortest_row.taut_paths
        if not self.problem.requirements.may_be_local:
            return (None,) * len(taut_paths)
        return self._kept_to_lanes(taut_paths, LANE_REACHES[0])

    def _kept_to_lanes(
        self, taut_paths: Sequence[TautPath], reach: float
    ) -> tuple[LegBends | None, ...]:
        turns = self._lane_turns(reach)
        return tuple(
            self._worth_keeping(leg, taut_path, turns) for leg, taut_path in enumerate(taut_paths)
        )

    def _worth_keeping(self, leg: int, taut_path: TautPath, turns: LaneTurns) -> LegBends | None:
        """The bends of a leg that keeps to its line; None where that is dear and not asked for."""
        kept, needs = self._local(leg, taut_path, turns), self.problem.requirements
        if kept is None or needs.detours == "local" or not needs.objective.is_time:
            return kept
        return None if self._is_dear(leg, kept, LegBends.along(taut_path)) else kept

    def _local(self, leg: int, taut_path: TautPath, turns: LaneTurns) -> LegBends | None:
        """The bends of a leg that keeps to its line as long as it can; see ``local_bends``."""
        needs = self.problem.requirements
        if needs.detours is None and taut_path.is_direct and not self.problem.sequence.parts_of:
            needs.spend(LOCAL_LEG_S)
            return None  # it is on its line all the way: there is nothing to go back from
        return local_bends(self._leg_lanes[leg], taut_path, turns)

    def _is_dear(self, leg: int, kept: LegBends, short: LegBends) -> bool:
        """Whether it takes much longer to keep to a leg's line than to take the shortest way."""
        alone = self._alone(leg)
        rows = (bends_of_legs(alone, [one]) for one in (kept, short))
        times = [self.problem.ideal_time(alone, row, MAX_NARROWINGS) for row in rows]
        return times[0] > DEAR_LANE * times[1] > 0.0

    def _lane_turns(self, reach: float) -> LaneTurns:
        needs, sharpest = self.problem.requirements, self.problem.sharpest
        widest = max(needs.objective.pace.widest_radius, self.problem.roomy, sharpest)
        return LaneTurns(sharpest, widest, needs.required, reach)

    @cached_property
    def _leg_lanes(self) -> tuple[LegLane, ...]:
        """The lines that legs may keep to."""
        return tuple(LegLane.of(leg) for leg in self.problem.legs)
