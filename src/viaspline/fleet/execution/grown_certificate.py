"""The proof of a plan with one robot more: what is proven of the others holds as it did.

Their paths and laws are the very same, so only those are looked at whom the newcomer could come
nearer than the others come to each other.

Tested through ``fleet/execution/test_changed_plans``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.robots_at_home import certify_all
from viaspline.kernels.fleet.neighbouring import mark_neighbours
from viaspline.mission.fleet.fleet import Fleet


def grown_certificate(
    before: FleetPlan, fleet: Fleet, grown: DrivenFleet, robot: int
) -> FleetCertificate:
    """Prove how far apart all robots stay where one of them has a new path.

    Args:
        before: The plan without that path; all others drive as they do there.
        fleet: What is asked for.
        grown: With that path and its law.
        robot: Whose it is.
    """
    known, courses = before.certificate, grown.courses
    if courses.bodies is not None or known.pair is None or courses.names[robot] in known.pair:
        return certify_all(fleet, courses, grown.laws)
    beyond = max(known.separation - known.required, 0.0)
    is_near = np.ones(len(courses.names), np.bool_)
    wider = courses.packed._replace(reach=courses.packed.reach + beyond)
    mark_neighbours(wider, np.array([robot]), is_near)
    laws = grown.laws.packed
    near = FleetLaws(laws._replace(is_timed=laws.is_timed & is_near))
    found = certify_all(fleet, courses, near)
    return replace(known, repeats=None) if known.separation <= found.separation else found
