"""What a method of planning comes to: something found, a proof that there is nothing, or neither.

A method takes a problem and looks for one thing: a taut path between two places, or a curve that a
robot can drive. Methods stand in ordered tuples, and are asked one after the other. What is found
and settled ends the search, and so does a refusal: it is a proof, whatever method gives it. Who
gives up has proven nothing and leaves the problem to the next; when nobody is left, the search as
a whole gave up, having tried all that they tried.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Generic, Protocol, TypeAlias, TypeVar

from viaspline.errors import PlanningError
from viaspline.planning.problem.work_budget import SpentBudgetError

Value = TypeVar("Value", covariant=True)
Asked = TypeVar("Asked", contravariant=True)


@dataclass(frozen=True)
class Found(Generic[Value]):
    """What was looked for.

    Attributes:
        value: The thing itself.
        cost: What it costs, in what the problem asks to have little of [m or s].
        is_settled: Whether no other method need be asked. Where it is not, a better one may be
            found by one of them.
        rivals: Others that were found on the way, each with what it costs, the cheapest first.
    """

    value: Value
    cost: float
    is_settled: bool = True
    rivals: tuple[tuple[float, Value], ...] = ()


@dataclass(frozen=True)
class Refusal:
    """A proof that there is none: no method need look any further.

    Attributes:
        reason: Why, in words.
        via: Index of the via point that can't be served, where that is known.
        error: All that is to be said of it, where the method knows what would allow one.
    """

    reason: str
    via: int | None = None
    error: PlanningError | None = field(default=None, kw_only=True)
    value: ClassVar[None] = None


@dataclass(frozen=True)
class GaveUp:
    """Nothing was found, and it isn't known whether there is something.

    Attributes:
        tried: What was tried, each in words.
        would_help: What would let more be tried, in words; empty where nothing is known to.
        via: Index of the via point that wasn't reached, where that is known.
        reason: How the search ended, in words.
    """

    tried: tuple[str, ...]
    would_help: str = ""
    via: int | None = None
    reason: str = "the search was given up before it had seen everything"
    value: ClassVar[None] = None


Outcome: TypeAlias = Found[Value] | Refusal | GaveUp


class Method(Protocol[Asked, Value]):
    """One way of solving a kind of problem.

    Its budgets are its attributes, so that a method with another budget is another value.
    """

    def lay(self, problem: Asked, bound: float = math.inf) -> Outcome[Value]:
        """Look for what the problem asks for.

        Args:
            problem: What is asked.
            bound: Only what costs less is of use [m or s].
        """
        ...


def first_settled(
    methods: Sequence[Method[Asked, Value]], problem: Asked, bound: float = math.inf
) -> Outcome[Value]:
    """Ask methods one after the other, until one of them settles it.

    Args:
        methods: In the order in which they are asked.
        problem: What is asked.
        bound: Only what costs less is of use [m or s].

    Returns:
        The cheapest of what was found; else the refusal that ended the search; else that all of
        them gave up, and what they tried.

    Raises:
        SpentBudgetError: When what may be spent on the problem was spent before anything was found.

    Example:
        >>> class Guess:
        ...     def lay(self, problem: int, bound: float = math.inf) -> Outcome[int]:
        ...         return Found(problem // 2, 1.0) if problem % 2 == 0 else GaveUp(("halves",))
        >>> first_settled([Guess()], 4)
        Found(value=2, cost=1.0, is_settled=True, rivals=())
        >>> first_settled([Guess(), Guess()], 5).tried
        ('halves', 'halves')
    """
    best: Found[Value] | None = None
    tried: list[str] = []
    last = GaveUp(())
    for method in methods:
        try:
            outcome = method.lay(problem, bound if best is None else best.cost)
        except SpentBudgetError:
            if best is None:
                raise
            break
        if isinstance(outcome, GaveUp):
            tried += outcome.tried
            last = outcome
        elif isinstance(outcome, Refusal):
            return outcome if best is None else best
        else:
            if best is None or outcome.cost < best.cost:
                best = outcome
            if outcome.is_settled:
                break
    if best is not None:
        return best
    return GaveUp(tuple(tried), last.would_help, last.via, last.reason)
