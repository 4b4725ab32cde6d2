"""The proof that the robots of a fleet stay apart, over continuous time."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.certificate import PROOF_SLACK_M


@dataclass(frozen=True)
class FleetCertificate:
    """What is proven of the distance between the robots of a fleet.

    Attributes:
        separation: Proven lower bound of the free space between any two bodies at any time [m];
            infinite for a single robot.
        required: The separation that was asked for [m].
        pair: The two robots that are nearest; None where there are no two.
        at_s: When that is [s].
        at: Where the two are then [m]; None where there are no two.
    """

    separation: float
    required: float
    pair: tuple[str, str] | None
    at_s: float
    at: tuple[tuple[float, float], tuple[float, float]] | None

    @property
    def holds(self) -> bool:
        """Whether the proven separation is the one that was asked for, to a micrometre."""
        return self.separation >= self.required - PROOF_SLACK_M
