"""What a robot with a lidar knows where things move: what stands, and what moves or may move."""

from __future__ import annotations

from dataclasses import dataclass, replace

from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.perception.belief import Belief, News
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.track_hits import TrackedHits
from viaspline.robot.perception.moving.tracking_premises import TrackingPremises
from viaspline.world.world import World


@dataclass(frozen=True, eq=False)
class MovingScene:
    """What a lidar has shown; a new one for every scan.

    A hit goes to one of the two: what moves leaves nothing behind in what is believed to stand.

    Attributes:
        belief: What stands.
        tracked: What moves, or may.
    """

    belief: Belief
    tracked: TrackedHits

    @classmethod
    def at_start(cls, world: World, robot: RobotSpec) -> MovingScene:
        """What a robot that has just been put down knows.

        Args:
            world: What it knows to stand.
            robot: It has a lidar, and says what it has to reckon with.

        Raises:
            AssertionError: When it has no lidar, or nothing unseen moves.
        """
        assert robot.moving is not None
        belief = Belief.at_start(world, robot)
        premises = TrackingPremises(
            top_speed=robot.moving.max_speed_mps, noise=belief.surfaces.noise
        )
        return cls(belief, TrackedHits(premises))

    def with_scan(self, scan: Scan, time: float) -> tuple[MovingScene, News]:
        """What is known after one more scan, and what is new of what stands.

        Args:
            scan: A look round.
            time: When it was taken [s].

        Raises:
            GeometryError: When the scan is older than the one before.
        """
        tracked, standing = self.tracked.with_scan(scan, time, self.belief.world)
        belief, news = self.belief.with_scan(scan, standing)
        return replace(self, belief=belief, tracked=tracked), news
