"""``fleet.json``: who is served, what is proven, who passes before whom.

Tested through ``report/files/test_fleet_results``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.report.files.json_text import dumps
from viaspline.report.proven_reference import PROVEN_KEY

FRAME: Final = "ENU: x east, y north; headings anticlockwise from x"
SPATIAL_FRAME: Final = "ENU: x east, y north, z up; headings anticlockwise from x"


def fleet_json(plan: FleetPlan, name: str, folders: Mapping[str, str]) -> str:
    """The text of ``fleet.json``.

    Args:
        plan: What was planned.
        name: The fleet's name.
        folders: Of each robot, by its name.
    """
    return dumps(
        {
            "fleet": {
                "name": name,
                "frame": SPATIAL_FRAME if plan.is_spatial else FRAME,
                "robots": len(plan.fleet.members),
                "separation_m": plan.fleet.separation_m,
            },
            **PROVEN_KEY,
            "served": plan.served,
            "robots": [_robot(plan, one, folders) for one in plan.fleet.members],
            "certificate": certificate_of_fleet(plan.certificate),
            **_patrols(plan),
            "precedences": [
                {
                    "first": one.first,
                    "second": one.second,
                    "leaves_at_m": one.leaves_at,
                    "enters_at_m": one.enters_at,
                    "waits_s": one.waits_s,
                }
                for one in plan.precedences
            ],
            "refused": [
                {
                    "name": one.name,
                    "outcome": one.outcome,
                    "reason": one.reason,
                    "remedy": one.remedy,
                    "in_the_way": one.obstacles,
                    "at": one.where,
                }
                for one in plan.not_served
            ],
        }
    )


def _patrols(plan: FleetPlan) -> dict[str, Any]:
    """What never ends; nothing where all do."""
    patrols = plan.patrols
    if patrols is None:
        return {}
    return {
        "patrols": {
            "period_s": patrols.period,
            "repeats_from_s": patrols.repeats_from,
            "planned_until_s": patrols.planned_until,
            "robots": [
                {
                    "name": name,
                    "begins_s": begin,
                    "laps_a_period": patrols.laps[name],
                    "laps_planned": plan.plans[name].mission.route.laps,
                }
                for name, begin in patrols.begins.items()
            ],
        }
    }


def certificate_of_fleet(certificate: FleetCertificate) -> dict[str, Any]:
    """What is proven of the distance between robots; no separation where there are no two."""
    return {
        "separation_m": certificate.separation,
        "required_separation_m": certificate.required,
        "holds": certificate.holds,
        "pair": certificate.pair,
        "at_s": certificate.at_s,
        "at": certificate.at,
        **({} if certificate.repeats is None else _for_ever(*certificate.repeats)),
    }


def _for_ever(begin: float, period: float) -> dict[str, Any]:
    return {"for": "all time", "repeats_from_s": begin, "period_s": period}


def _robot(plan: FleetPlan, member: FleetMember, folders: Mapping[str, str]) -> dict[str, Any]:
    """A robot: where its plan is, and when it drives by the clock of the fleet."""
    asked = {"name": member.name, "priority": member.priority, "rest": member.rest}
    served = plan.plans.get(member.name)
    if served is None:
        return {**asked, "plan": None}
    law, alone = served.trajectory, plan.alone[member.name]
    return {
        **asked,
        "plan": f"{folders[member.name]}/plan.json",
        "length_m": served.path.length,
        "departs_s": law.start_time,
        "arrives_s": law.end_time,
        "alone_s": alone,
        "late_s": max(law.end_time - member.mission.route.depart_s - alone, 0.0),
    }
