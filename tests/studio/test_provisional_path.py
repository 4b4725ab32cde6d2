"""Paths that are laid soon: through every via point, for all kinds of robots and curves."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.studio.provisional_path import provisional_path

ROBOTS = (
    {"radius_m": 0.5},
    {"drive": {"ackermann": {"wheelbase_m": 1.5, "max_steer_deg": 30}}},
    {
        "footprint": [[-0.5, -0.4], [1, -0.4], [1, 0.4], [-0.5, 0.4]],
        "drive": {"differential": {"track_m": 0.5}},
    },
)
SPLINES = ({}, {"tension": 0.2}, {"tension": "auto"}, {"tension": 0.1, "tangents": "cardinal"})
places = st.tuples(st.floats(4, 76), st.floats(4, 46))


@settings(max_examples=30)
@given(
    via=st.lists(places, max_size=4),
    robot=st.sampled_from(ROBOTS),
    spline=st.sampled_from(SPLINES),
    closed=st.booleans(),
    optimise=st.sampled_from(("time", "length")),
)
def test_they_pass_every_via_point_in_order(
    via: list[tuple[float, float]], robot: object, spline: object, closed: bool, optimise: str
) -> None:
    apart = [
        at for i, at in enumerate(via) if all(np.hypot(*np.subtract(at, o)) > 5 for o in via[:i])
    ]
    known = [
        {"circle": {"center": [30, 24], "radius": 4}},
        {"polygon": [[50, 10], [54, 10], [54, 30], [50, 30]]},
    ]
    free = [at for at in apart if np.hypot(at[0] - 30, at[1] - 24) > 8 and not 44 < at[0] < 60]
    ends = {"start": [1, 1], **({} if closed and free else {"goal": [79, 49]})}
    mission = Mission.model_validate({
        "world": {"known": known, "bounds": [-9, -9, 90, 60]},
        "robot": {**robot, "clearance_m": 0.3},  # type: ignore[dict-item]
        "route": {**ends, "via": free, "closed": "goal" not in ends, "optimise": optimise},
        "spline": spline,
    })  # fmt: skip
    found = provisional_path(mission)
    if found is None:
        return
    spans = found.spans
    assert np.isfinite(spans).all()
    assert np.allclose(spans[1:, 0], spans[:-1, 3])
    ends_of_spans = np.vstack([spans[:, 0], spans[-1:, 3]])
    behind = 0
    for at in ([1, 1], *free, ends.get("goal", [1, 1])):
        away = np.hypot(*(ends_of_spans[behind:] - at).T)
        reached = np.flatnonzero(away < 1e-6)
        assert reached.size, at
        behind += int(reached[0])
    asked = {"it is not yet driven"} if "drive" in mission.robot.model_fields_set else set()
    assert asked <= set(found.left_out)
