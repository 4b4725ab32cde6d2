"""What laying robots anew in space and time may spend in all, and what came of it by then.

The work is counted, as in `viaspline.planning.problem.work_budget`, so that the same fleet gets the
same plans everywhere. Every robot that is still to be laid has the same share of what is left;
what one doesn't need is there for the others. Nobody is laid twice among the same robots.

Tested through ``fleet/laying/test_relay``.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeAlias

from viaspline.errors import GeometryError, PlanningError
from viaspline.planner import Plan
from viaspline.planning.problem.work_budget import WorkBudget

LEAST_S = 0.25
"""With less than this nobody is laid [s of the reference machine]."""

Laid: TypeAlias = "Plan | PlanningError | GeometryError"


@dataclass(frozen=True, eq=False)
class LayingWork:
    """What may be spent, and what came of what was.

    Attributes:
        budget: What may be spent, and what was.
        laid: What came of each robot that was laid, by all that it depends on.
    """

    budget: WorkBudget
    laid: dict[Hashable, Laid] = field(default_factory=dict)

    @classmethod
    def of(cls, seconds: float) -> LayingWork:
        """So much work [s of the reference machine]."""
        return cls(WorkBudget(seconds))

    @property
    def is_spent(self) -> bool:
        """Whether too little is left to lay anybody."""
        return self.budget.left < LEAST_S

    @contextmanager
    def share(self, among: int) -> Iterator[LayingWork]:
        """What one of so many that are still to come may spend; it knows what was laid as well."""
        with self.budget.share(self.budget.left / among) as part:
            yield LayingWork(part, self.laid)

    def once(self, asked: Hashable, lay: Callable[[], Laid]) -> Laid:
        """What comes of laying a robot, or came of it before.

        Where there was too little to spend to know, it isn't kept: there may be more another time.

        Args:
            asked: All that it depends on.
            lay: Does it.
        """
        if asked in self.laid:
            return self.laid[asked]
        found = lay()
        if isinstance(found, Plan) or not self.is_spent:
            self.laid[asked] = found
        return found
