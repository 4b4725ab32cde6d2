"""Where a robot stops that may have to at any time: not in the way of what moves by the map.

Every law from all of which it stands before anything touches it ends at rest, for whatever may come
unseen. What moves as the map says is no threat to a robot that knows when it comes, but it runs
over one that was stopped in its way by something else. So of such laws it takes the first of these

* that goes on for a moment and ends where nothing on the map comes while it stands there,
* that goes on for as far as is proven, through the way of something, and ends where nothing comes,
* the one it has, which an earlier look has proven to its end, if it ends where nothing comes,
* from all places of which it stops where nothing comes for so long as to where it stops at once,

but one of the first three all the same if something comes later to its end than to where it
stops at once. The robot is at rest by then, and looks for a way out of there.

Tested through ``robot/yielding/test_charted_stops``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.curve.path import Path
from viaspline.trajectory.passive_premises import SAME_PLACE_M, PassivePremises
from viaspline.trajectory.passive_safety import at_rest_until, passive_law
from viaspline.trajectory.trajectory import Trajectory

LASTING_S = 1.0
"""A law goes on for so long if it may, and then stops; there is another look long before [s]."""

STAY_S = 4.0
"""For so long nothing on the map is to come where it stops for what may come: it may set off again
soon, and who asks for more stands where it is safe now until it isn't, and is frozen there [s]."""

SOONER_S = 1e-3
"""It is asked for so much less than is proven [s]: then a check finds it proven, too."""

LATER_S = 0.1
"""Something has to come so much later elsewhere for it to go on from where it can stop at once:
standing it looks for other paths out of the way [s]."""


@dataclass(frozen=True)
class StopAsked:
    """What a law has to keep from all places of which a robot stops in time.

    Attributes:
        path: What is driven.
        upper: What it would drive if nothing could come: in pieces of even acceleration.
        premises: What may come.
        keep: The body's radius and how far beside its path it may be [m].
        limits: Largest acceleration and deceleration along the path [m/s²].
        now: When it begins [s].
        meant_stay: How long it would stand where ``upper`` ends [s].
        proven: The law that it has, if it is on this path and an earlier look has proven it.
        settle: For so long after its law rests the robot may still move [s].
    """

    path: Path
    upper: Trajectory
    premises: PassivePremises
    keep: float
    limits: tuple[float, float]
    now: float
    meant_stay: float
    proven: Trajectory | None = None
    settle: float = 0.0


def certified_stop(asked: StopAsked) -> Trajectory | None:
    """A law from all places of which the robot stops in time, and out of the way if it can.

    Args:
        asked: What it has to keep.

    Returns:
        None: not even braking at once is proven by this look.
    """
    soon, is_proven = _law(asked, LASTING_S)
    if not is_proven:
        return None
    if not len(asked.premises.charted):
        return soon
    until = {"soon": left_alone_until(asked, soon)}
    if until["soon"] == math.inf:
        return soon
    far, _ = _law(asked, math.inf)
    others = {"far": far, **_kept(asked)}
    for name, law in others.items():
        until[name] = left_alone_until(asked, law)
        if until[name] == math.inf:
            return law
    stop, _ = _law(asked, 0.0)
    stop_until = left_alone_until(asked, stop)
    best = max(until, key=lambda name: until[name])
    if until[best] > stop_until + LATER_S:
        return {"soon": soon, **others}[best]
    stay = min(stop_until - stop.end_time - SOONER_S, STAY_S)
    return _law(asked, LASTING_S, max(stay, 0.0))[0]


def kept_or_stopped(asked: StopAsked, stop: Trajectory) -> Trajectory:
    """What a robot does on whose path no law is proven by this look: what an earlier one has shown.

    Args:
        asked: What a law has to keep.
        stop: How it stops by that look's proof.
    """
    kept = _kept(asked).get("kept")
    if kept is None or left_alone_until(asked, kept) <= left_alone_until(asked, stop):
        return stop
    return kept


def _kept(asked: StopAsked) -> dict[str, Trajectory]:
    """The law that there is, if it ends no farther along the path than the robot may go."""
    law = asked.proven
    if law is None or law.distances[-1] > asked.upper.distances[-1] + SAME_PLACE_M:
        return {}
    return {"kept": law} if len(asked.premises.charted) else {}


def stay_meant(law: Trajectory, path: Path, here: float, hold: float) -> float:
    """How long a robot means to stand where its law has its next rest [s].

    Args:
        law: What it would drive if nothing could come.
        path: What is driven.
        here: Where it is along that [m].
        hold: How long it stands at the end of its path [s].
    """
    rest = law.next_rest(here + SAME_PLACE_M)
    if rest >= path.length - SAME_PLACE_M:
        return hold
    if law.distances[-1] <= rest + SAME_PLACE_M:
        return STAY_S
    times = law.times[abs(law.distances - rest) <= SAME_PLACE_M]
    return min(float(times[-1] - times[0]), STAY_S)


def left_alone_until(asked: StopAsked, law: Trajectory) -> float:
    """Up to when nothing on the map comes where a law ends [s]; infinite if it is long enough."""
    end = float(law.distances[-1])
    is_meant = end >= float(asked.upper.distances[-1]) - SAME_PLACE_M
    stay = asked.meant_stay if is_meant else STAY_S
    begin = max(law.end_time, asked.now)
    return at_rest_until(asked.path, end, begin, stay, asked.premises, asked.keep)


def _law(asked: StopAsked, lasting: float, stay: float = 0.0) -> tuple[Trajectory, bool]:
    return passive_law(
        asked.path, asked.upper, asked.premises, asked.keep, asked.limits, asked.now, lasting, stay,
        asked.settle,
    )  # fmt: skip
