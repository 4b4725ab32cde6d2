"""A path as a ``nav_msgs/Path`` in YAML, as ``ros2 topic pub`` and ``ros2 topic echo`` have it.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

import math
from typing import ClassVar

from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import DIGITS_M, PathTable
from viaspline.report.proven_reference import PROVEN_WORDS

FRAME = "map"


class NavPathYaml:
    """One message. The stamp of each pose is when the robot is there, by the mission's clock.

    Where something moves it sets out at ``route.depart_s`` by that, else at 0.

    What is proven, and what isn't carried, are comments before it.
    """

    description: ClassVar[str] = "nav_msgs/Path in YAML"
    endings: ClassVar[tuple[str, ...]] = (".path.yaml", ".path.yml", "-path.yaml")
    carries: ClassVar[frozenset[Carried]] = frozenset({"times", "headings"})
    is_geographic: ClassVar[bool] = False
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = 0.1

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        lines = [f"# {table.name}: {table.proof_words()}; {PROVEN_WORDS}".replace("\n", " ")]
        lines += [f"# not carried: {words}" for words in table.lost]
        lines += ["header:", *_header("  ", 0.0), "poses:"]
        for at, heading, time in zip(
            table.points.tolist(), table.headings.tolist(), table.times.tolist(), strict=True
        ):
            x, y, z = (*at, 0.0)[:3]
            lines += [
                "- header:",
                *_header("    ", time),
                "  pose:",
                f"    position: {{x: {x:.{DIGITS_M}f}, y: {y:.{DIGITS_M}f}, z: {z:.{DIGITS_M}f}}}",
                "    orientation: {x: 0.0, y: 0.0, "
                f"z: {math.sin(0.5 * heading) + 0.0:.12f}, w: {math.cos(0.5 * heading):.12f}}}",
            ]
        return ("\n".join(lines) + "\n").encode()


def _header(indent: str, time: float) -> list[str]:
    seconds, nanoseconds = stamp(time)
    return [
        f"{indent}stamp: {{sec: {seconds}, nanosec: {nanoseconds}}}",
        f"{indent}frame_id: {FRAME}",
    ]


def stamp(time: float) -> tuple[int, int]:
    """Seconds and nanoseconds of a time [s].

    >>> stamp(2.25)
    (2, 250000000)
    """
    return divmod(round(time * 1e9), 1_000_000_000)
