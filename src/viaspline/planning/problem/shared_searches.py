"""Searches that several plans of one mission have in common, done once.

Plans with one tension after the other search among the same poses: lines and turns have no tension.
A search that is found done takes off a budget what it took when it was done, so that every plan is
what it is alone.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar

from viaspline.errors import GaveUpError

Value = TypeVar("Value")


class Spendable(Protocol):
    """A budget.

    Attributes:
        limit: [s of the reference machine].
        spent: [s of the reference machine].
    """

    limit: float
    spent: float


@dataclass(frozen=True)
class _Done:
    """What a search came to.

    Attributes:
        value: What was found; nothing if it was stopped.
        stopped: By what it was stopped.
        spent: What was spent of every budget after it [s of the reference machine].
    """

    value: Any
    stopped: GaveUpError | None
    spent: tuple[float, ...]


@dataclass(eq=False)
class SharedSearches:
    """Searches, by all that they depend on.

    Attributes:
        done: Those that are over.

    Example:
        >>> from viaspline.planning.problem.work_budget import WorkBudget
        >>> shared, budget = SharedSearches(), WorkBudget(1.0)
        >>> def search() -> str:
        ...     budget.spend(0.25)
        ...     return "a way"
        >>> shared.once("poses", [budget], search), budget.spent
        ('a way', 0.25)
        >>> budget = WorkBudget(1.0)
        >>> shared.once("poses", [budget], search), budget.spent
        ('a way', 0.25)
    """

    done: dict[Hashable, _Done] = field(default_factory=dict, repr=False)

    def once(
        self, asked: Hashable, budgets: Sequence[Spendable], search: Callable[[], Value]
    ) -> Value:
        """What a search comes to, or came to when as much was left of its budgets.

        Args:
            asked: All that it depends on besides its budgets.
            budgets: What it may spend, each of them.
            search: Does it.

        Raises:
            GaveUpError: When it is stopped, or was.
        """
        key = (asked, tuple((budget.limit, budget.spent) for budget in budgets))
        if key not in self.done:
            value, stopped = None, None
            try:
                value = search()
            except GaveUpError as error:
                stopped = error
            self.done[key] = _Done(value, stopped, tuple(budget.spent for budget in budgets))
        done = self.done[key]
        for budget, spent in zip(budgets, done.spent, strict=True):
            budget.spent = spent
        if done.stopped is not None:
            raise done.stopped
        found: Value = done.value
        return found

    def forget(self) -> None:
        """No plan is to come: those that are there go on holding what they were laid with."""
        self.done.clear()
