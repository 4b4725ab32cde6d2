"""What a robot knows of the world around it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.belief import Belief, News
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_hits import TrackedHits
from viaspline.robot.perception.moving.track_sightings import SightedTrack, TrackedSightings
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

Foreseen = Callable[[Iterable[ObjectTrack | SightedTrack], float], MovingObstacles]
"""What tracked things are taken to do from a time [s] on."""


@dataclass(frozen=True)
class Knowledge:
    """All that is known at one moment: the map, what was told, and what a lidar has shown.

    Attributes:
        world: All of it.
        told: The obstacles in that world that are on the map or were told one by one.
        belief: What a lidar has shown; None without one.
        in_sight: The obstacles that were told of in the last look, as the same objects: those that
            are told of again need not be compared with all that is known.
        moving: What moves, as far as it is known or foreseen.
        charted: How many of these are on the map.
        tracked: What was told to move and isn't on the map.
        hits: What a lidar has shown that moves or may; None: it is taken to show what stands.
    """

    world: World
    told: frozenset[Obstacle]
    belief: Belief | None = None
    in_sight: tuple[Obstacle, ...] = field(default=(), compare=False)
    moving: MovingObstacles = field(default_factory=MovingObstacles, compare=False)
    charted: int = 0
    tracked: TrackedSightings = field(default_factory=TrackedSightings, compare=False)
    hits: TrackedHits | None = field(default=None, compare=False)

    def with_obstacles(self, obstacles: Sequence[Obstacle]) -> tuple[Knowledge, World]:
        """What is known with obstacles that were not told before.

        Returns:
            (what is known, the new obstacles alone, each by the name that it has in there).
        """
        if self.belief is None:
            old, belief = len(self.world), None
            world = self.world.with_obstacles(obstacles)
        else:
            old, belief = len(self.belief.map), self.belief.with_obstacles(obstacles)
            world = belief.world
        new = World(
            obstacle.model_copy(update={"name": world.name(old + i)})
            for i, obstacle in enumerate(obstacles)
        )
        return replace(self, world=world, told=self.told.union(obstacles), belief=belief), new

    def with_sightings(
        self, seen: Sequence[MovingSighting], time: float, ahead: Foreseen
    ) -> Knowledge:
        """What is known after a look at what moves.

        Args:
            seen: All of it that is in sight.
            time: Of the look [s].
            ahead: What tracked things are taken to do.
        """
        tracked = self.tracked.with_sightings(seen, time)
        moving = self.charted_moving.and_those(ahead(tracked.tracks, time))
        return replace(self, tracked=tracked, moving=moving)

    @property
    def charted_moving(self) -> MovingObstacles:
        """What moves as the map says."""
        return self.moving.first(self.charted)

    @property
    def sensed_moving(self) -> MovingObstacles:
        """What moves and isn't on the map."""
        return self.moving.from_on(self.charted)

    def with_scan(self, scan: Scan, time: float, ahead: Foreseen) -> tuple[Knowledge, News]:
        """What is known after one more scan of a lidar, and what is new about what stands.

        Where things may move, a hit goes to what stands or to what moves, and to one of them alone.

        Args:
            scan: A look round.
            time: When it was taken [s].
            ahead: What tracked things are taken to do.

        Raises:
            AssertionError: When the robot has no lidar.
        """
        assert self.belief is not None
        if self.hits is None:
            belief, news = self.belief.with_scan(scan)
            return replace(self, belief=belief, world=belief.world), news
        hits, standing = self.hits.with_scan(scan, time, self.belief.world)
        belief, news = self.belief.with_scan(scan, standing)
        moving = self.charted_moving.and_those(ahead(hits.tracks, time))
        return replace(self, belief=belief, world=belief.world, hits=hits, moving=moving), news
