"""What the loop asks of a simulator: where the cart is, what it sees, and to drive on.

All simulators hold the same cart: a disc of 0.17 m about the middle of its axle, two wheels, and
on top of the axle a lidar of 270 degrees and 5 m. It is told a speed and a yaw rate every 0.05 s,
as by ROS's ``cmd_vel``. What its motors and wheels make of that is the simulator's business.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
import shapely
from numpy.typing import NDArray

import viaspline as vs

RADIUS, TRACK = 0.17, 0.26
"""Of the cart, and between its wheels [m]."""

PERIOD = 0.05
"""From command to command [s]."""

REACH, FOV_DEG, NOISE = 5.0, 270.0, 0.01
"""Of the lidar: how far [m], how wide, and how noisy [m]."""

Posts = NDArray[np.float64]
"""x, y and radius of each post [m], (n, 3)."""


class SimulatedCart(Protocol):
    """A cart in somebody's simulator.

    Attributes:
        time: [s].
        state: Where it is.
        angles: Of the beams of its lidar, evenly, the first one on the right [rad].
        solids: What stands there as the simulator has it: a geometry and what is round it [m].
        contacts: Steps of the simulator in which it touched something.
        track: Where it was: x, y [m] at every step of the simulator.
    """

    time: float
    angles: NDArray[np.float64]
    solids: list[tuple[shapely.Geometry, float]]
    contacts: int
    track: list[tuple[float, float]]

    @property
    def state(self) -> vs.RobotState: ...

    def ranges(self) -> NDArray[np.float64]:
        """What the lidar measures now [m], inf where nothing is in reach, as many as beams."""
        ...

    def drive(self, speed: float, yaw_rate: float) -> None:
        """Give it a command and let it drive for a period."""
        ...


def beam_angles(beams: int) -> NDArray[np.float64]:
    """Of so many beams [rad]."""
    return np.radians(np.linspace(-0.5 * FOV_DEG, 0.5 * FOV_DEG, beams))
