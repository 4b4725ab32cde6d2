"""One drive of the simulated cart through one world, and what is measured of it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from sim_bridge import FOV_DEG, NOISE, PERIOD, RADIUS, REACH, SimulatedCart

import viaspline as vs

CLEARANCE, SPEED, ACCEL = 0.03, 1.0, 1.0
"""What the mission asks for: free space [m], at most so fast [m/s] and [m/s²]."""

LONGEST, AT_GOAL = 180.0, 0.15
"""A drive ends then [s]; who is so near to the goal has reached it [m]."""

Place = tuple[float, float]


@dataclass(frozen=True)
class Drive:
    """What came of one world.

    Attributes:
        world: Its number.
        reached: Whether the cart stands at its goal, by its true place.
        contacts: Steps of the simulator with a contact.
        kept: The least free space about its body, by shapely on its true places [m].
        seconds: How long it drove [s].
        cpu: Of each step while it drove, by the thread's clock [s].
        wall: The same by the clock on the wall [s].
        standing: The longest step while it stood, by the thread's clock [s].
        events: What happened, as ``time kind: message``.
        reason: Why it gave up.
        allowance: What was kept for its tracking error at first, and at last [m].
    """

    world: int
    reached: bool
    contacts: int
    kept: float
    seconds: float
    cpu: tuple[float, ...] = ()
    wall: tuple[float, ...] = ()
    standing: float = 0.0
    events: tuple[str, ...] = ()
    reason: str | None = None
    allowance: tuple[float, float] = (0.0, 0.0)

    def line(self, name: str) -> str:
        spent = f", steps at most {1e3 * max(self.cpu):.0f} ms" if self.cpu else ""
        end = "reached" if self.reached else f"NOT reached ({self.reason})"
        return (f"{name}, world {self.world}: {end} after {self.seconds:.1f} s, {self.contacts} "
                f"contacts, clear by {1e3 * self.kept:.1f} mm, allowance "
                f"{1e3 * self.allowance[0]:.0f} to {1e3 * self.allowance[1]:.0f} mm"
                f"{spent}")  # fmt: skip


def mission(
    keys: dict[str, Any], beams: int, start: Place, goal: Place, heading_deg: float = 90.0
) -> vs.Mission:
    """The cart's mission: no map, and the drive as it was identified.

    Args:
        keys: Below ``robot``, as identified.
        beams: Of its lidar.
        start: [m].
        goal: [m].
        heading_deg: At the start.
    """
    lidar = {"range_m": REACH, "fov_deg": FOV_DEG, "beams": beams, "noise_m": NOISE}
    known = {key: value for key, value in keys.items() if key != "localization"}  # it is exact
    accel = min(ACCEL, float(known.pop("max_accel_mps2", ACCEL)))
    robot = {
        "radius_m": RADIUS, "clearance_m": CLEARANCE, "max_speed_mps": SPEED,
        "max_accel_mps2": accel, "sensor": {"lidar": lidar}, **known,
    }  # fmt: skip
    robot["max_speed_mps"] = min(SPEED, float(robot["max_speed_mps"]))
    route = {"start": {"at": start, "heading_deg": heading_deg}, "goal": goal}
    return vs.Mission.model_validate({"robot": robot, "route": route})


def drive(
    world: int, cart: SimulatedCart, task: vs.Mission, tell: Callable[[str], None] = lambda _: None,
) -> Drive:  # fmt: skip
    """Drive a cart by viaspline."""
    nav = vs.Navigator(task, period=PERIOD)
    first, first_beam, apart = nav.allowance, cart.angles[0], cart.angles[1] - cart.angles[0]
    cpu, wall, events, standing = [], [], [], 0.0
    while not nav.finished and cart.time < LONGEST:
        state, now = cart.state, cart.time
        scan = vs.Scan.from_laserscan(
            cart.ranges(), first_beam, apart, 0.05, REACH, state, stamp=now
        )
        begin = time.thread_time(), time.perf_counter()
        command, nav = nav.step(state, scan, now)
        spent = time.thread_time() - begin[0], time.perf_counter() - begin[1]
        if abs(state.speed) > 0.01:
            cpu.append(spent[0])
            wall.append(spent[1])
        else:
            standing = max(standing, spent[0])
        for event in nav.events:
            events.append(f"{event.time:.2f} s {event.kind}: {event.message}")
            tell(events[-1])
        cart.drive(command.velocity[0], command.yaw_rate)
    return Drive(
        world, is_there(cart, task), cart.contacts, kept(cart), cart.time, tuple(cpu),
        tuple(wall), standing, tuple(events), nav.reason, (first, nav.allowance),
    )  # fmt: skip


def is_there(cart: SimulatedCart, task: vs.Mission) -> bool:
    gone = np.subtract(cart.state.position, task.route.goal.at)
    return float(np.hypot(*gone)) <= AT_GOAL


def kept(cart: SimulatedCart) -> float:
    """The least free space about the cart's body on its true way [m]."""
    line = shapely.LineString(cart.track) if len(cart.track) > 1 else shapely.Point(cart.track[0])
    gaps = [shapely.distance(line, solid) - round_it for solid, round_it in cart.solids]
    return min(gaps, default=np.inf) - RADIUS
