"""Paths that are laid anew under way, for tests: how they begin, and what each has to keep."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import viaspline as vs
from viaspline.curve.path import Path
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning.replan import from_rest, planned, reflex

Oracle = Callable[..., Any]
MODES = [reflex, planned, from_rest]
LEAVING = [reflex, planned]


def disc(x: float, y: float, radius: float, name: str | None = None) -> vs.Obstacle:
    return vs.Obstacle(circle={"center": (x, y), "radius": radius}, name=name)


def start(*stops: Any, **more: Any) -> tuple[Path, vs.World, Requirements]:
    route = {"start": stops[0], "via": list(stops[1:-1]), "goal": stops[-1]}
    if "detours" in more:
        route["detours"] = more.pop("detours")
    if more.pop("closed", False):
        route = {"start": stops[0], "via": list(stops[1:]), "closed": True}
    more.setdefault("spline", {"tangents": "cardinal"})  # a span from via point to via point
    mission = vs.Mission.model_validate({"route": route, **more})
    plan = vs.plan(mission)
    return plan.path, plan.world, Requirements.of(mission)


def served(path: Path) -> list[int | None]:
    return [via.index for via in path.vias if via.kind == "user"]


def check(
    found: Solution, old: Path, at: float, world: vs.World, oracle: Oracle, required: float = 1.0
) -> None:
    """What was driven stays, what lies ahead is clear, the joints are smooth."""
    new = found.path
    assert found.certificate.holds
    driven = np.linspace(0, found.changed_from, 300)
    np.testing.assert_allclose(new.at_distance(driven), old.at_distance(driven), atol=1e-7)
    ahead = new.at_distance(np.linspace(found.changed_from, new.length, 20_000))
    assert oracle(ahead[:, :2], world.obstacles, world.bounds).min() >= required - 2e-6
    assert found.changed_from >= at - 1e-9
