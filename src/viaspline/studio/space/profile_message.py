"""The unrolled elevation of a plan: ground, altitude band and what stands near, by the distance.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import shapely

from viaspline.kernels.arrays import Flags, Floats
from viaspline.report.space.elevation_profile import BESIDE_M, silhouette
from viaspline.report.space.spatial_picture import scene_of
from viaspline.report.space.spatial_scene import SpatialScene
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.studio.page_numbers import rounded

PROFILE_SAMPLES: Final = 320
MAX_NEAR_TOLD: Final = 80


def elevation_profile(plan: SpatialPlan, revision: int) -> dict[str, Any]:
    """What is under, over and beside a path, at even distances along it.

    Args:
        plan: What was planned.
        revision: What the page calls it.
    """
    distances = np.linspace(0.0, plan.path.length, PROFILE_SAMPLES)
    places = plan.path.at_distance(distances)
    scene = scene_of(plan)
    ground = scene.ground(places[:, :2])
    lowest, highest, above_least, above_most = plan.world.band.numbers
    return {
        "type": "profile",
        "rev": revision,
        "distances": rounded(distances, 3),
        "ground": _known(ground),
        "low": _known(np.fmax(np.full(len(ground), lowest), ground + above_least)),
        "high": _known(np.fmin(np.full(len(ground), highest), ground + above_most)),
        "beside": BESIDE_M,
        "near": _near(scene, places, plan.mission.robot.radius_m),
    }


def _near(scene: SpatialScene, places: Floats, radius: float) -> list[dict[str, Any]]:
    """The silhouettes of what stands near, each from the sample where it begins."""
    if not len(scene.solids):
        return []
    reach = shapely.LineString(places[:, :2]).buffer(BESIDE_M)
    shapely.prepare(reach)
    found = []
    for k in np.flatnonzero(shapely.intersects(reach, scene.shadows)).tolist():
        seen = silhouette(scene.solids[k], places, radius)
        known = np.isfinite(seen.low)
        for first, end in _runs(known):
            found.append({
                "name": scene.solids[k].name,
                "first": first,
                "low": rounded(seen.low[first:end], 2),
                "high": rounded(seen.high[first:end], 2),
                "meets": seen.meets[first:end].astype(int).tolist(),
            })  # fmt: skip
        if len(found) >= MAX_NEAR_TOLD:
            break
    return found


def _runs(mask: Flags) -> list[tuple[int, int]]:
    """From where to where a mask is true, without the ends.

    >>> _runs(np.array([False, True, True, False, True]))
    [(1, 3), (4, 5)]
    """
    edges = np.diff(np.pad(mask.astype(np.int8), 1))
    starts, ends = np.flatnonzero(edges > 0), np.flatnonzero(edges < 0)
    return list(zip(starts.tolist(), ends.tolist(), strict=True))


def _known(heights: Floats) -> list[float | None]:
    return [z if np.isfinite(z) else None for z in np.round(heights, 3).tolist()]
