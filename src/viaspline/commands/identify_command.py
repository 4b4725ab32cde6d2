"""``viaspline identify``: the drive of a robot, fitted to a log of one, as keys to paste."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from viaspline.bounded_file import is_folder
from viaspline.report.terminal.terminal_lines import say, say_error

if TYPE_CHECKING:
    from viaspline.identify.drive_log import DriveLog
    from viaspline.mission.robot_parts import RobotSpec

BAGS = (".mcap", ".db3")
ABOVE_0 = click.FloatRange(min=0.0, max=1e4, min_open=True)

TRACK_M = 0.5
"""Between the wheels of a robot of which nothing else is said [m]."""


@click.command()
@click.argument("log", type=click.Path(path_type=Path), required=False)
@click.option("--out", "-o", type=click.Path(path_type=Path), metavar="FILE",
              help="Write the keys to a file instead.")  # fmt: skip
@click.option(
    "--track",
    type=ABOVE_0,
    metavar="METRES",
    help=f"Distance between the wheels, which no log shows.  [default: {TRACK_M:g}]",
)
@click.option(
    "--wheelbase",
    type=ABOVE_0,
    metavar="METRES",
    help="Rear axle to front axle, of a robot whose front wheels steer.",
)
@click.option("--odometry", metavar="TOPIC", help="Of a ROS 2 log that has several.")
@click.option("--commands", metavar="TOPIC", help="Likewise: the cmd_vel that the robot followed.")
@click.option("--drive", "drive", type=click.Path(path_type=Path), metavar="OUT",
              help="Write the commands of a drive that shows enough, and fit nothing.")  # fmt: skip
@click.option("--max-speed", type=ABOVE_0, metavar="MPS",
              help="With --drive: top speed.  [default: 1]")  # fmt: skip
@click.option("--max-yaw-rate", type=ABOVE_0, metavar="RADPS",
              help="With --drive: top yaw rate.  [default: 0.8]")  # fmt: skip
@click.option(
    "--turn-radius",
    type=ABOVE_0,
    metavar="METRES",
    help="With --drive: the tightest circle of a robot that steers.",
)
@click.option("--period", type=ABOVE_0, metavar="SECONDS",
              help="With --drive: between commands.  [default: 0.05]")  # fmt: skip
@click.option("--on", "mission", type=click.Path(path_type=Path), metavar="MISSION",
              help="With --drive: drive a mission's simulated robot; OUT is its log.")  # fmt: skip
@click.option("--seed", type=click.IntRange(min=0), metavar="N",
              help="With --on: seed of its noise.  [default: 0]")  # fmt: skip
def identify(
    log: Path | None, out: Path | None, track: float | None, wheelbase: float | None,
    odometry: str | None, commands: str | None, drive: Path | None, max_speed: float | None,
    max_yaw_rate: float | None, turn_radius: float | None, period: float | None,
    mission: Path | None, seed: int | None,
) -> None:  # fmt: skip
    """Fit a robot's drive to a log: its delay, lag and limits.

    LOG is a CSV file with the columns time_s, x_m, y_m, heading_rad (or heading_deg),
    speed_command_mps and yaw_rate_command_radps, where a command holds from its row to the next; or
    a ROS 2 log with odometry and cmd_vel (.mcap, .db3, a folder of rosbag2). Prints robot.drive and
    the keys beside it, each with its spread, to paste into a mission.

    \b
    Examples:
      viaspline identify --drive commands.csv --max-speed 1.5     what the robot is to drive
      viaspline identify drive.csv --track 0.42                   what its log shows
      viaspline identify drive.mcap --track 0.42
      viaspline identify --drive commands.csv --max-speed 2 --turn-radius 3.5    of a car
      viaspline identify drive.csv --wheelbase 1.2
      viaspline identify --drive log.csv --on examples/depot-cart.yaml    in simulation
    """  # noqa: D301  (click looks for the character, not for a backslash)
    if drive is not None:
        if any(value is not None for value in (log, out, track, wheelbase, odometry, commands)):
            raise click.UsageError("give LOG to fit it, or --drive to write commands, not both")
        _write_commands(
            drive, max_speed or 1.0, max_yaw_rate or 0.8, turn_radius, period or 0.05, mission, seed
        )
        return
    asked = (max_speed, max_yaw_rate, turn_radius, period, mission, seed)
    if any(value is not None for value in asked):
        raise click.UsageError(
            "--max-speed, --max-yaw-rate, --turn-radius, --period, --on and --seed go with --drive"
        )
    if track is not None and wheelbase is not None:
        raise click.UsageError("give --wheelbase for a robot that steers, or --track, not both")
    if log is None:
        raise click.UsageError("give the LOG of a drive, or --drive OUT for one that shows enough")
    from viaspline.formats.whole_file import write_whole
    from viaspline.identify.fit_drive import fit_drive
    from viaspline.identify.identified_drive import drive_block

    found = fit_drive(_read(log, odometry, commands), wheelbase=wheelbase or 0.0)
    keys = drive_block(found, TRACK_M if track is None else track)
    block = f"# fitted to {found.seconds:.0f} s of {log.name}\n{keys}"
    if out is None:
        say(block.rstrip("\n"))
    else:
        write_whole(out, block)
        say(f"delay {found.delay} s, lag {found.lag} s", f"wrote {out}")


def _read(log: Path, odometry: str | None, commands: str | None) -> DriveLog:
    """A log in any of the formats that are understood; of a bag by these topics."""
    if is_folder(log) or log.suffix.lower() in BAGS:
        from viaspline.bags.read_drive import read_drive
        from viaspline.identify.merged_log import merged_log

        found = read_drive(log, odometry=odometry, commands=commands)
        if found.damage is not None:
            words = f"{log} is cut short ({found.damage}); fitted is what is whole"
            say_error(words, prefix="note: ")
        return merged_log(found.times, found.poses, found.command_times, found.commands[:, [0, 2]])
    if odometry is not None or commands is not None:
        raise click.UsageError("--odometry and --commands are for logs of ROS 2; this is a table")
    from viaspline.identify.drive_log import read_drive_csv

    return read_drive_csv(log)


def _write_commands(
    out: Path, max_speed: float, max_yaw_rate: float, turn_radius: float | None, period: float,
    mission: Path | None, seed: int | None,
) -> None:  # fmt: skip
    from viaspline.formats.whole_file import write_whole
    from viaspline.identify.standard_drive import commands_csv, room_of, standard_commands

    robot = None if mission is None else _robot_of(mission)
    if turn_radius is None:
        turn_radius = 0.0 if robot is None else robot.turn_radius or 0.0
    commands = standard_commands(max_speed, max_yaw_rate, period, turn_radius)
    seconds = f"{commands[-1, 0] + period:.0f} s at up to {max_speed:g} m/s"
    if robot is not None:
        from viaspline.identify.drive_log import drive_csv
        from viaspline.identify.simulated_log import simulated_log

        simulated = simulated_log(robot, commands, seed or 0)
        write_whole(out, drive_csv(simulated))
        say(f"wrote {out}: the log of {seconds}, simulated")
        return
    if seed is not None:
        raise click.UsageError("--seed goes with --on: commands are not random")
    ahead, behind, left, right = room_of(commands)
    write_whole(out, commands_csv(commands))
    say(
        f"wrote {out}: commands of {seconds}, one every {period:g} s",
        f"it takes {ahead:.1f} m ahead, {behind:.1f} m behind, {left:.1f} m to the left and "
        f"{right:.1f} m to the right of a robot that does as it is told; leave it twice that",
    )


def _robot_of(path: Path) -> RobotSpec:
    from viaspline.commands.command_steps import load_asked
    from viaspline.mission.model import Mission

    asked = load_asked(path)
    if not isinstance(asked, Mission):
        raise click.UsageError("the drive of one robot is identified; this is a fleet")
    if asked.robot.held_heading is not None:
        raise click.UsageError("this robot keeps its heading: it has no yaw rate to identify")
    return asked.robot
