"""Is the robot's footprint a body about its reference point?"""

from __future__ import annotations

from viaspline.mission.fields import Corners
from viaspline.mission.shapes.polygon import Polygon
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number

FOOTPRINT_PATH: Path = ("robot", "footprint")


def footprint_fault(corners: Corners) -> UnplacedFault | None:
    """Why corners [m] are no body about the reference point (0, 0), or None.

    >>> footprint_fault([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    >>> print(footprint_fault([(1, -1), (3, -1), (3, 1), (1, 1)]).problem)
    the body does not contain its reference point (0, 0), which lies 1 m outside
    """
    if len(corners) < 3:
        problem = f"the body has {len(corners)} corners, which enclose nothing"
        return UnplacedFault(
            FOOTPRINT_PATH, problem, "give three or more, [[x, y], [x, y], [x, y]]"
        )
    unsound = Polygon.faults([(FOOTPRINT_PATH, Polygon(corners))])
    if unsound:
        return unsound[0]
    import shapely

    body, origin = shapely.Polygon(corners), shapely.Point(0.0, 0.0)
    if body.contains(origin):
        return None
    gap = body.distance(origin)
    where = "lies on its edge" if gap == 0.0 else f"lies {number(gap)} m outside"
    centre = body.centroid if body.contains(body.centroid) else body.representative_point()
    dx, dy = -round(centre.x, 3), -round(centre.y, 3)
    shifted = ", ".join(f"[{number(x + dx)}, {number(y + dy)}]" for x, y in corners)
    return UnplacedFault(
        FOOTPRINT_PATH,
        f"the body does not contain its reference point (0, 0), which {where}",
        "the point that follows the path is the origin of the corners, x forward and y left: "
        f"shift it so that it lies inside, e.g. [{shifted}]",
    )
