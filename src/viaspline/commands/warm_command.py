"""``viaspline warm``: compile what a mission, or all of viaspline, can need.

Tested through ``commands/test_warm_command``.
"""

from __future__ import annotations

import time
from functools import partial
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

import click

from viaspline.commands.command_steps import load_asked
from viaspline.commands.common_options import QUIET
from viaspline.errors import OutputError
from viaspline.report.terminal.terminal_lines import say

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission
    from viaspline.report.terminal.progress_bar import ProgressBar
    from viaspline.warming.mission_kind import MissionKind


@click.command()
@click.argument("mission", type=click.Path(path_type=Path), required=False)
@click.option("--all", "everything", is_flag=True, help="Everything, whatever the mission.")
@QUIET
def warm(mission: Path | None, everything: bool, quiet: bool) -> None:
    r"""Compile what a mission needs now, so that no run waits for it.

    Small missions of the same kind are driven for that, with the same sensor, drive and body. What
    is compiled stays in the user's cache; a wheel with compiled kernels brings it along.

    \b
    Examples:
      viaspline warm examples/barn-unseen.yaml
      viaspline warm --all
    """
    if (mission is None) != everything:
        raise click.UsageError("give a mission, or --all")
    from viaspline.kernels.kernel_cache import CACHE_FOLDER

    asked = None if mission is None else load_asked(mission)
    if CACHE_FOLDER is None:
        remedy = "set VIASPLINE_CACHE_DIR to a folder that you can write"
        raise OutputError("<cache>", f"compiled kernels can be kept nowhere; {remedy}")
    from viaspline.report.terminal.progress_bar import ProgressBar

    watch, compiled = ProgressBar(quiet=quiet), _Compiled()
    with watch.stage("warm", "driving small missions"):
        if asked is None:
            _warm_all(watch, compiled, quiet)
        else:
            _warm_mission(asked, watch, compiled, quiet)
    if not quiet:
        took = watch.times["warm"]
        say(f"{compiled.count} kernels compiled in {took:.1f} s, in {CACHE_FOLDER}")


class _Compiled:
    """What was compiled, told from several processes."""

    def __init__(self) -> None:
        self.count, self._lock = 0, Lock()

    def heard(self, watch: ProgressBar, kernel: str) -> None:
        """Count a kernel that is being compiled."""
        with self._lock:
            self.count += 1
            watch.update(f"compiling: {self.count}, {kernel}")


def _warm_mission(
    asked: Mission | Fleet, watch: ProgressBar, compiled: _Compiled, quiet: bool
) -> None:
    from viaspline.warming.kernel_list import package_key
    from viaspline.warming.mission_kind import kinds_of
    from viaspline.warming.warm_up import warm_kind

    key = package_key()
    for kind in kinds_of(asked):
        began = time.perf_counter()
        warm_kind(kind, key, partial(compiled.heard, watch))
        if not quiet:
            say(_line(kind.name, time.perf_counter() - began))


def _warm_all(watch: ProgressBar, compiled: _Compiled, quiet: bool) -> None:
    from viaspline.warming.warm_everything import every_kind, warm_everything

    kinds, failed, count = tuple(every_kind()), [], 0

    def done(kind: MissionKind, took: float, worked: bool) -> None:
        nonlocal count
        count += 1
        watch.fraction(count / len(kinds))
        if not worked:
            failed.append(kind.name)
        elif not quiet:
            say(_line(kind.name, took))

    warm_everything(kinds, partial(compiled.heard, watch), done)
    if failed:
        why = f"python -m viaspline.warming.record_kind {failed[0]} says why"
        raise OutputError("<cache>", f"not all of {', '.join(failed)} could be compiled; {why}")


def _line(name: str, took: float) -> str:
    return f"  {name:<44} {took:6.1f} s"
