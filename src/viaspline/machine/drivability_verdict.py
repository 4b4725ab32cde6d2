"""Why a path does not drive well, in words.

Tested through ``machine/test_drivability``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.machine.drivability import NearCusp, PathPlace, Roughness, SpotTurn
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.trajectory import Trajectory

SHARP_SHARE = 0.999
"""A bend that is this near to the least radius is as round."""

LIMIT_SHARE = 1.0 + 1e-4
"""What exceeds a limit by less keeps it: so exactly accelerations are known."""

Peak = tuple[float, PathPlace | None]


def reasons_against(
    sharpest: tuple[float, PathPlace | None, float],
    near_cusps: Sequence[NearCusp],
    turns: Sequence[SpotTurn],
    limits: Limits,
    trajectory: Trajectory,
    lateral: Peak,
    yaw_rate: Peak,
) -> tuple[Roughness, ...]:
    """Why a path is not good to drive; none if it is.

    Args:
        sharpest: The radius of the sharpest place [m], it, and the radius that is round enough [m].
        near_cusps: Of the path.
        turns: On the spot.
        limits: That the time law has to keep.
        trajectory: The time law.
        lateral: The largest acceleration across the path [m/s²], and where.
        yaw_rate: The same of the yaw rate [rad/s].
    """
    return (
        *(_near_cusp(cusp) for cusp in near_cusps),
        *_sharpness(*sharpest),
        *(_turn(turn) for turn in turns if turn.speed > 0.0 or not turn.asked),
        *_limits_broken(limits, trajectory, lateral, yaw_rate),
    )


def place_slip(length: float) -> float:
    """How well a place on a path of a length is known [m]."""
    return 1e-9 * (1.0 + length)


def _near(place: PathPlace | None) -> str:
    return "" if place is None or not place.near else f" near {place.near}"


def _near_cusp(cusp: NearCusp) -> Roughness:
    turn = f"{math.degrees(cusp.turn):.0f}° within {cusp.length:.2g} m"
    return Roughness(f"nearly a cusp: it turns by {turn}{_near(cusp.place)}", cusp.place)


def _sharpness(radius: float, place: PathPlace | None, least: float) -> Iterator[Roughness]:
    if radius < SHARP_SHARE * least:
        text = f"its sharpest bend has a radius of {radius:.2g} m{_near(place)}, less than the "
        yield Roughness(f"{text}robot's own {least:.3g} m", place)


def _turn(turn: SpotTurn) -> Roughness:
    angle = f"{abs(math.degrees(turn.turn)):.0f}°"
    if turn.speed > 0.0:
        text = f"its heading jumps by {angle} at {turn.speed:.2g} m/s{_near(turn.place)}"
        return Roughness(text, turn.place)
    text = f"it stands and turns by {angle}{_near(turn.place)}, where turn_on_spot doesn't say so"
    return Roughness(text, turn.place)


def _accelerations(trajectory: Trajectory) -> Floats:
    """Along the path [m/s²], those of pieces that are too short to tell taken for less."""
    widths = np.diff(trajectory.distances)
    slip = place_slip(float(trajectory.distances[-1]))
    return np.append(trajectory.accelerations * widths / (widths + slip), 0.0)


def _limits_broken(
    limits: Limits, trajectory: Trajectory, lateral: Peak, yaw_rate: Peak
) -> Iterator[Roughness]:
    along, top = _accelerations(trajectory), float(trajectory.speeds.max())
    checks = (
        ("speed", top, limits.max_speed, "m/s", None),
        ("acceleration", float(along.max()), limits.max_accel, "m/s²", None),
        ("braking", float(-along.min()), limits.brake, "m/s²", None),
        ("acceleration across the path", lateral[0], limits.max_lateral_accel, "m/s²", lateral[1]),
        ("yaw rate", yaw_rate[0], limits.max_yaw_rate, "rad/s", yaw_rate[1]),
    )
    for what, value, limit, unit, place in checks:
        if limit is not None and value > limit * LIMIT_SHARE + 1e-9:
            text = f"its {what} is {value:.3g} {unit}{_near(place)}, more than {limit:.3g} {unit}"
            yield Roughness(text, place)
    if trajectory.over_jerk_until is not None:
        yield Roughness("there is no room to keep the limit of the jerk from its start on", None)
