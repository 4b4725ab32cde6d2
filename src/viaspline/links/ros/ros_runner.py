"""Drives a robot over a link: hears, steps, says; and leaves it standing however that ends.

Tested through ``links/ros/test_ros_bridge`` and ``links/ros/test_zenoh_link``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Final

from viaspline.curve.path import Path
from viaspline.errors import GeometryError, PlanningError
from viaspline.links.ros.ros_bridge import STANDS_MPS, RosBridge
from viaspline.links.ros.ros_link import RosLink
from viaspline.links.ros.ros_topics import Outgoing
from viaspline.mission.model import Mission
from viaspline.robot.navigator import Navigator

STOPS: Final = 3
"""How often a robot is told to stand at the end: a message may be lost."""
HEALTH_S: Final = 1.0
"""From one message of diagnostics to the next [s]."""
SHOWN_S: Final = 0.5
"""From one message of a path to the next, at least [s]: to make one takes longer than a step."""


@dataclass(frozen=True)
class RosDriveEnd:
    """How a drive over a link ended.

    Attributes:
        reached: Whether the robot is at its goal.
        words: How it ended.
        steps: Of the navigator.
        stops: How often it had to be held for what was missing, once it drove.
    """

    reached: bool
    words: str
    steps: int
    stops: int


class RosRunner:
    """A drive under way.

    Args:
        link: To the robot.
        bridge: Before anything is heard.
        plan: Makes the navigator of a mission, with all that it needs compiled.
        clock: Now [s], as the link's messages have it.
        period: From one step to the next, where no scan comes sooner [s].
        tell: Hears in words of what happens.
        stays: Whether goals are waited for at the end.
    """

    def __init__(
        self, link: RosLink, bridge: RosBridge, plan: Callable[[Mission], Navigator],
        clock: Callable[[], float], *, period: float, tell: Callable[[str], None],
        stays: bool = False,
    ) -> None:  # fmt: skip
        self._link, self.bridge, self._plan, self._clock = link, bridge, plan, clock
        self._period, self._tell, self._stays = period, tell, stays
        self._since = clock()
        self._said: str | None = None
        self._healthy_until = 0.0
        self._shown: Path | None = None
        self._shown_at = -math.inf
        self._steps = self._stops = 0

    def run(self) -> RosDriveEnd:
        """Drive until the end; the robot is told to stand whatever happens."""
        due = self._now()
        try:
            while True:
                look = self.bridge.inputs.look
                for at, topic, message in self._link.messages(max(due - self._now(), 0.0)):
                    self.bridge = self.bridge.heard(topic, message, at - self._since)
                self._plan_if_asked()
                now = self._now()
                if self.bridge.inputs.look is not look or now >= due:
                    self._step(now)
                    due = now + self._period
                if self._is_over():
                    return self._end()
        finally:
            self.stop()

    def stop(self) -> None:
        """Tell the robot to stand, however broken the link is."""
        for _ in range(STOPS):
            with suppress(Exception):  # whatever it is, the next may get through
                self._publish(self.bridge.news(self._now()).told(None))

    def _now(self) -> float:
        return self._clock() - self._since

    def _publish(self, *said: Outgoing) -> None:
        for one in said:
            self._link.publish(one.topic, one.message)

    def _plan_if_asked(self) -> None:
        """Plan what is asked for; the robot stands meanwhile."""
        now = self._now()
        try:
            mission = self.bridge.to_plan(now)
            if mission is None:
                return
            self._publish(self.bridge.news(now).told(None))
            self._tell("planning from where the robot stands …")
            self.bridge = self.bridge.planned(self._plan(mission))
        except (PlanningError, GeometryError) as error:
            if not self._stays:
                raise
            self.bridge = self.bridge.refused(str(error))
            self._tell(f"refused: {error}")
            return
        nav = self.bridge.nav
        assert nav is not None
        self._shown, self._shown_at = nav.path, self._now()
        self._publish(*self.bridge.news(self._now()).plan(nav))
        self._tell("drives")

    def _step(self, now: float) -> None:
        command, self.bridge = self.bridge.stepped(now)
        self._publish(command)  # before all else
        bridge = self.bridge
        lack = bridge.lacks(now)
        if lack is None and bridge.waits_far_off(now):
            lack = "it is too far from the mission's start; drive it there, or --from-here"
        driving = bridge.nav is not None
        self._steps += driving and lack is None
        if lack != self._said:
            self._said = lack
            self._stops += driving and lack is not None
            self._tell(f"stands: {lack}" if lack is not None else "hears all that it needs")
        self._show(now, lack)

    def _show(self, now: float, lack: str | None) -> None:
        """Publish what only people look at: seldom, and after the command."""
        bridge = self.bridge
        if now >= self._healthy_until:
            self._healthy_until = now + HEALTH_S
            self._publish(bridge.news(now).health(bridge.nav, bridge.refusal, lack))
        nav = bridge.nav
        if nav is not None and nav.path is not self._shown and now >= self._shown_at + SHOWN_S:
            self._shown, self._shown_at = nav.path, now
            self._publish(bridge.news(now).path(nav))

    def _is_over(self) -> bool:
        bridge = self.bridge
        if self._stays:
            return False
        if bridge.refusal is not None:
            return True
        state = bridge.inputs.state(self._now())
        return bridge.over and state is not None and abs(state.speed) < STANDS_MPS

    def _end(self) -> RosDriveEnd:
        bridge, nav = self.bridge, self.bridge.nav
        reached = nav is not None and nav.reached
        reason = bridge.refusal if nav is None else nav.reason
        words = "is at its goal" if reached else f"stands: {reason}"
        return RosDriveEnd(reached, words, self._steps, self._stops)
