"""How near a flight came to what moves, and whether what touched it could be seen in time.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import MovingSolids
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.solid_sensor import SolidSensor
from viaspline.space.online.takeover import LATENCY_S
from viaspline.tracks.encountered import Encounters
from viaspline.tracks.encounters import DrivenStates, encounters


def flown_encounters(
    legs: Sequence[FlownLeg], end: float, robot: RobotSpec, on_map: Sequence[MovingSolid],
    sensor: SolidSensor, step: float,
) -> Encounters:  # fmt: skip
    """How near a flight came to all that moved.

    Args:
        legs: What was flown, each until the next one began.
        end: When it was over [s].
        robot: Whose body it was.
        on_map: What moved as the map says.
        sensor: With what moved and wasn't on the map.
        step: Between two looks [s].
    """
    states = DrivenStates(legs[0].law.start_time, end, lambda times: states_at(legs, times)[::2])
    everything = MovingSolids((*on_map, *sensor.solids), FlyingBody.of(robot))
    late = _Lateness(states, robot, tuple(on_map), sensor, step)
    return encounters(states, robot, 0.0, everything, late.was_late)


def states_at(legs: Sequence[FlownLeg], times: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Positions [m], headings [rad], speeds and climbs [m/s] of a flight at times [s]."""
    owner = np.searchsorted([leg.until for leg in legs[:-1]], times, side="right")
    parts = [leg.states(times[owner == k]) for k, leg in enumerate(legs)]
    positions, headings, speeds, climbs = (
        np.concatenate(column) for column in zip(*parts, strict=True)
    )
    return positions, headings, speeds, climbs


@dataclass(frozen=True, eq=False)
class _Lateness:
    """What a flight could see when.

    Attributes:
        states: Where the robot was.
        robot: How it brakes.
        on_map: What was known from the start.
        sensor: Of what wasn't.
        step: Between two looks [s].
    """

    states: DrivenStates
    robot: RobotSpec
    on_map: tuple[MovingSolid, ...]
    sensor: SolidSensor
    step: float

    def was_late(self, index: int, time: float) -> bool:
        """Whether something couldn't be seen until the robot couldn't stand any more by a time [s].

        It could if the last look from which the robot could have braked to a stand showed it, and
        it hasn't jumped since.
        """
        if index < len(self.on_map):
            return False
        solid = self.sensor.solids[index - len(self.on_map)]
        looks = np.arange(self.states.begin, time, self.step)
        places, speeds = self.states.state_at(looks)
        brake = self.robot.max_brake_mps2 or self.robot.max_accel_mps2
        in_time = np.flatnonzero(looks + LATENCY_S + speeds / brake <= time)
        if not in_time.size:
            return True
        k = int(in_time[-1])
        return not self.sensor.shows(solid, places[k], float(looks[k])) or _jumps(
            solid, float(looks[k]), time
        )


def _jumps(solid: MovingSolid, begin: float, end: float) -> bool:
    """Whether something isn't there for a moment."""
    cells = (solid.times < end) & (np.append(solid.times[1:], math.inf) > begin)
    return bool((~solid.there[cells]).any())
