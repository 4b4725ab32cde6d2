"""Plans and drives in threads of their own, so that the page is served meanwhile.

Kernels let go of Python's lock. Whatever needs them is imported by the threads as well: the page
is there before numba is.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from threading import Event as Flag
from typing import TYPE_CHECKING, Any, Final

from viaspline.studio.document import EMPTY, Document
from viaspline.studio.folder import Folder
from viaspline.studio.messages import encoded
from viaspline.studio.worker import Worker

if TYPE_CHECKING:
    from viaspline.planner import Plan
    from viaspline.robot.run import Run
    from viaspline.studio.maps import Maps
    from viaspline.studio.planning import Planned

SWITCH: Final = 0.0005  # how long a thread keeps Python's lock from another at first [s]
CHEAP: Final = 0.003  # a ledger that takes less goes with its plan [s]
FIRST: Final[Document] = {
    **EMPTY,
    "world": {"bounds": [0, 0, 100, 100], "known": [{"circle": {"center": [50, 50], "radius": 9}}]},
}
"""What is planned before anybody asks, so that the kernels are there when somebody does."""

Hears = Callable[[str, int], None]
Tells = Callable[[float], None]


class Engine:
    """Plans, drives and everything else that takes its time.

    Args:
        folder: Where maps are read.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._planner = Worker("planner")
        self._others = Worker("drives and files")
        self._maps: Maps | None = None
        self._ledger_cost = 0.0
        self._pictures: dict[str, bytes] = {}
        self._compiled = 0
        self._listening = ExitStack()
        self.listeners: set[Hears] = set()
        self.compiling: tuple[str, int] | None = None
        self.ready = False

    def prepare(self) -> None:
        """Begin to load (at first: compile) the kernels."""
        self._planner.do(self._prepare)

    def _prepare(self) -> None:
        # While this is imported and compiled the page is to be served all the same.
        usual = sys.getswitchinterval()
        sys.setswitchinterval(SWITCH)
        try:
            self._load()
        finally:
            sys.setswitchinterval(usual)
        self.ready, self.compiling = True, None
        for tell in tuple(self.listeners):
            tell("", self._compiled)

    def _load(self) -> None:
        from viaspline.kernels.jit import compile_progress
        from viaspline.warm import second_compiler

        # Never left: drives and pictures may compile more.
        self._listening.enter_context(compile_progress(self._hear))
        with second_compiler():
            self._planned(FIRST, self._folder.root, 0)

    def _hear(self, kernel: str) -> None:
        self._compiled += 1
        self.compiling = (kernel, self._compiled)
        for tell in tuple(self.listeners):
            tell(kernel, self._compiled)

    async def plan(
        self, document: Document, base: Path, revision: int
    ) -> tuple[Planned, str, bool]:
        """Plan a document.

        Returns:
            (what came of it, the answer as text, whether the ledger is still to be asked for).
        """
        return await self._planner.run(lambda: self._planned(document, base, revision))

    def _planned(self, document: Document, base: Path, revision: int) -> tuple[Planned, str, bool]:
        from viaspline.studio import answers, planning
        from viaspline.studio.maps import Maps

        if self._maps is None:
            self._maps = Maps(self._folder)
        planned = planning.planned(document, self._maps, base)
        self._keep_pictures(planned)
        answer = answers.answer(planned, revision)
        later = planned.plan is not None and self._ledger_cost > CHEAP
        if planned.plan is not None and not later:
            answer["ledger"] = self._ledger(planned, revision)["entries"]
        return planned, encoded(answer), later

    async def ledger(self, planned: Planned, revision: int) -> str:
        """The ledger of a plan as text."""
        return await self._planner.run(lambda: encoded(self._ledger(planned, revision)))

    def _ledger(self, planned: Planned, revision: int) -> dict[str, object]:
        from viaspline.studio import answers

        start = time.perf_counter()
        found = answers.ledger(planned, revision)
        self._ledger_cost = time.perf_counter() - start
        return found

    def _keep_pictures(self, planned: Planned) -> None:
        from viaspline.studio.maps import grid_name, grid_png

        if planned.mission is None:
            return
        world = planned.mission.world
        for obstacle in (*world.known, *world.unseen):
            grid = obstacle.grid
            if grid is not None and grid_name(grid) not in self._pictures:
                while len(self._pictures) >= 16:
                    del self._pictures[next(iter(self._pictures))]
                self._pictures[grid_name(grid)] = grid_png(grid)

    def picture(self, name: str) -> bytes | None:
        """The picture of a map of squares, by the name in a plan's answer."""
        return self._pictures.get(name)

    async def drive(
        self, plan: Plan, *, head: Mapping[str, Any], seed: int, stop: Flag, tell: Tells
    ) -> tuple[Run, str] | None:
        """Drive a plan; the run and the answer as text, or None if it was broken off.

        Args:
            plan: What is driven.
            head: What the answer begins with.
            seed: For the noise of a lidar.
            stop: Set to break it off.
            tell: Hears how much is done, from 0 to 1.
        """

        def work() -> tuple[Run, str] | None:
            from viaspline.studio import driving

            try:
                run = driving.drive(plan, seed=seed, stop=stop, tell=tell)
            except driving.StoppedError:
                return None
            return run, encoded({**head, **driving.driven(run)})

        return await self._others.run(work)

    async def plan_file(self, plan: Plan, kind: str, name: str) -> bytes:
        """One of the files of a plan."""

        def work() -> bytes:
            from viaspline.studio.exports import plan_file

            return plan_file(plan, kind, name)

        return await self._others.run(work)

    async def run_file(self, run: Run, kind: str, name: str, seed: int) -> bytes:
        """One of the files of a run."""

        def work() -> bytes:
            from viaspline.studio.exports import run_file

            return run_file(run, kind, name, seed)

        return await self._others.run(work)
