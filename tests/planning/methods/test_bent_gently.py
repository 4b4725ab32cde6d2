"""Paths bent less, beside the lines and turns that they were."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

import viaspline as vs
from viaspline.planning.methods.bent_gently import BentGently
from viaspline.planning.turning.gentler_path import bending

KEPT = 1.0


def mission(seed: int, **route: object) -> vs.Mission:
    random = np.random.default_rng((77, seed))
    discs = [
        {"circle": {"center": random.uniform((10, -12), (90, 12)).tolist(), "radius": radius}}
        for radius in random.uniform(1.0, 5.0, 7).tolist()
    ]
    return vs.Mission.model_validate({
        "world": {"known": discs},
        "robot": {"radius_m": 0.6, "clearance_m": 0.4, "max_speed_mps": 2, "max_accel_mps2": 1},
        "route": {"start": [0, 0], "via": [[50, 20]], "goal": [100, 0], "detours": "short"} | route,
    })  # fmt: skip


def without(monkeypatch: pytest.MonkeyPatch, asked: vs.Mission) -> vs.Plan:
    """As it is planned with lines and turns alone."""
    with monkeypatch.context() as patched:
        patched.setattr(BentGently, "lay", lambda self, *given: self.method.lay(*given))
        return vs.plan(asked)


def test_paths_bend_less_take_hardly_longer_and_keep_all_that_they_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saved = []
    for seed in range(6):
        asked = mission(seed)
        turns, plan = without(monkeypatch, asked), vs.plan(asked)
        before, after = bending(turns.path.spans), bending(plan.path.spans)
        saved.append(1.0 - after / before)
        assert after <= before
        assert plan.trajectory.duration <= 1.004 * turns.trajectory.duration
        assert plan.certificate.clearance >= 0.4
        assert plan.path.curvature_jumps().max() < 1e-6
        (via,) = [via for via in plan.path.vias if via.kind == "user" and via.at == (50.0, 20.0)]
        assert plan.path.evaluate(via.u).tolist() == [50.0, 20.0]
        places = plan.path.evaluate(np.linspace(*plan.path.domain, 4001))
        solid = [
            shapely.Point(disc.circle.center).buffer(disc.circle.radius, 64)
            for disc in asked.world.known
            if disc.circle is not None
        ]
        gaps = shapely.distance(shapely.points(places), shapely.union_all(solid))
        assert gaps.min() >= KEPT - 1e-6
    assert np.median(saved) > 0.05


def test_a_curve_past_two_discs_is_that_of_least_bending() -> None:
    """Beside the middle of one disc and free at both ends, its curvature falls evenly to zero."""
    asked = vs.Mission.model_validate({
        "world": {"known": [{"circle": {"center": [50, -3], "radius": 3.5}}]},
        "robot": {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2},
        "route": {"start": [0, 0], "goal": [100, 0], "detours": "short"},
    })  # fmt: skip
    path = vs.plan(asked).path
    half = np.array([abs(path.curvature(u)) for u in np.linspace(0.0, len(path.spans), 401)])[:201]
    peak = half.max()
    assert peak == pytest.approx(3.0 * 1.5 / 50.0**2, rel=0.05)  # a beam's: 3 height / half²
    assert np.diff(half).min() > -0.02 * peak


@pytest.mark.parametrize(
    "route",
    [{"start": {"at": [0, 0], "heading_deg": 30}}, {"optimise": "length"}, {"closed": True}],
)
def test_paths_that_are_not_bent_are_as_they_were(
    monkeypatch: pytest.MonkeyPatch, route: dict[str, object]
) -> None:
    closing = {"goal": None} if "closed" in route else {}
    asked = mission(3, **route, **closing)
    np.testing.assert_array_equal(without(monkeypatch, asked).path.spans, vs.plan(asked).path.spans)
