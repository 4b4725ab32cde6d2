"""Whatever is handed in from Python: an answer, or an error of the package's own."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

import viaspline as vs

MISSION = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
LIMITS = vs.Limits(max_speed=1, max_accel=1)
CURVE = vs.CardinalSpline([[0, 0], [1, 0], [2, 1]])
WORLD = vs.World()

JUNK: list[Any] = [
    None, "x", b"x", float("nan"), 10**400, -1, [], {}, [[1]], [["a", "b"]], [None], object(),
    [[0, 0], [float("nan"), 1]], np.zeros((0, 2)), np.zeros((2, 2, 2)), np.array(["a"]), print,
]  # fmt: skip

VERBS: dict[str, Callable[[Any], Any]] = {
    "plan": vs.plan,
    "simulate": vs.simulate,
    "Navigator": vs.Navigator,
    "advise_tension": vs.advise_tension,
    "Mission": vs.Mission.model_validate,
    "load": vs.load,
    "load_map": vs.load_map,
    "CardinalSpline": vs.CardinalSpline,
    "CardinalSpline tension": lambda junk: vs.CardinalSpline([[0, 0], [1, 0]], tension=junk),
    "CardinalSpline knots": lambda junk: vs.CardinalSpline([[0, 0], [1, 0]], knots=junk),
    "PiecewiseCubic": vs.PiecewiseCubic,
    "Path": lambda junk: vs.Path(junk, vias=[]),
    "evaluate": CURVE.evaluate,
    "at_distance": CURVE.at_distance,
    "project": CURVE.project,
    "World": vs.World,
    "World bounds": lambda junk: vs.World(bounds=junk),
    "World fences": lambda junk: vs.World(fences=junk),
    "distance": WORLD.distance,
    "certify curve": lambda junk: vs.certify(junk, WORLD, 1.0),
    "certify world": lambda junk: vs.certify(CURVE, junk, 1.0),
    "certify clearance": lambda junk: vs.certify(CURVE, WORLD, junk),
    "Limits": lambda junk: vs.Limits(max_speed=junk, max_accel=1),
    "retime": lambda junk: vs.retime(junk, LIMITS),
    "retime limits": lambda junk: vs.retime(CURVE, junk),
    "retime stations": lambda junk: vs.retime(CURVE, LIMITS, junk),
    "retime_lap": lambda junk: vs.retime_lap(junk, LIMITS),
}


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("junk", JUNK, ids=lambda junk: repr(junk)[:20])
def test_junk_has_an_answer_or_an_error_of_the_packages_own(verb: str, junk: Any) -> None:
    with suppress(vs.ViasplineError):
        VERBS[verb](junk)
