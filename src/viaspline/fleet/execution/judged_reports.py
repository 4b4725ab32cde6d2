"""Which reports of robots are believed: a wrong one would let others in where a robot still is.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_run import FleetEvent, FleetEventKind
from viaspline.kernels.arrays import Flags, Floats, Ints

LATE_S = 1e-9
"""So much later than now a report may say it is, for rounding."""
NOISE_M = 0.1
"""By so much a report may be wrong without being refused."""
SURE_S = 1.0
"""Who has said for so long that it is where it can't have driven to is believed: it was pushed."""


@dataclass(frozen=True, eq=False)
class KnownFleet:
    """What reports are judged by.

    Attributes:
        names: The robots, by their numbers.
        lengths: Of their paths [m], (n,).
        fastest: Each one's speed [m/s], (n,).
        progress: How far each has come [m], (n,).
        departs: When each sets out [s], (n,).
        heard: When each was last believed [s]; minus infinity: never, (n,).
        out: Whether a robot isn't listened to any more, (n,).
        paths: Which of its paths each one drives, (n,).
        doubted: When [s] and where [m] each first said to be what it still said when it was last
            refused; infinite: it wasn't since it was believed, (n, 2).
    """

    names: dict[str, int]
    lengths: Floats
    fastest: Floats
    progress: Floats
    departs: Floats
    heard: Floats
    out: Flags
    paths: Ints
    doubted: Floats

    def farthest(self, report: ProgressReport, robot: int, margin: float) -> float:
        """How far a robot can have come by its drive when it reports [m]."""
        since = max(float(self.heard[robot]), float(self.departs[robot]))
        can = float(self.fastest[robot]) * max(report.time - since, 0.0)
        can += 2.0 * margin  # it was farther than it said, and then that was taken off
        return min(float(self.progress[robot]), float(self.lengths[robot])) + can

    def goes_on(self, report: ProgressReport, robot: int, margin: float) -> bool:
        """Whether a robot may have come from where it wasn't believed to be to where it says."""
        when, place = self.doubted[robot].tolist()
        if not when <= report.time < math.inf:
            return False
        noise = NOISE_M + margin
        most = float(self.fastest[robot]) * (report.time - when) + 2.0 * margin + noise
        return bool(-noise <= report.distance - place <= most)

    def insists(self, report: ProgressReport, robot: int, margin: float) -> bool:
        """Whether a robot wasn't believed, and has said the same for so long that it is."""
        is_long = report.time - self.doubted[robot, 0] >= SURE_S
        return bool(is_long and self.goes_on(report, robot, margin))


def judged(
    report: ProgressReport, known: KnownFleet, now: float, margin: float
) -> FleetEvent | None:
    """Why a report isn't believed; None if it is.

    A report from the future, of a place that the robot can't have come to, of no robot of the
    fleet, or without numbers is refused, and an old one is ignored. One of a place that it wasn't
    let to, or farther back than it was, is believed: see ``strayed_robots``. So is a robot that
    goes on saying for ``SURE_S`` that it is where it can't have driven to.

    Args:
        report: Of a robot.
        known: What it is judged by.
        now: The time [s].
        margin: By so much more reports may be wrong [m]: it is taken off all that they say.
    """
    found = _fault(report, known, now, margin)
    if found is None:
        return None
    kind, why = found
    name = str(report.name)
    return FleetEvent(kind, now, name, f"the report of {name} {why}")


def _fault(
    report: ProgressReport, known: KnownFleet, now: float, margin: float
) -> tuple[FleetEventKind, str] | None:
    """What becomes of a report that isn't believed, and why."""
    robot = known.names.get(report.name)
    if robot is None:
        return "refused", "is of no robot of this fleet"
    numbers = (report.time, report.distance, report.speed, report.holds, report.heard)
    if not all(one is None or math.isfinite(one) for one in numbers):
        return "refused", "holds numbers that are not finite"
    if report.time > now + LATE_S:
        return "refused", f"is from the future, of {report.time:.2f} s"
    if known.out[robot]:
        return "ignored", "is of a robot that doesn't drive any more"
    if report.time < known.heard[robot]:
        return "ignored", f"is old, of {report.time:.2f} s"
    if report.path != known.paths[robot]:
        return "ignored", f"is along its path {report.path}, and it drives {known.paths[robot]}"
    noise = NOISE_M + margin
    length, come = float(known.lengths[robot]), float(known.progress[robot])
    come, says = min(come, length), f"says {report.distance:.2f} m"
    if not -noise <= report.distance <= length + noise:
        remedy = "nothing is proven beyond its ends, so have it come back"
        return "refused", f"{says} of a path of {length:.2f} m; {remedy}"
    if report.arrived and report.distance < length - noise:
        return "refused", f"{says} and that it has arrived, which is at {length:.2f} m"
    most = known.farthest(report, robot, margin)
    if report.distance > most + noise and not known.insists(report, robot, margin):
        return "refused", f"{says}, but it can't have come farther than {most:.2f} m"
    if report.distance < come - noise and math.isinf(known.progress[robot]):
        return "ignored", f"{says}, but it has left the world"
    return None
