"""What a tracker takes for granted about things that move.

Tested through ``robot/perception/moving/test_track_hits``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.tracks.followed import WANDER


@dataclass(frozen=True)
class TrackingPremises:
    """What a tracker takes for granted.

    Attributes:
        top_speed: Nothing is faster [m/s].
        wander: By how much a velocity changes in a second, in standard deviations
            [m/s per square root of s].
        noise: Standard deviation of the distance that a lidar's beam measures [m].
        settle_s: What hasn't moved for so long since it was first seen stands [s].
        doubt_s: What seems to move but is where it was for so long stands [s]: a wall of which ever
            more comes into sight.
        rest_s: What has moved stands again when it hasn't for so long [s].
        forget_s: What hasn't been seen for so long is forgotten [s].
        lost_m: So is that whose place is as uncertain as this, in standard deviations [m].
        longest_m: What is longer than this when it first comes into sight stands [m].
    """

    top_speed: float
    wander: float = WANDER
    noise: float = 0.0
    settle_s: float = 0.8
    doubt_s: float = 2.0
    rest_s: float = 4.0
    forget_s: float = 2.0
    lost_m: float = 1.0
    longest_m: float = 4.0
