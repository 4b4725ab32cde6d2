"""What is tried with a problem, and what is wrong with what came of it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely
from connectivity import MARGIN_M, Verdict, verdict
from path_room import CHORD_ERROR_M, ends_missed, least_room
from problems import Problem
from timing import clock

import viaspline as vs

PROOF_SLACK_M = 1e-6  # that the package allows itself
TOLERANCE_M = CHORD_ERROR_M + 2 * PROOF_SLACK_M
FATTER = (0.05, 0.2, 0.5, 0.8, 0.95, 0.999)  # robots, by what is required
LENGTH_TOLERANCE = 1e-4
WIDTH_TOLERANCE_M = 1e-3  # of the width that a refusal tells
LEAST_M = 5e-4  # radius of the least robot that the oracles tell ways for
GAP = re.compile(r"gap .* at \(\S+ \S+\) with (?:just )?(\d+\.\d+) m of room")
LARGEST_RADIUS = re.compile(r"the body's radius may be at most (\d+\.\d+) m")


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What came of one plan.

    Attributes:
        kind: Of the problem.
        truth: What the oracle says.
        result: ``planned``, ``refused``, ``gave up`` or ``error``.
        wrong: What is wrong with it; empty if nothing is.
        seconds: Of the planner [s].
        telling: Of finding the reason of a refusal [s].
        words: The error's, or the path's length.
    """

    kind: str
    truth: Verdict
    result: str
    wrong: str
    seconds: float
    telling: float = 0.0
    words: str = ""


def planned(mission: vs.Mission) -> vs.Plan | Exception:
    """A plan, or whatever was raised instead."""
    try:
        return vs.plan(mission)
    except Exception as error:  # whatever it is, it is counted
        return error


def result_of(found: vs.Plan | Exception) -> str:
    """What came of planning in a word."""
    if isinstance(found, vs.Plan):
        return "planned"
    if isinstance(found, vs.NoPathError):
        return "refused"
    return "gave up" if isinstance(found, vs.GaveUpError) else "error"


def plan_tried(problem: Problem) -> Outcome:
    """A problem planned, and held against the oracles."""
    mission = problem.mission()
    seconds, found = clock(lambda: planned(mission))
    truth, result = verdict(problem), result_of(found)
    outcome = partial(Outcome, kind=problem.kind, truth=truth, result=result, seconds=seconds)
    if isinstance(found, vs.Plan):
        wrong = wrong_path(found, problem, truth)
        return outcome(wrong=wrong, words=f"{found.path.length:.3f} m")
    if result == "refused":
        return outcome(wrong="wrong refusal" if truth == "open" else "")
    tried = "; ".join(found.tried) if isinstance(found, vs.GaveUpError) else repr(found)
    return outcome(wrong=result, words=tried)


def wrong_path(plan: vs.Plan, problem: Problem, truth: Verdict) -> str:
    """What is wrong with a path; empty if nothing is."""
    if truth == "closed":
        return "path where there is none"
    lacks = problem.required - least_room(plan.path.spans, problem)
    if lacks > TOLERANCE_M:
        return f"too near by {lacks:.2e} m"
    if not plan.certificate.holds or ends_missed(plan.path.spans, problem) > PROOF_SLACK_M:
        return "not certified, or beside its ends"
    return ""


def radii_tried(problem: Problem) -> Outcome:
    """A problem for ever fatter robots: none finds a way or a shorter one that a thinner lacks.

    It is the shortest path that is asked for: the soonest one may be longer where there is room.
    """
    shares = [(f, problem.for_robot(f * problem.required)) for f in (*FATTER, 1.0)]
    found = [(f, *clock(lambda p=p: planned(p.mission("length")))) for f, p in shares]
    lengths = [p.path.length if isinstance(p, vs.Plan) else np.inf for _, _, p in found]
    shortest = np.minimum.accumulate(lengths[::-1])[::-1]  # of this robot and all fatter ones
    wrong = [
        f"at {f:g} of the radius {result_of(p)}, a fatter one passes"
        if np.isinf(length)
        else f"at {f:g} of the radius longer by {length / least - 1:.2e} than a fatter one's"
        for (f, _, p), length, least in zip(found, lengths, shortest, strict=True)
        if np.isfinite(least) and length > least * (1.0 + LENGTH_TOLERANCE)
    ]
    seconds = max(seconds for _, seconds, _ in found)
    return Outcome(
        kind=problem.kind, truth="unknown", result=result_of(found[-1][2]),
        wrong="; ".join(wrong), seconds=seconds, words=", ".join(f"{x:.4f}" for x in lengths),
    )  # fmt: skip


def refusal_tried(problem: Problem) -> Outcome:
    """A refusal's reason held against the oracles, and its remedies followed."""
    mission = problem.mission()
    seconds, found = clock(lambda: planned(mission))
    if not isinstance(found, vs.NoPathError):
        return Outcome(
            kind=problem.kind, truth="unknown", result=result_of(found), wrong="", seconds=seconds
        )
    telling, words = clock(lambda: str(found))
    wrong = [*wrong_gap(found, problem), *wrong_remedies(found, problem)]
    return Outcome(
        kind=problem.kind, truth="unknown", result="refused", wrong="; ".join(wrong),
        seconds=seconds, telling=telling, words=words,
    )  # fmt: skip


def wrong_gap(error: vs.NoPathError, problem: Problem) -> list[str]:
    """What is wrong with the gap that a refusal names: its width, and whether it is the widest."""
    told = GAP.search(str(error))
    if told is None:
        is_open = "nothing leads from" not in str(error)
        if is_open or verdict(problem.for_robot(LEAST_M)) != "open":
            return []
        return [f"a robot of {LEAST_M:g} m gets through what is said to be shut off"]
    half = 0.5 * float(told[1])
    wrong, at = [], shapely.points([error.where[:2]])
    room = float(problem.solids.room(at, 3.0 * problem.required)[0])
    if abs(2.0 * room - 2.0 * half) > WIDTH_TOLERANCE_M:
        wrong.append(f"the gap told is {2 * half:.4f} m wide, the place has {2 * room:.4f} m")
    hair = MARGIN_M + 0.5 * WIDTH_TOLERANCE_M
    if half > hair and verdict(problem.for_robot(half - hair)) == "closed":
        wrong.append(f"no way is as wide as the {2 * half:.4f} m told")
    if half + hair < problem.required and verdict(problem.for_robot(half + hair)) == "open":
        wrong.append(f"a way is wider than the {2 * half:.4f} m told")
    return wrong


def wrong_remedies(error: vs.NoPathError, problem: Problem) -> list[str]:
    """Which of a refusal's remedies don't serve when they are followed."""
    remedies = [(change.key, change.value) for change in error.changes]
    radius = LARGEST_RADIUS.search(error.remedy)
    if radius is not None:
        remedies.append(("robot.radius_m", float(radius[1])))
    wrong = [] if remedies else ["no remedy that can be followed"]
    for key, value in remedies:
        asked = changed(problem.asked(), key, value)
        if key == "robot.radius_m":
            asked["robot"]["clearance_m"] = 0.0
        found = planned(vs.Mission.model_validate(asked))
        if not isinstance(found, vs.Plan):
            wrong.append(f"{key} = {value} followed: {result_of(found)}")
    return wrong


def changed(asked: dict, key: str, value: object) -> dict:
    """A mission with another value at a key such as ``route.via[2].at``."""
    *parents, last = [int(part) if part.isdigit() else part for part in re.findall(r"\w+", key)]
    node = asked
    for part in parents:
        node = node[part]
    node[last] = value
    return asked
