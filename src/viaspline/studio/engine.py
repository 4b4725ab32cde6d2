"""Plans in threads of their own, so that the page is served meanwhile.

Kernels let go of Python's lock. Whatever needs them is imported by the threads as well: the page
is there before numba is.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Final, TypeAlias, TypeVar

from viaspline.studio.document import EMPTY_DOCUMENT, Document, is_fleet, is_spatial
from viaspline.studio.drives_and_files import DrivesAndFiles
from viaspline.studio.early_paths import EarlyPaths
from viaspline.studio.folder import Folder
from viaspline.studio.page_messages import encoded
from viaspline.studio.stoppable_calls import Stoppable, StoppedCallError
from viaspline.studio.variant_plans import VariantPlans
from viaspline.studio.worker import Worker
from viaspline.warming.spared_collections import spare_collections

if TYPE_CHECKING:
    from viaspline.studio.fleet.planned_fleet import PlannedFleet
    from viaspline.studio.map_cache import MapCache
    from viaspline.studio.plan_document import PlannedDocument
    from viaspline.studio.space.planned_spatial import PlannedSpatial
    from viaspline.studio.space.spatial_engine import SpatialEngine

STARTUP_SWITCH_INTERVAL_S: Final = 0.0005
"""How long a thread keeps Python's lock from another at first [s]."""
CHEAP_LEDGER_S: Final = 0.003  # a ledger that takes less is drawn up for every plan [s]
WARM_UP_DOCUMENT: Final[Document] = {
    **EMPTY_DOCUMENT,
    "world": {"bounds": [0, 0, 100, 100], "known": [{"circle": {"center": [50, 50], "radius": 9}}]},
}
"""What is planned before anybody asks, so that the kernels are there when somebody does."""
WARM_UP_FLEET: Final[Document] = {
    "world": WARM_UP_DOCUMENT["world"],
    "separation_m": 1,
    "fleet": [
        {"name": "a", "route": {"start": [10, 20], "goal": [90, 20]}},
        {"name": "b", "route": {"start": [20, 10], "goal": [20, 90]}},
    ],
}
"""What is planned beside it where it is fleets that will be asked for."""

Planned: TypeAlias = "PlannedDocument | PlannedFleet | PlannedSpatial"
T = TypeVar("T")
Hears = Callable[[str, int], None]


class Engine:
    """Plans what is on the screen, and has what else takes its time done.

    Args:
        folder: Where maps are read.
        warm_up: What is planned before anybody asks.

    Attributes:
        early: Paths that are there before a plan is.
        variants: Plans of other missions than the one on the screen.
        others: Advice, drives and files.
        listeners: Hear of kernels that are compiled.
        compiling: The newest of them, and how many there were.
        ready: Whether all that is needed is there.
    """

    def __init__(self, folder: Folder, warm_up: Sequence[Document] = (WARM_UP_DOCUMENT,)) -> None:
        self._folder = folder
        self._warm_up = warm_up
        self._planner = Worker("planner")
        self._maps: MapCache | None = None
        self._space: SpatialEngine | None = None
        self._ledger_cost = 0.0
        self._pictures: dict[str, bytes] = {}
        self._compiled = 0
        self._listening = ExitStack()
        self.early = EarlyPaths(folder)
        self.variants = VariantPlans(folder)
        self.others = DrivesAndFiles()
        self.listeners: set[Hears] = set()
        self.compiling: tuple[str, int] | None = None
        self.ready = False

    def prepare(self) -> None:
        """Begin to load (at first: compile) the kernels."""
        self._planner.do(self._prepare)

    def _prepare(self) -> None:
        # While this is imported and compiled the page is to be served all the same.
        usual = sys.getswitchinterval()
        sys.setswitchinterval(STARTUP_SWITCH_INTERVAL_S)
        try:
            self._load()
        finally:
            sys.setswitchinterval(usual)
        spare_collections()
        self.ready, self.compiling = True, None
        for tell in tuple(self.listeners):
            tell("", self._compiled)

    def _load(self) -> None:
        from viaspline.kernels.compile_events import compile_progress
        from viaspline.precompile import Job, second_compiler
        from viaspline.studio import plan_messages

        # Never left: drives and pictures may compile more.
        self._listening.enter_context(compile_progress(self._hear))
        jobs: tuple[Job, ...] = ("curves",)
        if any(map(is_fleet, self._warm_up)):
            jobs = ("curves", "fleets")
        with second_compiler(jobs):
            for document in self._warm_up:
                if is_fleet(document):
                    self._planned_fleet(document, self._folder.root, 0, None)
                else:
                    planned, _ = self._planned(document, self._folder.root, 0)
                    plan_messages.ledger(planned, 0)

    def _hear(self, kernel: str) -> None:
        self._compiled += 1
        self.compiling = (kernel, self._compiled)
        for tell in tuple(self.listeners):
            tell(kernel, self._compiled)

    async def plan(
        self,
        document: Document,
        base: Path,
        revision: int,
        running: Stoppable,
        before: Planned | None = None,
    ) -> tuple[Planned, str] | None:
        """Plan a document: what came of it, and the answer as text.

        Args:
            document: What is planned: a mission or a fleet.
            base: The folder of its file.
            revision: What the page calls this state of the document.
            running: Stops it; then there is no answer.
            before: What the page was told of last: of a fleet only what is new is laid and told.
        """

        def plan() -> tuple[Planned, str]:
            if is_fleet(document):
                return self._planned_fleet(document, base, revision, before)
            if is_spatial(document):
                planned, text = self._spatial().planned(document, base, revision, before)
                self._keep_pictures(planned)
                return planned, text
            return self._planned(document, base, revision)

        return await self._stoppably(plan, running)

    def _planned(
        self, document: Document, base: Path, revision: int
    ) -> tuple[PlannedDocument, str]:
        from viaspline.studio import plan_document, plan_messages

        planned = plan_document.planned(document, self._map_cache(), base)
        self._keep_pictures(planned)
        return planned, encoded(plan_messages.answer(planned, revision))

    def _planned_fleet(
        self, document: Document, base: Path, revision: int, before: Planned | None
    ) -> tuple[PlannedFleet, str]:
        from viaspline.studio.fleet import fleet_page_messages, planned_fleet

        known = before if isinstance(before, planned_fleet.PlannedFleet) else None
        planned = planned_fleet.planned_fleet(document, self._map_cache(), base, known)
        self._keep_pictures(planned)
        return planned, encoded(fleet_page_messages.fleet_answer(planned, revision, known))

    async def whole_fleet(
        self, planned: PlannedFleet, revision: int, running: Stoppable
    ) -> tuple[Planned, str] | None:
        """A fleet with everything tried for those that aren't served, and the answer as text.

        Args:
            planned: What the page was told of.
            revision: What the page calls this state of the document.
            running: Stops it; then there is no answer.
        """

        def plan() -> tuple[Planned, str]:
            from viaspline.studio.fleet import fleet_page_messages, planned_fleet

            whole = planned_fleet.wholly_planned(planned)
            return whole, encoded(fleet_page_messages.fleet_answer(whole, revision, planned))

        return await self._stoppably(plan, running)

    async def whole_in_space(
        self, planned: PlannedSpatial, revision: int, running: Stoppable
    ) -> tuple[PlannedSpatial, str] | None:
        """A plan in space with all ways past things weighed, and the answer as text.

        Args:
            planned: What the page was told of.
            revision: What the page calls this state of the document.
            running: Stops it; then there is no answer.
        """
        return await self._stoppably(lambda: self._spatial().whole(planned, revision), running)

    async def around_in_space(self, planned: PlannedSpatial, revision: int) -> list[str]:
        """The elevation and the ledger of a plan in space, each as text."""
        return await self._planner.run(lambda: self._spatial().around(planned, revision))

    @property
    def elevations_are_cheap(self) -> bool:
        """Whether the page can have one with every plan while something is dragged."""
        return self._space is None or self._space.around_is_cheap

    def scene(self, name: str) -> bytes | None:
        """What stands in a world in space, by the name in a plan's answer."""
        return None if self._space is None else self._space.scenes.content(name)

    def _spatial(self) -> SpatialEngine:
        from viaspline.studio.space.spatial_engine import SpatialEngine

        if self._space is None:
            self._space = SpatialEngine(self._map_cache())
        return self._space

    async def _stoppably(
        self, plan: Callable[[], tuple[T, str]], running: Stoppable
    ) -> tuple[T, str] | None:
        """What comes of planning, or None where it is stopped."""

        def work() -> tuple[T, str] | None:
            try:
                return running.run(plan)
            except StoppedCallError:
                return None

        return await self._planner.run(work)

    def _map_cache(self) -> MapCache:
        from viaspline.studio.map_cache import MapCache

        if self._maps is None:
            self._maps = MapCache(self._folder)
        return self._maps

    @property
    def ledgers_are_cheap(self) -> bool:
        """Whether the page can have one with every plan while something is dragged."""
        return self._ledger_cost < CHEAP_LEDGER_S

    async def ledger(self, planned: PlannedDocument, revision: int) -> str:
        """The ledger of a plan as text."""

        def work() -> str:
            from viaspline.studio import plan_messages

            start = time.perf_counter()
            text = encoded(plan_messages.ledger(planned, revision))
            self._ledger_cost = time.perf_counter() - start
            return text

        return await self._planner.run(work)

    async def space_time(self, planned: PlannedDocument, revision: int) -> str:
        """When a plan's path is blocked where by what moves, as text."""

        def work() -> str:
            from viaspline.studio import moving_messages

            return encoded(moving_messages.space_time(planned, revision))

        return await self._planner.run(work)

    def _keep_pictures(self, planned: Planned) -> None:
        from viaspline.studio.map_cache import grid_name, grid_png

        world = planned.world
        if world is None:
            return
        for obstacle in (*world.known, *world.unseen):
            grid = obstacle.grid
            if grid is not None and grid_name(grid) not in self._pictures:
                while len(self._pictures) >= 16:
                    del self._pictures[next(iter(self._pictures))]
                self._pictures[grid_name(grid)] = grid_png(grid)

    def picture(self, name: str) -> bytes | None:
        """The picture of a map of squares, by the name in a plan's answer."""
        return self._pictures.get(name)
