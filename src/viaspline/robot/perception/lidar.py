"""A simulated lidar: it sees surfaces, and what stands before them hides what is behind."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.errors import GeometryError
from viaspline.handed_in import finite_from, number_from, numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.sensing.raycast import cast
from viaspline.kernels.world.packed import PackedWorld
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.robot.perception.laser_beams import laser_beams
from viaspline.robot.state import RobotState
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.shapes_at import shapes_at
from viaspline.world.world import World

MAX_NOISE_SIGMAS = 3.0
"""No measurement is farther off than so many standard deviations."""


@dataclass(frozen=True, eq=False)
class Scan(ComparedByValue):
    """One look round, in the words of ROS's LaserScan, and from where it was taken.

    Attributes:
        position: Of the sensor [m], shape (2,) or longer.
        heading: Of the sensor, anticlockwise from x [rad].
        angle_min: Direction of the first beam from the heading, anticlockwise [rad].
        angle_increment: From each beam to the next, anticlockwise, above 0 [rad].
        range_max: The length of a beam [m].
        ranges: Distance to what each beam hit [m], shape (beams,), read-only: infinite where there
            was nothing as far as the beam reaches, NaN where nothing was measured.
        stamp: When it was taken, by the clock of the steps [s]; None: now, whenever it is handed
            in. One that is older than 0.2 s stops the robot.

    Raises:
        GeometryError: When a number makes no scan.

    Example:
        >>> scan = Scan((1.0, 2.0), 0.0, -np.pi / 2, np.pi / 2, 9.0, [np.inf, 3.0, np.nan])
        >>> scan.hits, scan.free
        (array([[4., 2.]]), array([9., 3., 0.]))
    """

    position: tuple[float, ...]
    heading: float
    angle_min: float
    angle_increment: float
    range_max: float
    ranges: Floats
    stamp: float | None = None

    @classmethod
    def from_laserscan(
        cls,
        ranges: Sequence[float] | Floats,
        angle_min: float,
        angle_increment: float,
        range_min: float,
        range_max: float,
        pose: RobotState | tuple[float, float, float],
        *,
        mount: tuple[float, float, float] = (0.0, 0.0, 0.0),
        stamp: float | None = None,
        intensities: object = None,
    ) -> Scan:
        """A scan from the fields of ROS's ``sensor_msgs/LaserScan``, as drivers really fill them.

        Beams that tell nothing become NaN: NaN, minus infinity (too near to measure, REP 117), 0
        and all that is below ``range_min`` or above ``range_max``; the robot doesn't take their
        directions for free. Plus infinity is a beam that met nothing. Angles that run clockwise
        are turned round; of beams that go round more than once the last turn counts. Without any
        beam it is a scan that shows nothing, which is as good as none.

        Of a scanner that hangs upside down, negate ``angle_min`` and ``angle_increment``.

        Args:
            ranges: Distances [m], shape (beams,), 0 beams or more.
            angle_min: Direction of the first beam in the scanner's frame, anticlockwise [rad].
            angle_increment: From each beam to the next [rad]; below 0 if they run clockwise.
            range_min: The least distance that is measured [m].
            range_max: The greatest [m].
            pose: Of the robot's reference point when the scan was taken (not now): its x, y [m]
                and heading [rad], or its state.
            mount: Of the scanner on the body: x forward, y left [m], and yaw [rad].
            stamp: When it was taken, by the clock of the steps [s]. None: now.
            intensities: Not looked at.

        Raises:
            GeometryError: When a number makes no scan: shapes, angles or ranges that contradict
                each other, a pose that is not finite.

        Example:
            >>> ranges = [0.0, 2.0, np.inf]  # clockwise from the left, the first too near
            >>> angles, reach, pose = (np.pi / 2, -np.pi / 2), (0.1, 8.0), (1.0, 2.0, 0.0)
            >>> scan = Scan.from_laserscan(ranges, *angles, *reach, pose, mount=(0.25, 0, 0))
            >>> scan.position, scan.ranges, scan.hits
            ((1.25, 2.0), array([inf,  2., nan]), array([[3.25, 2.  ]]))
        """
        del intensities
        beams, first, step = laser_beams(ranges, angle_min, angle_increment, range_min, range_max)
        x, y, heading = _pose_of(pose)
        ahead, left, turned = _three("mount", mount, "(x, y, yaw) of the scanner on the body")
        c, s = math.cos(heading), math.sin(heading)
        place = x + c * ahead - s * left, y + s * ahead + c * left
        reach = number_from("range_max", range_max)
        return cls(place, heading + turned, first, step, reach, beams, stamp)

    def __post_init__(self) -> None:
        ranges = numbers_from("ranges", self.ranges).copy()
        position = tuple(np.atleast_1d(numbers_from("position", self.position)).ravel().tolist())
        object.__setattr__(self, "position", position)
        for name in ("heading", "angle_min", "angle_increment", "range_max"):
            object.__setattr__(self, name, number_from(name, getattr(self, name)))
        if self.stamp is not None:
            object.__setattr__(self, "stamp", finite_from("stamp", self.stamp))
        if ranges.ndim != 1 or not ranges.size:
            raise GeometryError(f"ranges have shape {ranges.shape}; give one for each beam")
        numbers = (*self.position, self.heading, self.angle_min, self.range_max)
        if len(self.position) < 2 or not all(math.isfinite(value) for value in numbers):
            raise GeometryError("a scan needs a finite position, heading, angle_min and range_max")
        if self.range_max <= 0.0:
            raise GeometryError(f"range_max is {self.range_max}; give a length above 0 m")
        if not 0.0 < self.angle_increment * max(ranges.size - 1, 1) <= math.tau + 1e-9:
            raise GeometryError(
                f"angle_increment is {self.angle_increment} for {ranges.size} beams; give an angle "
                "above 0 that makes a full turn at most"
            )
        ranges[ranges >= self.range_max] = np.inf
        ranges[ranges < 0.0] = np.nan
        ranges.flags.writeable = False
        object.__setattr__(self, "ranges", ranges)

    @property
    def first_direction(self) -> float:
        """Direction of the first beam, anticlockwise from x [rad]."""
        return self.heading + self.angle_min

    def has_beams_of(self, other: Scan) -> bool:
        """Whether both have equally many beams, equally far apart."""
        same = self.angle_increment == other.angle_increment
        return same and len(self.ranges) == len(other.ranges)

    @cached_property
    def shows_nothing(self) -> bool:
        """Whether no beam has measured anything, not even that nothing is there."""
        return bool(np.isnan(self.ranges).all())

    @cached_property
    def free(self) -> Floats:
        """How far each beam met nothing [m], shape (beams,)."""
        return np.where(np.isnan(self.ranges), 0.0, np.minimum(self.ranges, self.range_max))

    @cached_property
    def hits(self) -> Floats:
        """Where the beams hit something, in their order [m], shape (k, 2)."""
        beams = np.flatnonzero(np.isfinite(self.ranges))
        angles = self.first_direction + beams * self.angle_increment
        rays = np.column_stack((np.cos(angles), np.sin(angles)))
        return np.asarray(self.ranges[beams, None] * rays + np.asarray(self.position[:2]))


def _pose_of(pose: RobotState | tuple[float, float, float]) -> tuple[float, float, float]:
    if isinstance(pose, RobotState):
        x, y = (finite_from("pose", value) for value in pose.position[:2])
        return x, y, finite_from("pose", pose.heading)
    return _three("pose", pose, "(x, y, heading) of the robot, or its RobotState")


def _three(name: str, values: object, what: str) -> tuple[float, float, float]:
    numbers = numbers_from(name, values)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise GeometryError(f"{name} is {values!r:.60}; give three finite numbers: {what}")
    x, y, turned = numbers.tolist()
    return x, y, turned


class LidarSensor:
    """Measures the distance to the first surface along each beam.

    The beams of a field of view below 360 degrees reach from one edge of it to the other; those of
    a full turn are equally spaced all round, from straight behind on.

    Args:
        obstacles: What there is to see, known to the robot or not.
        spec: Range, field of view, beams and noise.
        seed: For the noise. It is Gaussian, cut off at three standard deviations, and depends on
            nothing but the seed and the number of the scan.
        moving: What moves beside them.

    Example:
        >>> post = Obstacle(circle={"center": (3, 0), "radius": 1})
        >>> sensor = LidarSensor([post], Lidar(range_m=5, fov_deg=180, beams=3))
        >>> sensor.scan((0.0, 0.0), heading=0.0).ranges
        array([inf,  2., inf])
    """

    def __init__(
        self,
        obstacles: Iterable[Obstacle],
        spec: Lidar,
        seed: int = 0,
        moving: MovingObstacles | None = None,
    ) -> None:
        self.spec = spec
        self.seed = seed
        self.moving = MovingObstacles() if moving is None else moving
        self._world = World(obstacles)
        full = spec.fov_deg >= 360.0
        fov = math.radians(spec.fov_deg)
        self._step = fov / spec.beams if full else fov / max(spec.beams - 1, 1)
        self._first = -0.5 * fov if full or spec.beams > 1 else 0.0

    def scan(
        self, position: tuple[float, ...], heading: float, number: int = 0, time: float = 0.0
    ) -> Scan:
        """What is measured at a place [m] with a heading [rad].

        Args:
            position: Of the sensor, which is the robot's centre [m], shape (2,) or longer.
            heading: Of the robot, anticlockwise from x [rad].
            number: Of the scan; scans with the same number have the same noise.
            time: When it is taken, by the clock of what moves [s].
        """
        spec = self.spec
        ranges = self._cast(self._world.packed, position, heading)
        if len(self.moving):
            shapes = shapes_at(self.moving, time)
            ranges = np.minimum(ranges, self._cast(shapes, position, heading))
        if spec.noise_m > 0.0:
            noise = np.random.default_rng((self.seed, number)).standard_normal(spec.beams)
            ranges += spec.noise_m * np.clip(noise, -MAX_NOISE_SIGMAS, MAX_NOISE_SIGMAS)
            np.maximum(ranges, 0.0, out=ranges)
        return Scan(
            tuple(position), heading, self._first, self._step, spec.range_m, np.asarray(ranges)
        )

    def _cast(self, shapes: PackedWorld, position: tuple[float, ...], heading: float) -> Floats:
        """Distance to the first surface along each beam, without noise [m], (beams,)."""
        spec = self.spec
        return cast(
            shapes, float(position[0]), float(position[1]), heading + self._first,
            self._step, spec.beams, spec.range_m,
        )  # fmt: skip
