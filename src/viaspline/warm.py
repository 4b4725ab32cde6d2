"""The first run on a machine: a second process compiles half of the kernels meanwhile.

Compiling is most of a first run and numba does it on one core. The kernels of curves and of the
time law need none of those of the world; so while a run begins with the latter, another process
(``python -m viaspline.warm``) compiles the former into the same cache.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from viaspline.kernels.jit import CACHE_FOLDER

MARK = "curves-compiled"
LOCK = "curves-compiling"
LONGEST = 300.0  # a lock that is older than this was left behind [s]


def compile_curves() -> None:
    """Call every kernel of curves and of the time law once, as a run does."""
    from viaspline.curve.path import Path
    from viaspline.trajectory.limits import Limits, Station
    from viaspline.trajectory.retime import retime

    path = Path([[[0, 0], [1, 0], [2, 1], [3, 1]], [[3, 1], [4, 1], [5, 0], [6, 2]]], vias=[])
    limits = Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=0.5)
    retime(path, limits, [Station(2.0, 1.0)])
    u, _, _ = path.sample(1.0)
    path.heading(u)
    path.curvature(u)
    path.max_curvature()
    path.section(0.2, 1.5)
    path.project((1.0, 1.0))
    if CACHE_FOLDER is not None:
        (CACHE_FOLDER / MARK).touch()


def _taken() -> bool:
    """Take the job: one helper is enough, however many first runs begin at once."""
    assert CACHE_FOLDER is not None
    lock = CACHE_FOLDER / LOCK
    with suppress(OSError):
        if time.time() - lock.stat().st_mtime > LONGEST:
            lock.unlink()
    try:
        lock.touch(exist_ok=False)
    except OSError:
        return False
    return True


@contextmanager
def second_compiler() -> Iterator[None]:
    """Within the block another process compiles, if this is the first run and there is a core."""
    cores = os.cpu_count() or 1
    if CACHE_FOLDER is None or (CACHE_FOLDER / MARK).exists() or cores < 2 or not _taken():
        yield
        return
    try:
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "viaspline.warm"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except OSError:  # no interpreter of its own, as in a frozen program: the run compiles all
        yield
        return
    try:
        yield
    finally:
        process.kill()
        process.wait()
        with suppress(OSError):
            (CACHE_FOLDER / LOCK).unlink()


if __name__ == "__main__":
    compile_curves()
