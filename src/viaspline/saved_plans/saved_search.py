"""What a search did, as ``plan.json`` tells it: the ledger, and what else was weighed.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, TypeVar, get_args

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.kept_account import KeptAccount
from viaspline.planning.problem.ledger import Candidate, LedgerEntry, PassingSide
from viaspline.planning.problem.preferred_clearance import PreferredClearance, TriedClearance
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.spacetime.timed_drive import Passing, TimedCandidate
from viaspline.trajectory.yielding.waits import TrafficWait

_Told = TypeVar("_Told")


def saved_ledger(plan: PlanFile, dimension: int) -> tuple[LedgerEntry, ...]:
    """The ledger of a file. It is a record of what was tried: nothing in it is proven again.

    Args:
        plan: The file.
        dimension: Of the path's places.

    Raises:
        SavedPlanError: It holds none.
    """
    return _listed(plan, "ledger", lambda one: _entry(one, dimension))


def saved_account(plan: PlanFile, dimension: int) -> KeptAccount:
    """What the search for a path in the plane did.

    Args:
        plan: The file.
        dimension: Of the path's places.

    Raises:
        SavedPlanError: It holds no ledger, or something else than one.
    """
    weighed = None
    if "preferred_clearance" in plan.data:
        key = "preferred_clearance"
        weighed = PreferredClearance(
            plan.number(key, "asked_m"),
            plan.number(key, "required_duration_s"),
            plan.number(key, "most_duration_s"),
            _listed(plan, (key, "tried"), _tried),
        )
    return KeptAccount(saved_ledger(plan, dimension), weighed)


def saved_candidates(plan: PlanFile) -> tuple[TimedCandidate, ...]:
    """The paths that were timed among what moves.

    Raises:
        SavedPlanError: The file holds none.
    """
    return _listed(plan, ("among_moving", "candidates"), _timed)


def saved_waits(plan: PlanFile) -> tuple[TrafficWait, ...]:
    """Where the plan loses time to what moves.

    Raises:
        SavedPlanError: The file doesn't say.
    """
    return _listed(plan, ("trajectory", "waits"), _wait)


def _listed(
    plan: PlanFile, keys: str | tuple[str, ...], read: Callable[[Mapping[str, Any]], _Told]
) -> tuple[_Told, ...]:
    """What is read of each item of a list in a file."""
    keys = (keys,) if isinstance(keys, str) else keys
    listed = plan.part(*keys)
    try:
        return tuple(read(one) for one in listed)
    except (KeyError, TypeError, ValueError, OverflowError, AttributeError, IndexError):
        raise plan.wrong(f"{'.'.join(keys)} isn't what it has to be") from None


def _entry(one: Mapping[str, Any], dimension: int) -> LedgerEntry:
    before, after = map(_text, one["leg"])
    forced = None if one["forced"] is None else _one_of(PassingSide, one["forced"])
    candidates = tuple(_candidate(each, dimension) for each in one["candidates"])
    return LedgerEntry(tuple(map(_text, one["members"])), (before, after), candidates, forced)


def _candidate(one: Mapping[str, Any], dimension: int) -> Candidate:
    """A way past a group; where there is one, what isn't finite stands in the file as null."""
    impossible = _text_or_none(one["impossible"])
    length, duration, clearance, curvature = (
        None if impossible is not None else _number(one[key])
        for key in ("length_m", "duration_s", "clearance_m", "max_curvature_1pm")
    )
    return Candidate(
        side=_one_of(PassingSide, one["side"]),
        vias=_places(one["vias"], (-1, dimension)),
        spans=_places(one["spans"], (-1, 4, dimension)),
        length=length,
        duration=duration,
        clearance=clearance,
        max_curvature=curvature,
        chosen=_flag(one["chosen"]),
        impossible=impossible,
        passed_over=_text_or_none(one["passed_over"]),
    )


def _tried(one: Mapping[str, Any]) -> TriedClearance:
    duration = None if one["duration_s"] is None else _number(one["duration_s"])
    return TriedClearance(_number(one["clearance_m"]), duration, _flag(one["taken"]))


def _timed(one: Mapping[str, Any]) -> TimedCandidate:
    passings = tuple(
        Passing(
            _text(each["obstacle"]), _one_of(Side, each["side"]), _number(each["from_s"]),
            _number(each["until_s"]),
        )
        for each in one["passes"]
    )  # fmt: skip
    arrival = None if one["arrival_s"] is None else _number(one["arrival_s"])
    return TimedCandidate(
        passings, _number(one["length_m"]), _number(one["free_arrival_s"]), arrival,
        _text_or_none(one["reason"]), _flag(one["chosen"]), _flag(one["searched"]),
    )  # fmt: skip


def _wait(one: Mapping[str, Any]) -> TrafficWait:
    start, end, begins, lost, stood = (
        _number(one[key]) for key in ("from_m", "to_m", "at_s", "lost_s", "stood_s")
    )
    return TrafficWait(start, end, begins, lost, stood, _text(one["obstacle"]))


def _places(value: Any, shape: tuple[int, ...]) -> Floats:
    places = np.array(value, np.float64).reshape(shape)
    if not np.isfinite(places).all():
        raise ValueError
    return places


def _number(value: Any) -> float:
    """A number; infinite where nothing limits it, which JSON can't say."""
    if value is None:
        return math.inf
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError
    return float(value)


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise TypeError
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


def _text_or_none(value: Any) -> str | None:
    return None if value is None else _text(value)


def _one_of(words: Any, value: Any) -> Any:
    """A word that is among those of a ``Literal``."""
    if value not in get_args(words):
        raise ValueError
    return value
