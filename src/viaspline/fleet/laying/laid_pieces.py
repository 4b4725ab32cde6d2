"""Robots laid in pieces of work, and how many of them are.

Tested through ``fleet/laying/test_laying_workers``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias, TypeVar

from viaspline.fleet.laying.laying_workers import LayingWorkers, ThisProcess

LayingProgress: TypeAlias = Callable[[int, int], None]
"""Called with how many paths are laid, and how many have to be: alone, then among all."""

AT_ONCE = 25
"""So many robots are one piece of work, in a large fleet."""
LEAST_PIECES = 12
"""Into so many pieces the work of a small one is cut."""
THIS_PROCESS = ThisProcess()
Part = TypeVar("Part")
Done = TypeVar("Done")


class LaidPieces:
    """Counts the pieces that are done, and tells."""

    def __init__(self, progress: LayingProgress | None, pieces: int, done: int = 0) -> None:
        self._progress, self._pieces, self._done = progress, pieces, done

    def more(self, pieces: int) -> None:
        """So many more are laid."""
        self._done = min(self._done + pieces, self._pieces)  # some may be laid once more
        if self._progress is not None and pieces:
            self._progress(self._done, self._pieces)


def pieces_of_work(robots: Sequence[Part]) -> list[Sequence[Part]]:
    """Robots in pieces of work."""
    size = min(AT_ONCE, -(-len(robots) // LEAST_PIECES))
    return [robots[k : k + size] for k in range(0, len(robots), max(size, 1))]


def laid_in_order(
    workers: LayingWorkers, task: Callable[[Part], list[Done]], parts: Sequence[Part],
    tell: LaidPieces,
) -> list[Done]:  # fmt: skip
    """What comes of all parts, in the order of the parts."""
    found: dict[int, list[Done]] = {}
    for k, done in workers.each(task, parts):
        found[k] = done
        tell.more(len(done))
    return [one for k in range(len(parts)) for one in found[k]]
