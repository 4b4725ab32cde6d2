"""The cart in ir-sim: a disc that follows its commands late, slowly and with noise.

Its drive is ir-sim's: a lag of first order, limited acceleration and grip, and the noise of speeds
that ir-sim has as its default. The lidar is ir-sim's too. A contact is one that ir-sim's own
contact solver finds.

    pip install 'viaspline[sim]'
"""

from __future__ import annotations

import contextlib
import io
import tempfile
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from numpy.typing import NDArray
from ruamel.yaml import YAML
from sim_bridge import FOV_DEG, NOISE, PERIOD, RADIUS, REACH, Posts, beam_angles

import viaspline as vs

backend = matplotlib.get_backend()
with contextlib.redirect_stdout(io.StringIO()):  # it says which windows it can't open
    import irsim
matplotlib.use(backend)

LAG, ACCEL, YAW_ACCEL = 0.15, 2.0, 4.0
"""Of the drive [s], [m/s²], [rad/s²]."""

FASTEST, FASTEST_TURN = 1.5, 3.0
"""[m/s], [rad/s]."""

BEAMS, CORNERS = 180, 12
"""Of the lidar, and of a post. ir-sim tries every beam against every edge that is near: with 720
beams and its own circles, of 64 corners, a step takes 0.24 s."""


def scene(posts: Posts, start: tuple[float, float, float], more: dict[str, Any]) -> dict[str, Any]:
    """A world of ir-sim.

    Args:
        posts: What stands there.
        start: x, y [m] and heading [rad].
        more: Further keys of the robot.
    """
    robot = {
        "kinematics": {"name": "diff", "noise": True, "tau": LAG},
        "shape": {"name": "circle", "radius": RADIUS},
        "state": [float(value) for value in start],
        "vel_min": [-FASTEST, -FASTEST_TURN],
        "vel_max": [FASTEST, FASTEST_TURN],
        "acce": [ACCEL, YAW_ACCEL],
        "sensors": [
            {
                "name": "lidar2d",
                "range_min": 0.05,
                "range_max": REACH,
                "angle_range": float(np.radians(FOV_DEG)),
                "number": BEAMS,
                "noise": True,
                "std": NOISE,
            }
        ],
        **more,
    }
    stand = [
        {
            "shape": {"name": "polygon", "vertices": corners(post).tolist()},
            "state": [0.0, 0.0, 0.0],
            "static": True,
        }  # or it is set aside by (1, 1)
        for post in posts
    ]
    world = {
        "width": 60, "height": 60, "offset": [-30, -30], "step_time": PERIOD,
        "collision_mode": "contact",
    }  # fmt: skip
    return {"world": world, "robot": [robot], "obstacle": stand}


def corners(post: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of a post that has corners [m], (12, 2)."""
    turns = np.arange(CORNERS) * 2.0 * np.pi / CORNERS
    return post[:2] + post[2] * np.column_stack((np.cos(turns), np.sin(turns)))


class IrsimCart:
    """See ``SimulatedCart``.

    Args:
        posts: What stands there.
        start: x, y [m] and heading [rad].
        seed: Of all noise.
        more: Further keys of the robot, such as a behavior of ir-sim's own.
    """

    def __init__(
        self,
        posts: Posts,
        start: tuple[float, float, float],
        seed: int = 0,
        more: dict[str, Any] | None = None,
    ) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "world.yaml"
            YAML(typ="safe").dump(scene(posts, start, more or {}), file)
            self.env = irsim.make(str(file), headless=True, log_level="ERROR", seed=seed)
        self.robot = self.env.robot
        self.steps = 0
        self.angles = beam_angles(BEAMS)
        self.solids = [(one.geometry, 0.0) for one in self.env.obstacle_list]
        self.contacts, self.track = 0, [(start[0], start[1])]

    @property
    def time(self) -> float:
        return self.steps * PERIOD

    @property
    def state(self) -> vs.RobotState:
        x, y, heading = (float(value) for value in self.robot.state[:3, 0])
        speed = float(self.robot.velocity[0, 0])
        return vs.RobotState((x, y), heading, speed, stamp=self.time)

    def ranges(self) -> NDArray[np.float64]:
        scan = self.env.get_lidar_scan()
        return np.where(scan["valid"], scan["ranges"], np.inf)

    def drive(self, speed: float, yaw_rate: float) -> None:
        self.advance([speed, yaw_rate])

    def advance(self, action: list[float] | None) -> None:
        """Drive for a period, by its own behavior without a command."""
        self.env.step(action)
        self.steps += 1
        x, y = (float(value) for value in self.robot.state[:2, 0])
        self.track.append((x, y))
        self.contacts += bool(self.robot.contact.reports) or bool(self.robot.collision)
