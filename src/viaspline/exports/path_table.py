"""A proven path as formats write it: corners with all that goes along with them.

Tested through ``exports/test_export_path``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.exports.clear_polyline import EXPORT_SLACK_M
from viaspline.formats.items import LatLon
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.report.proven_reference import PROVEN_WORDS
from viaspline.report.units import down

DIGITS_DEG = 10
"""Of latitudes and longitudes: a hundredth of a millimetre."""

DIGITS_M = 7
"""Of places in metres."""

NOTHING = "with nothing known to keep clear of"


@dataclass(frozen=True)
class ExportProof:
    """What is proven of a path as it is exported.

    Attributes:
        clearance: A lower bound of the distance between the body and everything known that stands
            still [m], of the points as the file has them; infinite if there is nothing.
        required: What was asked for [m].
        at: Where it is tightest [m].
        nearest: What is nearest there; None if there is nothing.
        chord_error: A bound of the distance between the points' lines and the exact curve [m].
        acceptance: How near to a point a vehicle may turn to the next one, which is proven as well
            [m]; None where the format's readers don't drive from point to point.
    """

    clearance: float
    required: float
    at: tuple[float, ...]
    nearest: str | None
    chord_error: float
    acceptance: float | None

    @property
    def is_kept(self) -> bool:
        """Whether it is clear as it was asked for, but for the last digits of a file."""
        return self.clearance >= self.required - EXPORT_SLACK_M


@dataclass(frozen=True, eq=False)
class PathTable:
    """The corners of a path that is exported, and what of the plan goes along.

    Attributes:
        name: What it is called.
        mission: What was asked for.
        points: The corners [m], shape (n, 2) or (n, 3), rounded as they are written.
        distances: Of the places of the exact curve that they stand for, along it [m], (n,).
        headings: Of the body there [rad], anticlockwise from x, (n,).
        names: Of the corners that are via points of the mission; None for the others.
        dwells: How long the robot stays there [s], (n,).
        times: When it arrives there [s], (n,).
        speeds: How fast it is there [m/s], (n,).
        line_speeds: What a vehicle is told to drive from each corner to the next [m/s], (n - 1,).
        airborne: The corners where it has taken off and where it begins to come down; None for a
            mission that isn't flown.
        origin: Latitude and longitude of 0, 0 [deg], if they are known.
        geodetic: Latitudes and longitudes of the corners [deg], shape (n, 2), if they are known.
        home: The height that altitudes above home count from [m].
        looks_elsewhere: Whether headings are other than along the path.
        spans: The exact curve: Bézier control polygons [m], shape (m, 4, d).
        proof: What is proven of it.
        lost: What of the plan the format can't carry, a thing a line.
        notes: What has to be known to drive it, a thing a line.
    """

    name: str
    mission: Mission
    points: Floats
    distances: Floats
    headings: Floats
    names: tuple[str | None, ...]
    dwells: Floats
    times: Floats
    speeds: Floats
    line_speeds: Floats
    airborne: tuple[int, int] | None
    origin: LatLon | None
    geodetic: Floats | None
    home: float
    looks_elsewhere: bool
    spans: Floats
    proof: ExportProof
    lost: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def has_heights(self) -> bool:
        """Whether the corners have heights."""
        return bool(self.points.shape[1] == 3)

    @property
    def heights(self) -> Floats:
        """Heights as the mission counts them [m], shape (n,); 0 where it counts none."""
        return self.points[:, 2] if self.has_heights else np.zeros(len(self.points))

    @property
    def places(self) -> Floats:
        """Latitudes and longitudes [deg], shape (n, 2), of a format that has them."""
        assert self.geodetic is not None  # such formats are not written without an origin
        return self.geodetic

    def remarks(self) -> list[str]:
        """What is proven, what isn't carried, and what has to be known, in lines."""
        lost = (f"not carried: {words}" for words in self.lost)
        notes = (f"note: {words}" for words in self.notes)
        return [self.proof_words(), PROVEN_WORDS, *lost, *notes]

    def proof_words(self) -> str:
        """What is proven, in a sentence."""
        proof = self.proof
        known = proof.required if proof.is_kept else proof.clearance
        clear = down(max(proof.clearance, known))
        clear = f"proven {clear} clear" if np.isfinite(proof.clearance) else NOTHING
        near = f"at most {np.ceil(1e3 * proof.chord_error) / 1e3:.3f} m beside the exact curve"
        near = "on the exact curve" if proof.chord_error < 1e-6 else near
        cuts = (
            f", for vehicles that turn {proof.acceptance:g} m before a point or later"
            if proof.acceptance is not None
            else ""
        )
        return f"{len(self.points)} points, {near}, {clear}{cuts}"
