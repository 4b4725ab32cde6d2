import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import FacingAlong, yaw_profile
from viaspline.trajectory.limits import Limits

ALONG = Limits(max_speed=8, max_accel=2, max_lateral_accel=2)


@settings(max_examples=25)
@given(seed=st.integers(0, 10_000), vertical=st.sampled_from([None, 0.8]))
def test_a_drive_in_space_keeps_every_limit(seed: int, vertical: float | None) -> None:
    rng = np.random.default_rng(seed)
    vias = rng.uniform(0, 80, (int(rng.integers(2, 5)), 3)) * (1, 1, 0.5)
    curve = CardinalSpline(vias, knots="chordal", tangents="continuous")
    path = Path(curve.spans, vias=[])
    limits = SpatialLimits(
        along=ALONG, climb=2.5, descent=1.5, vertical_accel=vertical, yaw_rate=1.0
    )
    yaw = yaw_profile(path, FacingAlong())
    law = retime_in_space(path, limits, (), yaw)
    times = np.linspace(0, law.duration, 6001)
    at, speed, _ = law.state_at(times)
    u = path.parameter(at)
    way = path.tangent(u)
    rise = speed * way[:, 2]
    assert speed.max() <= 8 * (1 + 1e-9)
    assert rise.max() <= 2.5 * (1 + 1e-6)
    assert rise.min() >= -1.5 * (1 + 1e-6)
    step = times[1] - times[0]
    assert np.abs(np.diff(yaw.at(at))).max() <= 1.0 * step * 1.01
    assert (speed**2 * path.curvature(u)).max() <= 2 * (1 + 1e-6)
    if vertical is not None:
        up = np.diff(rise) / step
        assert np.quantile(np.abs(up), 0.995) <= vertical * 1.02


def test_a_climb_takes_as_long_as_its_rate_and_its_acceleration_make_it() -> None:
    up = Path([[[0, 0, 0], [0, 0, 10], [0, 0, 20], [0, 0, 30]]], vias=[])
    limits = SpatialLimits(along=ALONG, climb=3.0)
    law = retime_in_space(up, limits, (), yaw_profile(up, FacingAlong()))
    assert math.isclose(law.duration, 30 / 3 + 3 / 2)


@pytest.mark.parametrize("name", ["climb", "descent", "vertical_accel", "yaw_rate"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf, "fast"])
def test_a_limit_that_is_no_number_above_0_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(GeometryError, match=name):
        SpatialLimits(along=ALONG, **{name: value})  # type: ignore[arg-type]
