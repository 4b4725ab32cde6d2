"""A look round as ``sensor_msgs/LaserScan``."""

from __future__ import annotations

from typing import Any

from viaspline.robot.perception.lidar import Scan
from viaspline.ros_messages.stamps import LASER_FRAME, header


def laserscan(time: float, scan: Scan, *, period: float = 0.0) -> dict[str, Any]:
    """A scan as a message; where it was taken is said by tf.

    Args:
        time: When it was taken [s].
        scan: What was measured.
        period: From one scan to the next [s]; 0: not known.

    >>> import numpy as np
    >>> message = laserscan(0.0, Scan((0.0, 0.0), 0.0, -1.0, 0.5, 9.0, [3.0, np.inf, np.nan]))
    >>> message["angle_max"], message["ranges"].tolist()
    (0.0, [3.0, inf, nan])
    """
    return {
        "header": header(time, LASER_FRAME),
        "angle_min": scan.angle_min,
        "angle_max": scan.angle_min + scan.angle_increment * (len(scan.ranges) - 1),
        "angle_increment": scan.angle_increment,
        "time_increment": 0.0,
        "scan_time": period,
        "range_min": 0.0,
        "range_max": scan.range_max,
        "ranges": scan.ranges,
        "intensities": (),
    }
