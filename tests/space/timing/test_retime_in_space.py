import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline, Tangents
from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.mission.model import Mission
from viaspline.space.spatial_request import spatial_limits_of
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import FacingAlong, yaw_profile
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.trajectory import Trajectory

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


def upward_accelerations(path: Path, law: Trajectory) -> np.ndarray:
    """z'' = z_ss v² + z_s a of a law without jerk, on 400 places of every span of a curve."""
    found = []
    squares = np.asarray(law.speeds) ** 2
    along = np.asarray(law.distances)
    w = np.linspace(1e-6, 1 - 1e-6, 400)[:, None]
    for k, span in enumerate(np.asarray(path.spans)):
        a, b, c = np.diff(span, axis=0)
        first = 3 * ((1 - w) ** 2 * a + 2 * w * (1 - w) * b + w * w * c)
        second = 6 * ((1 - w) * (b - a) + w * (c - b))
        size = (first * first).sum(axis=1)
        slope = first[:, 2] / np.sqrt(size)
        bend = (second[:, 2] * size - first[:, 2] * (first * second).sum(axis=1)) / size**2
        at = np.asarray(path.distance(k + w[:, 0]))
        i = np.clip(np.searchsorted(along, at, side="right") - 1, 0, len(along) - 2)
        gained = (squares[i + 1] - squares[i]) / (along[i + 1] - along[i])
        found.append(bend * (squares[i] + gained * (at - along[i])) + slope * gained / 2)
    return np.concatenate(found)


@settings(max_examples=30)
@given(
    seed=st.integers(0, 10_000),
    share=st.sampled_from([0.2, 0.7, 1.0, 1.3]),
    tangents=st.sampled_from(["continuous", "cardinal"]),
)
def test_a_mission_keeps_its_limit_of_the_acceleration_up_and_down(
    seed: int, share: float, tangents: Tangents
) -> None:
    rng = np.random.default_rng(seed)
    accel, brake, across = rng.uniform(0.5, 2, 3).tolist()
    most = share * max(accel, brake)
    limits = spatial_limits_of(
        Mission.model_validate(
            {"robot": {"max_speed_mps": 8, "max_accel_mps2": accel, "max_brake_mps2": brake,
                       "max_lateral_accel_mps2": across, "max_vertical_accel_mps2": most},
             "route": {"start": [0, 0, 5], "goal": [9, 0, 5]}}
        )
    )  # fmt: skip
    vias = rng.uniform(0, 60, (int(rng.integers(2, 6)), 3))
    path = Path(CardinalSpline(vias, knots="chordal", tangents=tangents).spans, vias=[])
    law = retime_in_space(path, limits, (), yaw_profile(path, FacingAlong()))
    assert np.abs(upward_accelerations(path, law)).max() <= most * (1 + 1e-6)


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
