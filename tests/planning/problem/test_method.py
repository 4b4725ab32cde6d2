"""What the answers of several methods come to, when they are asked in order."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypothesis import given
from hypothesis import strategies as st

from viaspline.planning.problem.method import Found, GaveUp, Outcome, Refusal, first_settled

ANSWERS = st.one_of(
    st.builds(Found, st.just("path"), st.floats(1, 9), st.booleans()),
    st.builds(Refusal, st.just("shut in")),
    st.builds(GaveUp, st.tuples(st.sampled_from(["guides", "poses"]))),
)


@dataclass
class Says:
    """A method with a ready answer, that notes what it is asked."""

    answer: Outcome[str]
    bounds: list[float]

    def lay(self, problem: int, bound: float = math.inf) -> Outcome[str]:
        self.bounds.append(bound)
        return self.answer


def asked(*answers: Outcome[str]) -> tuple[Outcome[str], int, list[float]]:
    """The answer to all, how many were asked, and for what."""
    bounds: list[float] = []
    outcome = first_settled([Says(answer, bounds) for answer in answers], 0)
    return outcome, len(bounds), bounds


def test_what_is_settled_ends_the_search() -> None:
    first = Found("path", 5.0)
    assert asked(GaveUp(("guides",)), first, Found("shorter", 1.0)) == (first, 2, [math.inf] * 2)


def test_what_is_not_settled_is_held_against_what_comes_after() -> None:
    longer, shorter = Found("longer", 5.0, is_settled=False), Found("shorter", 4.0)
    assert asked(longer, shorter) == (shorter, 2, [math.inf, 5.0])
    assert asked(longer, Found("longest", 6.0)) == (longer, 2, [math.inf, 5.0])


def test_a_refusal_is_a_proof_and_ends_the_search() -> None:
    refusal = Refusal("shut in")
    assert asked(GaveUp(("guides",)), refusal, Found("path", 1.0))[:2] == (refusal, 2)


def test_who_gives_up_leaves_it_to_the_next_and_all_that_was_tried_is_told() -> None:
    outcome, count, _ = asked(GaveUp(("guides",)), GaveUp(("poses",), "more room", 3, "full"))
    assert count == 2
    assert outcome == GaveUp(("guides", "poses"), "more room", 3, "full")


def test_where_nobody_is_asked_nothing_is_proven() -> None:
    assert first_settled((), 0) == GaveUp(())


@given(st.lists(ANSWERS, max_size=6))
def test_there_is_no_refusal_without_a_proof_and_no_way_is_lost(answers: list[Outcome[str]]):
    outcome, count, _ = asked(*answers)
    heard = answers[:count]
    found = [answer.cost for answer in heard if isinstance(answer, Found)]
    if found:
        assert isinstance(outcome, Found)
        assert outcome.cost == min(found)
    elif any(isinstance(answer, Refusal) for answer in heard):
        assert isinstance(outcome, Refusal)
    else:
        assert isinstance(outcome, GaveUp)
        assert count == len(answers)
