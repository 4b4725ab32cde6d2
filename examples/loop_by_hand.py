"""viaspline in a loop of your own: a cart with a lidar and no map, on a machine made of ten lines.

python examples/loop_by_hand.py
"""

import math

import numpy as np

import viaspline as vs

POSTS = np.array([[6.0, 0.4, 0.8], [11.0, -1.5, 1.0], [12.0, 2.5, 0.9]])  # x, y, radius [m]
ANGLES = np.linspace(-2.3, 2.3, 231)
REACH_M, DELAY_S, LAG_S, PERIOD_S = 6.0, 0.1, 0.15, 0.05

mission = vs.Mission.model_validate({
    "robot": {
        "radius_m": 0.3, "clearance_m": 0.3, "max_speed_mps": 1.0,
        "tracking_error_m": 0.05,
        "drive": {"differential": {"track_m": 0.4}, "delay_s": DELAY_S, "lag_s": LAG_S},
        "sensor": {"lidar": {"range_m": REACH_M, "fov_deg": 264, "beams": len(ANGLES)}},
    },
    "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [18, 0]},
})  # fmt: skip


def laser(x: float, y: float, heading: float) -> list[float]:
    """Your scanner: what its driver puts into the ranges of a LaserScan."""
    c, s = np.cos(heading + ANGLES)[:, None], np.sin(heading + ANGLES)[:, None]
    dx, dy, radius = POSTS[:, 0] - x, POSTS[:, 1] - y, POSTS[:, 2]
    along, aside = c * dx + s * dy, c * dy - s * dx
    hit = (along > 0.0) & (np.abs(aside) < radius)
    depth = np.sqrt(np.maximum(radius**2 - aside**2, 0.0))
    ranges = np.where(hit, along - depth, np.inf).min(axis=1)
    return np.where(ranges <= REACH_M, ranges, np.inf).tolist()


def drive(nav: vs.Navigator) -> tuple[vs.Navigator, list[tuple[float, float]]]:
    x = y = heading = speed = rate = time = 0.0
    waiting, track = [(0.0, 0.0)] * round(DELAY_S / PERIOD_S), []
    while not nav.finished and time < 120.0:
        pose = vs.RobotState((x, y), heading, speed, stamp=time)
        step = ANGLES[1] - ANGLES[0]
        scan = vs.Scan.from_laserscan(
            laser(x, y, heading), ANGLES[0], step, 0.05, REACH_M, pose, stamp=time
        )
        command, nav = nav.step(pose, scan, time)
        for event in nav.events:
            print(f"{event.time:6.2f} s  {event.kind:<10} {event.message}")
        waiting.append((command.velocity[0], command.yaw_rate))  # to the motors, which are late
        (told, turn), share = waiting.pop(0), 1.0 - math.exp(-PERIOD_S / LAG_S)
        speed, rate = speed + share * (told - speed), rate + share * (turn - rate)
        heading += rate * PERIOD_S
        x += speed * PERIOD_S * math.cos(heading)
        y += speed * PERIOD_S * math.sin(heading)
        time += PERIOD_S
        track.append((x, y))
    return nav, track


if __name__ == "__main__":
    done, _ = drive(vs.Navigator(mission))
    print("reached its goal" if done.reached else f"stands: {done.reason}")
