"""What passes between the robots of a fleet and its navigator.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.handed_in import check_kind, number_from


@dataclass(frozen=True)
class ProgressReport:
    """Where a robot of a fleet says it is.

    Its body is no farther from the place of its path at ``distance`` than the tracking error that
    its plan keeps.

    Attributes:
        name: Of the robot.
        time: When it was there [s].
        distance: How far it has come along its path [m].
        speed: How fast it was then [m/s].
        arrived: Whether it stands at its goal; who leaves the world there has left it.
        holds: How far it takes itself to be let go [m]: the last grant that it has taken up. Only
            who says this and ``heard`` is asked to give a grant back, for another to pass first.
        heard: The time of the newest command that it has heard [s].
        path: Along which of its paths that is: the number in the newest command that it has heard.

    Raises:
        GeometryError: The name is no text, or one of the others no number.
    """

    name: str
    time: float
    distance: float
    speed: float = 0.0
    arrived: bool = False
    holds: float | None = None
    heard: float | None = None
    path: int = 0

    def __post_init__(self) -> None:
        check_kind("name", self.name, str, "give the name of a robot")
        check_kind("path", self.path, int, "give the number of a path, from the command")
        for key in ("time", "distance", "speed", "holds", "heard"):
            value = getattr(self, key)
            if value is not None or key in ("time", "distance", "speed"):
                object.__setattr__(self, key, number_from(key, value))


@dataclass(frozen=True)
class FleetCommand:
    """What a robot of a fleet is to do until it hears more.

    A robot takes up commands in the order of their times: one that is older than one that it has
    heard is worth nothing.

    Attributes:
        name: Of the robot.
        time: Of the step from which it is [s].
        granted: How far it may go along its path [m]; it has to be able to stop before that. A
            grant that is less than the one before is a request: who can't stop before it any more,
            or hasn't heard it, keeps the old one. ``ProgressReport.holds`` says which.
        distance: How far it should be a period from now on [m].
        speed: How fast it should be then [m/s].
        waits_for: For whom it has to stop where its grant ends; None if that is its goal.
        opens_at: How far that one has to come along its own path [m].
        arrived: Whether its drive is over.
        stands_until: When it may go on from the station at which it stands [s]; None: it stands at
            none.
        path: Which of its paths all of that is along: 0 is that of the plan, and each other one
            that it gets counts one more.
    """

    name: str
    time: float
    granted: float
    distance: float
    speed: float
    waits_for: str | None = None
    opens_at: float | None = None
    arrived: bool = False
    stands_until: float | None = None
    path: int = 0
