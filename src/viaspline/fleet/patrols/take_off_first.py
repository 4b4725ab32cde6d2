"""Patrols that take off once, and then fly their laps from where that ends, again and again.

A lap begins and ends hovering at the top of the take-off; the robot is on the ground before it.

Tested through ``fleet/patrols/test_patrols_that_take_off``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.patrols.driven_laps import law_of_flown_laps
from viaspline.fleet.patrols.repeated_laws import laws_in_a_row
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.route_spec import EndPoint
from viaspline.space.route_law import headings_of
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.static_plan import fastest_law
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.trajectory import Trajectory


def takes_off(plan: AnyPlan) -> bool:
    """Whether the first span of a plan's path is a take-off."""
    return isinstance(plan, SpatialPlan) and plan.mission.route.takeoff is not None


def spans_before_laps(plan: AnyPlan) -> int:
    """How many spans of a patrol's path it flies once, before its first lap."""
    return int(takes_off(plan))


def lap_of(plan: AnyPlan) -> AnyPlan:
    """One lap of a patrol, without what it flies before the first one.

    Args:
        plan: As it is laid: with the take-off, if it has one.
    """
    if not (isinstance(plan, SpatialPlan) and takes_off(plan)):
        return plan
    path = _of_laps(plan.path)
    route, up = plan.mission.route, ascent_of(plan).trajectory.duration
    start = EndPoint.model_validate(
        {**route.start.model_dump(exclude_unset=True, exclude={"agl_m"}), "at": path.vias[0].at}
    )
    asked = {"start": start, "takeoff": None, "depart_s": route.depart_s + up}
    mission = plan.mission.model_copy(update={"route": route.model_copy(update=asked)})
    problem = spatial_problem_of(mission)
    yaw = headings_of(problem, path)
    law = fastest_law(problem, path, yaw, mission.route.depart_s)
    return replace(
        plan, mission=mission, path=path, airborne=(0.0, path.length), yaw=yaw, trajectory=law
    )


def _of_laps(path: Path) -> Path:
    """A path without the take-off that it begins with."""
    ground, top, *points = path.vias
    begins = replace(top, name=ground.name, u=0.0, index=ground.index)
    return Path(path.spans[1:], [begins, *(replace(via, u=via.u - 1.0) for via in points)])


def flown_headings_on_laps(problem: SpatialProblem, path: Path) -> YawProfile:
    """Where the body of a patrol looks along its path.

    Args:
        problem: With so many laps.
        path: All of them, and what it flies before the first one.
    """
    if problem.takeoff is None:
        return headings_of(problem, path)
    laps = _of_laps(path)
    up = float(path.distance(1.0))
    return after_upright(headings_of(replace(problem, takeoff=None), laps), up)


def law_of_patrol_in_space(plan: SpatialPlan) -> Trajectory:
    """The law of a patrol in space that is alone: its laps, behind what it flies before the first.

    Both are timed each by itself, as they are planned.

    Args:
        plan: With whatever law.
    """
    problem = replace(spatial_problem_of(plan.mission), takeoff=None)
    rises = takes_off(plan)
    path = _of_laps(plan.path) if rises else plan.path
    law = law_of_flown_laps(path, problem, plan.limits, headings_of(problem, path))
    if not rises:
        return law.delayed(plan.mission.route.depart_s - law.start_time)
    return _behind(ascent_of(plan).trajectory, law, plan.airborne[0])


def _behind(ascent: Trajectory, laps: Trajectory, up: float) -> Trajectory:
    """The law of laps right behind that of an ascent [m]."""
    return laws_in_a_row([ascent, laps.moved(up).delayed(ascent.end_time - laps.start_time)])


def on_its_laps(member: FleetMember, lap: AnyPlan) -> FleetMember:
    """A patrol as one that begins where its laps do, once it may be there."""
    if not isinstance(lap, SpatialPlan):
        return member
    depart = lap.mission.route.depart_s
    if depart == member.mission.route.depart_s:
        return member
    route = member.mission.route.model_copy(update={"depart_s": depart})
    return replace(member, mission=member.mission.model_copy(update={"route": route}))


def ascent_of(plan: SpatialPlan) -> SpatialPlan:
    """What a patrol flies before its first lap, from rest to rest.

    Args:
        plan: As it is laid: with the take-off.
    """
    path = Path(plan.path.spans[:1], plan.path.vias[:2])
    heading = float(plan.yaw.at(plan.airborne[0]))
    yaw = YawProfile(np.array([0.0, path.length]), np.full(2, heading))
    law = retime_in_space(
        path, plan.limits, (), yaw, zones=plan.mission.world.speed_zones,
        start_time=plan.mission.route.depart_s,
    )  # fmt: skip
    return replace(plan, path=path, airborne=(path.length, path.length), trajectory=law)


def after_ascent(laid: SpatialPlan, laps: SpatialPlan) -> SpatialPlan:
    """A patrol's plan of its take-off and several laps; it hovers between these, at the top.

    Args:
        laid: As it is laid: with the take-off and one lap.
        laps: Several laps without it.
    """
    up = laid.airborne[0]
    ground, top = laid.path.vias[:2]
    later = [replace(via, u=via.u + 1.0) for via in laps.path.vias[1:]]
    path = Path(np.concatenate([laid.path.spans[:1], laps.path.spans]), [ground, top, *later])
    route = laid.mission.route.model_copy(update={"laps": laps.mission.route.laps})
    law = _behind(ascent_of(laid).trajectory, laps.trajectory, up)
    return replace(
        laps,
        mission=laid.mission.model_copy(update={"route": route}),
        path=path,
        airborne=(up, path.length),
        yaw=after_upright(laps.yaw, up),
        trajectory=law,
    )


def after_upright(yaw: YawProfile, up: float) -> YawProfile:
    """Headings behind an upright leg [m], on which the body looks as it does at its top."""
    return YawProfile(
        np.concatenate(([0.0], yaw.distances + up)),
        np.concatenate((yaw.headings[:1], yaw.headings)),
    )
