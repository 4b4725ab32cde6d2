"""What is advised about tension, in words.

Tested through ``test_advice``.
"""

from __future__ import annotations

import math

from viaspline.advice import TensionAdvice
from viaspline.mission.stated_tension import StatedTension
from viaspline.report.units import seconds

STRAIGHT_1PM = 1e-9
"""Peak curvature of a path that is straight but for rounding [1/m]."""

LEAST_GAIN_S = 0.05
"""What is gained at least to be told [s]."""


def tension_words(tension: StatedTension) -> str:
    """A tension, or the tensions of the spans.

    >>> tension_words(0.1), tension_words((0.0, 0.5, 0.3)), tension_words(None)
    ('0.1', '0 to 0.5 by span', 'none stated')
    """
    if tension is None:
        return "none stated"
    if isinstance(tension, float):
        return f"{tension:g}"
    return f"{min(tension):g} to {max(tension):g} by span"


def advice_words(advice: TensionAdvice) -> str:
    """What to take, and what that gains over what stands in the mission."""
    time, peak = advice.chosen.cost
    if not advice.matters:
        return f"There is nothing to choose: {_why_none(advice)} ({seconds(time)})."
    tension = advice.suggested
    take = "state no tension" if tension is None else f"tension {tension_words(tension)}"
    if tension is None:
        take += ", so that lines and turns are laid where they are sooner than the spline"
    elif advice.effects is not None and not advice.keeps_spline:
        take += ", lines and turns where that is blocked or too sharp"
    drive = f"{seconds(time)}, at most {peak:.3g} 1/m"
    return f"Suggested: {take}: {drive}{_gain(advice)}."


def _gain(advice: TensionAdvice) -> str:
    stands = advice.stands
    if stands is None:
        return _gain_by_stating(advice)
    if stands.plan is None:
        return "; with what stands there is no plan"
    if stands is advice.chosen:
        return ", as it stands"
    gained = stands.cost[0] - advice.chosen.cost[0]
    if gained < LEAST_GAIN_S:
        return f"; {stands.cost[1]:.3g} 1/m as it stands"
    return f"; {seconds(gained)} faster than as it stands"


def _gain_by_stating(advice: TensionAdvice) -> str:
    """How much sooner one is than none, or none than the best that is stated."""
    of_stated = [trial.cost[0] for trial in advice.trials if trial.tension is not None]
    others = [trial.cost[0] for trial in advice.trials if trial.tension is None]
    than, of = "any that is stated", of_stated
    if advice.suggested is not None:
        than, of = "with none stated", others
    gained = min(of, default=math.inf) - advice.chosen.cost[0]
    if not LEAST_GAIN_S <= gained < math.inf:
        return ""
    return f"; {seconds(gained)} faster than {than}"


def _why_none(advice: TensionAdvice) -> str:
    effects = advice.effects
    if effects is None:
        return "along the line of a corridor there is no tension"
    if not effects.allowed.any():
        return "whatever the tension, lines and turns are laid in place of the spline"
    if advice.chosen.cost[1] <= STRAIGHT_1PM:
        return "the path is straight"
    return "the path is always the same"
