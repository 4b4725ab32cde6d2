"""Legs that nobody has moved aren't searched again."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.space.leg_router import LegRouter
from viaspline.space.plan_spatial import plan_by, plan_spatial
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.studio.space.leg_memory import CheapestWays, KnownWays, RememberedWays


def mission(last: tuple[float, float, float] = (90, 0, 10)) -> Mission:
    towers = [{"circle": {"center": [x, 0.5], "radius": 4}, "height_m": [0, 30]} for x in (25, 70)]
    route = {"start": [0, 0, 10], "via": [[45, 0, 10]], "goal": last}
    return Mission.model_validate({"world": {"known": towers}, "route": route})


def planned(asked: Mission, ways: RememberedWays) -> Any:
    return plan_by(asked, spatial_problem_of(asked), ways)


def router(asked: Mission) -> LegRouter:
    return LegRouter(spatial_problem_of(asked), asked)


def searched(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The legs whose ways are looked for from now on."""
    legs: list[int] = []
    usual = LegRouter.ways

    def counted(self: LegRouter, leg: int, laid: Any) -> Any:
        legs.append(leg)
        return usual(self, leg, laid)

    monkeypatch.setattr(LegRouter, "ways", counted)
    return legs


def test_only_the_leg_that_moved_is_searched(monkeypatch: pytest.MonkeyPatch) -> None:
    first = RememberedWays(router(mission()), {})
    planned(mission(), first)
    legs = searched(monkeypatch)
    moved = mission((90, 3, 12))
    ways = RememberedWays(router(moved), first.known)
    plan = planned(moved, ways)
    assert legs == [1]
    assert np.array_equal(plan.path.spans, plan_spatial(moved).path.spans)


def test_the_cheapest_way_alone_is_proven_and_says_so() -> None:
    nothing: KnownWays = {}
    ways = CheapestWays(router(mission()), nothing)
    plan = planned(mission(), ways)
    assert plan.certificate.holds
    assert ways.alone == 2
    assert not ways.known
    assert [len(entry.candidates) for entry in plan.ledger] == [1, 1]


def test_what_is_known_is_taken_instead_of_the_cheapest() -> None:
    whole = RememberedWays(router(mission()), {})
    best = planned(mission(), whole)
    ways = CheapestWays(router(mission()), whole.known)
    plan = planned(mission(), ways)
    assert ways.alone == 0
    assert np.array_equal(plan.path.spans, best.path.spans)
