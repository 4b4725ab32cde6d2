"""Does the robot fit through every gate, and does the route go through it forwards?"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.space.gate_spec import GateSpec
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number


def narrow_faults(path: Path, gate: GateSpec, robot: RobotSpec) -> Iterator[UnplacedFault]:
    """The sides by which a robot with its clearance doesn't fit through a gate.

    >>> gate = GateSpec(at=(0, 0, 5), facing_deg=0, width_m=2, height_m=1.5)
    >>> [fault] = narrow_faults((), gate, RobotSpec(radius_m=0.6, half_height_m=0.2))
    >>> fault.problem
    'the gate is 2 m wide, and the robot with its clearance 2.2 m'
    """
    half = robot.inner_radius if robot.half_height_m is None else robot.half_height_m
    for key, word, has, body in (
        ("width_m", "wide", gate.width_m, robot.inner_radius),
        ("height_m", "high", gate.height_m, half),
    ):
        needs = 2 * (body + robot.clearance_m)
        if has < needs - 1e-9:
            problem = f"the gate is {number(has)} m {word}, and the robot with its clearance "
            problem += f"{number(needs)} m"
            least = math.floor(1e3 * (0.5 * has - body)) / 1e3
            remedy = f"give {key}: {number(math.ceil(1e3 * needs) / 1e3)} or more"
            if least >= 0:
                remedy += f", or set robot.clearance_m to at most {number(least)}"
            yield UnplacedFault((*path, "gate", key), problem, remedy)


def facing_faults(
    path: Path,
    gate: GateSpec,
    before: Sequence[tuple[float, ...]],
    behind: Sequence[tuple[float, ...]],
) -> Iterator[UnplacedFault]:
    """A gate that faces away from the route, which comes from ahead of it and leaves behind it.

    Args:
        path: The point.
        gate: Its gate.
        before: The places that may come before it; none if none is known.
        behind: Those that may come after it.

    >>> gate = GateSpec(at=(5, 0, 5), facing_deg=170, width_m=2, height_m=1.5)
    >>> [fault] = facing_faults((), gate, [(0, 0, 5)], [(9, 0, 5)])
    >>> fault.remedy
    'turn it round: facing_deg: -10; or give a via point in front of it'
    """
    (x, y, _), (east, north) = gate.at, gate.way
    along = [(x - u, y - v) for u, v, *_ in before] + [(u - x, v - y) for u, v, *_ in behind]
    forward = [dx * east + dy * north for dx, dy in along]
    if forward and max(forward) < 0:
        turned = (gate.facing_deg + 360.0) % 360.0 - 180.0
        remedy = f"turn it round: facing_deg: {number(turned)}; or give a via point in front of it"
        problem = "the gate faces away from the route, both as it comes and as it leaves"
        yield UnplacedFault((*path, "gate", "facing_deg"), problem, remedy)
