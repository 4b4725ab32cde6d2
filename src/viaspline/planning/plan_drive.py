"""The path of a whole drive: through the via points or along a corridor, lap after lap."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.strip import has_line
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.roomy_path import find_roomy_path
from viaspline.world.world import World


def find_drive(mission: Mission, world: World, requirements: Requirements) -> Solution:
    """A proven path for all that a mission asks for.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    if has_line(mission.route):
        from viaspline.planning.corridor.corridor_planner import (
            find_line,  # scipy's splines take their time
        )

        found = find_line(mission, world, requirements)
    else:
        found = find_roomy_path(via_sequence_of(mission), world, requirements)
    account = found.account.kept if isinstance(found.account, Account) else found.account
    return replace(found, path=repeated(found.path, mission.route.laps), account=account)


def repeated(path: Path, laps: int) -> Path:
    """A path that ends where it starts, driven several times over.

    Its via points come once a lap; their places in the route go on counting, so that each of them
    is a visit of its own. The end of a lap is the start of the next.

    Args:
        path: One lap.
        laps: How often it is driven.

    Example:
        >>> from viaspline.planning.problem.via_sequence import via_sequence_of
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planning.plan_path import find_path
        >>> mission = Mission.model_validate({
        ...     "route": {"start": [0, 0], "via": [[9, 0], [9, 9]], "closed": True},
        ... })
        >>> lap = find_path(via_sequence_of(mission), World(), Requirements.of(mission)).path
        >>> [(via.name, via.index) for via in repeated(lap, 2).vias if via.index]
        [('via 1', 1), ('via 2', 2), ('start', 3), ('via 1', 4), ('via 2', 5), ('start', 6)]
    """
    if laps == 1:
        return path
    points = max(via.index for via in path.vias if via.index is not None)
    spans = len(path.spans)
    vias = [
        replace(
            via,
            u=via.u + spans * lap,
            index=None if via.index is None else via.index + points * lap,
        )
        for lap in range(laps)
        for via in path.vias
        if lap == 0 or via.u > 0.0
    ]
    return Path(np.concatenate([path.spans] * laps), vias)
