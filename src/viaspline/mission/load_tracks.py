"""Recorded motions as obstacles: one moving disc for each id.

Tested through ``mission/test_tracks``.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path as FilePath

from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.tracks_file import read_tracks
from viaspline.mission.tracks_spec import TracksSpec


def moving_discs(
    spec: TracksSpec, folder: FilePath, free_name: Callable[[str], str]
) -> list[Obstacle]:
    """The discs of a file of tracks.

    Args:
        spec: What the mission says of it.
        folder: Where its file is looked for.
        free_name: A name that no other obstacle has, from one that it may have.

    Raises:
        MissionError: The file can't be read or makes no sense.
    """
    disc = Circle(center=(0.0, 0.0), radius=spec.radius_m)
    discs = []
    for track, rows in read_tracks(folder / spec.tracks).items():
        name = free_name(track if spec.name is None else f"{spec.name} {track}")
        after = spec.after or "stay"
        before = None if after in ("loop", "bounce") else "absent"
        motion = Motion(keyframes=tuple(rows), after=after, before=before, error=spec.error)
        discs.append(Obstacle(circle=disc, name=name, motion=motion))
    return discs
