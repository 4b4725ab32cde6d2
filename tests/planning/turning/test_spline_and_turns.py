"""Turns on blocked legs, the spline on all others."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.mission.spline_spec import SplineSpec
from viaspline.planning.problem.via_sequence import Leg, RouteVia, ViaSequence
from viaspline.planning.turning.spline_and_turns import runs_of, turns_on_runs


def legs_of(path: vs.Path) -> list[np.ndarray]:
    ends = [round(via.u) for via in path.vias if via.kind == "user"]
    return [path.spans[a:b] for a, b in pairwise(ends)]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.booleans())
def test_only_a_blocked_leg_and_its_neighbours_change(seed: int, closed: bool) -> None:
    rng = np.random.default_rng(seed)
    angles = np.arange(8) * np.pi / 4
    radii = rng.uniform(60, 80, 8)[:, None]
    places = (np.c_[np.cos(angles), np.sin(angles)] * radii).tolist()
    route = {"start": places[0], "via": places[1:], "closed": True}
    if not closed:
        route = {"start": places[0], "via": places[1:-1], "goal": places[-1]}
    data = {"route": route, "spline": {"tension": float(rng.uniform(-0.3, 0.5))}}
    free = vs.plan(vs.Mission.model_validate(data)).path
    blocked = int(rng.integers(0, len(legs_of(free))))
    ends = [via.u for via in free.vias if via.kind == "user"]
    middle = free.evaluate((ends[blocked] + ends[blocked + 1]) / 2).tolist()
    data["world"] = {"known": [{"circle": {"center": middle, "radius": 3.0}}]}
    plan = vs.plan(vs.Mission.model_validate(data))
    legs = zip(legs_of(plan.path), legs_of(free), strict=True)
    changed = {k for k, (new, old) in enumerate(legs) if not np.array_equal(new, old)}
    near = {blocked - 1, blocked, blocked + 1}
    count = len(legs_of(free))
    assert blocked in changed
    assert changed <= ({k % count for k in near} if closed else near)
    assert plan.path.curvature_jumps().max() < 1e-6
    assert plan.certificate.holds


@pytest.mark.parametrize("closed", [False, True])
@given(st.sets(st.integers(0, 7), max_size=7))
def test_runs_are_the_blocked_legs_in_order(closed: bool, blocked: set[int]) -> None:
    runs = list(runs_of(blocked, 8, closed))
    assert sorted(leg for run in runs for leg in run) == sorted(blocked)
    for run in runs:
        assert all((after - before) % 8 == 1 for before, after in pairwise(run))
        assert (run[-1] + 1) % 8 not in blocked or not closed


def test_there_is_no_room_for_turns_between_legs_of_one_cubic() -> None:
    vias = tuple(RouteVia(f"v{k}", np.array([10.0 * k, float(k % 2)]), k) for k in range(4))
    legs = tuple(Leg.straight(0.5, 2) for _ in range(3))
    sequence = ViaSequence(vias, legs, SplineSpec(), tangents="cardinal")

    assert turns_on_runs(sequence, [], {1}, pytest.fail) is None


def on_its_way(through: list[tuple[float, float]]) -> vs.Plan:
    """Past a block and some more into a given heading, with a taut spline."""
    return vs.plan(vs.Mission.model_validate({
        "world": {"known": [
            {"polygon": [[3.647, 12.167], [3.393, 12.987], [2.573, 12.733], [2.827, 11.913]]},
            {"polygon": [[2.284, 10.553], [1.043, 9.212], [2.357, 7.973], [4.276, 8.186],
                         [3.614, 9.916]]},
            {"capsule": {"from": [3.538, 5.481], "to": [5.062, 5.219], "radius": 0.193}},
        ]},
        "robot": {"footprint": [[-0.3, -0.35], [1.0, -0.35], [1.0, 0.35], [-0.3, 0.35]],
                  "clearance_m": 0.113, "min_turn_radius_m": 1.0, "max_speed_mps": 1.378,
                  "max_accel_mps2": 1.987},
        "route": {"start": [7.28, 0.18], "via": [{"at": at} for at in through],
                  "goal": {"at": [2.08, 14.61], "heading_deg": 163.164}},
        "spline": {"tension": 0.587},
    }))  # fmt: skip


def test_a_via_point_on_the_way_makes_no_loop_between_the_directions_of_a_taut_spline():
    plan, served = on_its_way([]), on_its_way([(5.642025874802329, 6.418152056355041)])
    assert served.trajectory.duration < 1.01 * plan.trajectory.duration
    assert served.certificate.holds
