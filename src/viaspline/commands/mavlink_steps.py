"""What ``viaspline drive --mavlink`` does.

Tested through ``commands/test_drive_command``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

import click

from viaspline.commands.command_steps import load_asked, progress_bar, watched_plan
from viaspline.commands.link_options import talking_to, telling
from viaspline.errors import LinkError
from viaspline.exit_codes import NOT_REACHED
from viaspline.report.proven_reference import with_meaning
from viaspline.report.terminal.interrupts import undone_at_the_end
from viaspline.report.terminal.terminal_lines import say, say_error

if TYPE_CHECKING:
    from viaspline.formats.local_frame import LocalFrame
    from viaspline.links.mavlink.pilot import Pilot
    from viaspline.links.mavlink.telemetry import Telemetry
    from viaspline.links.mavlink.vehicle import Vehicle
    from viaspline.links.mavlink.vehicle_drive import VehicleDrive
    from viaspline.links.mavlink.vehicle_state import VehicleState
    from viaspline.mission.model import Mission

OPEN_LOOP: Final = (
    "the mission says nothing of robot.drive: nothing is kept free for how far a vehicle is off "
    "its path; beyond what is proven clear it is stopped"
)


class MavlinkLink(NamedTuple):
    """How a vehicle is spoken to.

    Attributes:
        address: Of the link.
        system: Which vehicle; None: the only one.
        origin: Where the mission's 0, 0 is, as somebody says it.
        arms: Whether it is to be armed.
        from_here: Whether the path begins where it stands.
        patience: How long it is waited for [s].
    """

    address: str
    system: int | None
    origin: str | None
    arms: bool
    from_here: bool
    patience: float


def drive_over_mavlink(file: Path, link: MavlinkLink, *, quiet: bool) -> None:
    """Drive a mission with a vehicle, and say what came of it.

    Args:
        file: The mission.
        link: To the vehicle.
        quiet: Say nothing when all goes well.
    """
    from viaspline.formats.local_frame import LocalFrame
    from viaspline.links.mavlink.geographic_origin import mission_origin, origin_note

    frame = LocalFrame(*mission_origin(file, link.origin))
    if (note := origin_note(file, link.origin)) and not quiet:
        say(f"note: {note}")
    mission = _mission(file)
    pilot = None if link.from_here else _pilot(mission, quiet)
    if not quiet and mission.robot.drive is None and not mission.is_spatial:
        say(*with_meaning(f"note: {OPEN_LOOP}"))
    if not quiet and mission.robot.sensor is not None:
        say("note: MAVLink brings nothing that is sensed: only what is on the map is kept clear of")
    tell = telling(quiet)
    with talking_to(link.address) as talk:
        from viaspline.links.mavlink.vehicle_runner import VehicleRunner, prepared

        tell(f"waiting for an autopilot on {talk.name} …")
        vehicle, _ = talk.find(link.system, link.patience)
        _check_kind(talk.name, vehicle, mission)
        if pilot is None:
            telemetry = prepared(talk, vehicle, link.patience, tell)
            from viaspline.links.mavlink.vehicle_state import vehicle_state

            here = vehicle_state(telemetry, frame, talk.now())
            pilot = _pilot(_from(mission, here), quiet)
        telemetry = prepared(talk, vehicle, link.patience, tell)
        drive = _drive(talk.name, vehicle, pilot, frame, link, telemetry, talk.now)
        runner = VehicleRunner(talk, drive, tell)
        with undone_at_the_end(runner.stop_at_once):
            ended = runner.run()
    if ended.reached:
        if not quiet:
            say(f"{vehicle}: {ended.words}; {_figures(runner.drive)}")
        return
    say_error(*with_meaning(f"{vehicle}: {ended.words}"), f"  {_figures(runner.drive)}")
    click.get_current_context().exit(NOT_REACHED)


def _mission(file: Path) -> Mission:
    from viaspline.links.mavlink.planar_pilot import check_drivable
    from viaspline.mission.model import Mission

    mission = load_asked(file)
    if not isinstance(mission, Mission):
        raise click.UsageError("a vehicle drives the mission of one robot; this is a fleet")
    if not mission.is_spatial:
        check_drivable(mission, str(file))
    return mission


def _pilot(mission: Mission, quiet: bool) -> Pilot:
    """Who leads a vehicle along a mission, planned and compiled before anything moves."""
    with progress_bar(quiet, mission, drives=True) as watch:
        pilot: Pilot
        if mission.is_spatial:
            with watch.stage("plan", "planning"):
                from viaspline.links.mavlink.flight_pilot import FlightPilot
                from viaspline.robot.warmed import warm_up
                from viaspline.space.plan_spatial import plan_spatial

                warm_up(mission, None)  # nothing is to be compiled while the vehicle moves
                pilot = FlightPilot(plan_spatial(mission))
        else:
            plan = watched_plan(mission, watch)
            with watch.stage("steer", "getting ready to steer"):
                from viaspline.links.mavlink.planar_pilot import PlanarPilot
                from viaspline.robot.navigator import Navigator

                pilot = PlanarPilot(Navigator(plan.mission, plan))
    return pilot


def _from(mission: Mission, here: VehicleState) -> Mission:
    """The mission from where the vehicle stands."""
    from viaspline.mission.route_spec import EndPoint

    start = EndPoint(at=(here.x, here.y), heading_deg=math.degrees(here.heading))
    route = mission.route.model_copy(update={"start": start})
    return mission.model_copy(update={"route": route})


def _check_kind(link: str, vehicle: Vehicle, mission: Mission) -> None:
    """Refuse vehicles that can't be driven, or not on this mission.

    Raises:
        LinkError: It is one.
    """
    if vehicle.modes is None:
        problem = f"{vehicle} isn't one that is known how to drive"
        raise LinkError(link, problem, "rovers, boats and copters of ArduPilot and PX4 are")
    if mission.is_spatial and not vehicle.is_copter:
        raise LinkError(
            link, f"{vehicle} can't fly, and the mission is one in space", "take a copter"
        )


def _drive(
    name: str, vehicle: Vehicle, pilot: Pilot, frame: LocalFrame, link: MavlinkLink,
    telemetry: Telemetry, now: Callable[[], float],
) -> VehicleDrive:  # fmt: skip
    """The drive at its beginning.

    Raises:
        LinkError: The vehicle isn't where the path begins, or stands where it should fly.
    """
    from viaspline.links.mavlink.drive_orders import DriveOrders
    from viaspline.links.mavlink.vehicle_drive import VehicleDrive
    from viaspline.links.mavlink.vehicle_state import vehicle_state

    here = vehicle_state(telemetry, frame, now())
    far = pilot.too_far(here)
    if far is not None:
        remedy = (
            "drive it there, or give --from-here" if pilot.takeoff_m is None else "carry it there"
        )
        raise LinkError(name, f"{vehicle}: {far}", remedy)
    modes = vehicle.modes
    assert modes is not None
    orders = DriveOrders(link.arms, link.patience)
    return VehicleDrive(vehicle, modes, pilot, frame, orders, telemetry)


def _figures(drive: VehicleDrive) -> str:
    return (
        f"{drive.time:.1f} s led, at most {drive.farthest:.2f} m off its path, "
        f"{drive.pilot.allowed_m:.2f} m allowed"
    )
