"""A machine of its own in a control loop: it delays, lags, slips and is jumped, as it likes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.logbook import Logbook
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Event
from viaspline.robot.state import Command, RobotState

FINE_S = 0.01


@dataclass
class Cart:
    """A differential cart: first-order lag behind delayed commands, scaled by what it slips."""

    state: RobotState
    delay: float = 0.0
    lag: float = 0.0
    share: Callable[[float], float] = lambda _: 1.0
    turn_share: float = 1.0
    time: float = 0.0
    rate: float = 0.0
    given: list[tuple[float, float, float]] = field(default_factory=list)
    """What was commanded, by time, and isn't followed yet."""
    followed: list[float] = field(default_factory=lambda: [0.0, 0.0])
    driven: list[tuple[float, float, float, float]] = field(default_factory=list)

    def told(self, command: Command, time: float) -> None:
        speed = command.velocity[0] + 0.5 * command.acceleration * FINE_S
        self.given.append((time, speed, command.yaw_rate))

    def moved_until(self, time: float) -> None:
        while self.time < time - 1e-9:
            while self.given and self.given[0][0] + self.delay <= self.time + 1e-9:
                _, *self.followed = self.given.pop(0)
            speed, rate = self.followed
            step = min(FINE_S, time - self.time)
            follow = 1.0 if self.lag == 0.0 else 1.0 - math.exp(-step / self.lag)
            along = self.state.speed + (self.share(self.time) * speed - self.state.speed) * follow
            self.rate += (self.turn_share * rate - self.rate) * follow
            middle = self.state.heading + 0.5 * self.rate * step
            x, y = self.state.position
            place = (x + along * step * math.cos(middle), y + along * step * math.sin(middle))
            heading = self.state.heading + self.rate * step
            self.state = RobotState(place, heading, along)
            self.time += step
            self.driven.append((self.time, *place, along))


@dataclass(frozen=True)
class Driven:
    """What a loop came to."""

    nav: Navigator
    book: Logbook
    track: np.ndarray

    @property
    def kinds(self) -> list[str]:
        return [event.kind for event in self.book.events]

    def first(self, kind: str) -> Event:
        return next(event for event in self.book.events if event.kind == kind)

    def gap(self, obstacles: list[Obstacle], radius: float) -> float:
        """The least room between the body and some discs, by their centres."""
        gaps = [math.inf]
        for one in obstacles:
            assert one.circle is not None
            away = np.hypot(*(self.track[:, 1:3] - np.array(one.circle.center)).T)
            gaps.append(float(away.min()) - one.circle.radius - radius)
        return min(gaps)


def in_a_loop(
    nav: Navigator,
    cart: Cart,
    *,
    period: Callable[[int], float] = lambda _: 0.05,
    measure: Callable[[RobotState, float], RobotState] = lambda state, _: state,
    sense: Callable[[RobotState, int, float], object] = lambda *_: (),
    limit: float = 120.0,
    after: float = 0.0,
) -> Driven:
    """Drive until the navigator has finished and the cart stands."""
    book, tick, time = Logbook(), 0, 0.0
    cart.driven.append((0.0, *cart.state.position, 0.0))
    over = math.inf
    while time < min(limit, over):
        command, nav = nav.step(measure(cart.state, time), sense(cart.state, tick, time), time)
        book.note(nav)
        cart.told(command, time)
        time += period(tick)
        cart.moved_until(time)
        tick += 1
        if nav.finished and math.isinf(over):
            over = time + after + cart.delay + 5.0 * cart.lag
    return Driven(nav, book, np.array(cart.driven))


DISCS = [([10.0, 0.3], 1.5), ([20.0, -2.0], 1.5), ([30.0, 2.0], 1.5)]


def slalom(**robot: Any) -> Mission:
    """Three discs in a row, a body of 0.3 m that keeps 0.5 m, and 2 m/s."""
    body = {"radius_m": 0.3, "clearance_m": 0.5, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}
    known = [{"circle": {"center": at, "radius": radius}} for at, radius in DISCS]
    return Mission.model_validate(
        {
            "world": {"unseen" if "lidar" in robot.get("sensor", {}) else "known": known},
            "robot": {**body, **robot},
            "route": {
                "start": {"at": [0, 0], "heading_deg": 0},
                "via": [[15, -2], [25, 2]],
                "goal": [40, 0],
            },
        }
    )


def cart(delay: float = 0.0, lag: float = 0.0, **keys: Any) -> Cart:
    return Cart(RobotState((0.0, 0.0), 0.0, 0.0), delay, lag, **keys)


@pytest.fixture(scope="session")
def slalom_of() -> Callable[..., Mission]:
    return slalom


@pytest.fixture(scope="session")
def cart_of() -> Callable[..., Cart]:
    return cart


@pytest.fixture(scope="session")
def loop() -> Callable[..., Driven]:
    return in_a_loop


@pytest.fixture(scope="session")
def discs() -> list[Obstacle]:
    return [Obstacle.model_validate({"circle": {"center": c, "radius": r}}) for c, r in DISCS]
