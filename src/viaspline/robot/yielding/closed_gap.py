"""What would help a robot in whose way something stands that has moved: how narrow a gap it leaves.

Tested through ``robot/yielding/test_held_up``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.planning.routing.bottleneck import Bottleneck, bottleneck_between
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.spacetime.standing_ghost import standing_ghost
from viaspline.world.world import World


def help_past(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    standing: tuple[int, ...],
) -> str:
    """What would let the robot pass, in words: less clearance, where that helps.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known.
        schedule: What it means to do.
        standing: What has moved and stands in its way now, as in ``knowledge.moving``.
    """
    gap = _gap(task, progress, knowledge, schedule, standing)
    if gap is None:
        return "move it away, or lead the route another way"
    if gap.is_shut:
        return "no way round it is left: move it away"
    x, y = gap.at
    room = f"the widest way on is {gap.width:.2f} m wide, at ({x:.2f}, {y:.2f})"
    if task.mission.robot.footprint is not None:  # how wide that is hangs on how it goes through
        return f"{room}: move it away"
    body = task.requirements.outer_radius + task.requirements.tracking_error
    clearance = math.floor(1e3 * (0.5 * gap.width - body)) / 1e3
    if clearance > 0.0:
        return (
            f"{room}: move it away; robot.clearance_m has to be less than {clearance:.3f} to fit "
            "through"
        )
    return f"{room}, and the robot {2.0 * body:.2f} m: move it away"


def _gap(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    standing: tuple[int, ...],
) -> Bottleneck | None:
    """The narrowest gap of the widest way on to the next point; None if what is kept fits through.

    Where either end has less room than is kept, a gap that has more than that end isn't one.
    """
    now, path = progress.time, schedule.path
    ghosts = [standing_ghost(knowledge.moving, i, "left", (now, now)) for i in standing]
    world: World = knowledge.world.with_obstacles(one[0] for one in ghosts if one is not None)
    here = np.asarray(path.at_distance(min(progress.distance, path.length)))[:2]
    ahead = [via.at for via, _ in vias_after(path, progress.last_via)]
    there = np.asarray(ahead[0] if ahead else path.at_distance(path.length))[:2]
    room = float(world.distance(np.stack((here, there))).min())
    kept = min(task.kept_to_moving, room)
    return bottleneck_between(world, here, there, 2.0 * kept) if kept > 0.0 else None
