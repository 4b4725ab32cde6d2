"""The first run on a machine: a second process compiles half of the kernels meanwhile.

Compiling is most of a first run and numba does it on one core. The kernels of curves and of the
time law need none of those of the world; so while a run begins with the latter, another process
(``python -m viaspline.warm``) compiles the former into the same cache.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from viaspline.kernels.jit import CACHE_FOLDER

MARK = "curves-compiled"


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


@contextmanager
def second_compiler() -> Iterator[None]:
    """Within the block another process compiles, if this is the first run and there is a core."""
    cores = os.cpu_count() or 1
    if CACHE_FOLDER is None or (CACHE_FOLDER / MARK).exists() or cores < 2:
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


if __name__ == "__main__":
    compile_curves()
