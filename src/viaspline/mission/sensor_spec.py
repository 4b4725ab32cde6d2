"""What finds the obstacles that are not on the map.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from typing import Annotated, Final

from pydantic import Field

from viaspline.mission.fields import DEGREES, Distance, Length, Number, SpeedNoise
from viaspline.mission.value import OneOf, Value

MAX_BEAMS: Final = 100_000
"""How many beams a lidar can have at most."""
MIN_FOV_DEG: Final = 0.01
"""The least angle that a lidar's beams are spread over."""


class Lidar(
    Value,
    expected="a mapping such as {range_m: 5, fov_deg: 270, beams: 720, noise_m: 0.01}",
    examples=({"range_m": 5, "fov_deg": 270, "beams": 720, "noise_m": 0.01},),
):
    """A scanner that measures the distance along each of its beams.

    Attributes:
        range_m: The length of a beam [m].
        fov_deg: The angle that the beams are spread over, half of it to each side of the robot's
            heading [deg].
        beams: How many there are, equally spaced.
        noise_m: The standard deviation of a measured distance [m].
    """

    range_m: Length
    fov_deg: Annotated[Number, DEGREES, Field(ge=MIN_FOV_DEG, le=360)] = 360.0
    beams: Annotated[int, Field(strict=True, ge=1, le=MAX_BEAMS)] = 360
    noise_m: Distance = 0.0


class Sensor(
    OneOf,
    expected="{range_m: 40} or {lidar: {range_m: 5}}",
    exactly_one=("range_m", "lidar"),
    needing=(("velocity_noise_mps", "range_m"),),
    examples=(
        {"range_m": 40, "velocity_noise_mps": 0.1},
        {"lidar": {"range_m": 5, "fov_deg": 270}},
    ),
):
    """What finds the obstacles that are not on the map: a range sensor or a lidar.

    Attributes:
        range_m: It sees every obstacle of which a part is within this distance [m]. None for a
            lidar.
        lidar: It sees what its beams hit.
        velocity_noise_mps: The standard deviation of each coordinate of a velocity that a range
            sensor measures [m/s].

    >>> Sensor(range_m=40).reach, Sensor(lidar={"range_m": 5}).reach
    (40.0, 5.0)
    """

    range_m: Length | None = None
    lidar: Lidar | None = None
    velocity_noise_mps: SpeedNoise = 0.0

    @property
    def reach(self) -> float:
        """How far it sees [m], whichever it is."""
        if self.lidar is not None:
            return self.lidar.range_m
        assert self.range_m is not None
        return self.range_m
