"""A path in space as it was found: curve, proof, ledger, and where it lies on the route.

Tested through ``space/test_solve_route``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.space.spatial_account import SpatialAccount


@dataclass(frozen=True, eq=False)
class SpatialSolution:
    """What was found.

    Attributes:
        path: The whole curve, upright legs included.
        certificate: The proven clearance of the body on all of it; on an upright leg from or to
            the ground, the ground itself doesn't count.
        account: What stood in the way of each leg, and the ways past it.
        airborne: From where to where on the path it is off the ground legs [m].
    """

    path: Path
    certificate: Certificate
    account: SpatialAccount
    airborne: tuple[float, float]
