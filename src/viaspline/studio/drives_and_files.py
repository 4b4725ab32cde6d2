"""What takes its time beside the planning: advice, drives and files, in a thread of their own.

Tested through ``studio/test_server`` and ``studio/test_server_files``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from threading import Event as Flag
from typing import TYPE_CHECKING, Any

from viaspline.studio.page_messages import encoded
from viaspline.studio.worker import Worker

if TYPE_CHECKING:
    from viaspline.fleet.fleet_plan import FleetPlan
    from viaspline.formats.items import LatLon
    from viaspline.mission.model import Mission
    from viaspline.planner import Plan
    from viaspline.robot.run import Run
    from viaspline.space.spatial_plan import SpatialPlan
    from viaspline.space.spatial_run import SpatialRun
    from viaspline.studio.exports import AnyPlan, AnyRun
    from viaspline.studio.fleet.simulated_fleet import SimulatedFleet

Tells = Callable[[float], None]


class DrivesAndFiles:
    """Works off what a page asks for of plans that are there, one after the other."""

    def __init__(self) -> None:
        self._worker = Worker("drives and files")

    async def advise(self, mission: Mission) -> dict[str, Any]:
        """Which tension a mission is suggested, and why.

        Raises:
            ViasplineError: There is no plan to compare.
        """

        def work() -> dict[str, Any]:
            from viaspline.advice import advise_tension
            from viaspline.report.advice_words import advice_words

            advice = advise_tension(mission)
            return {
                "type": "advised",
                "words": advice_words(advice),
                "tension": advice.suggested,
                "is_new": advice.matters and advice.chosen is not advice.stands,
            }

        return await self._worker.run(work)

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
            from viaspline.studio import simulated_drive

            try:
                run = simulated_drive.drive(plan, seed=seed, stop=stop, tell=tell)
            except simulated_drive.StoppedError:
                return None
            return run, encoded({**head, **simulated_drive.driven(run)})

        return await self._worker.run(work)

    async def drive_fleet(
        self, plan: FleetPlan, *, head: Mapping[str, Any], seed: int
    ) -> tuple[SimulatedFleet, str]:
        """Drive the plan of a fleet; what was driven and the answer as text.

        Args:
            plan: What is driven.
            head: What the answer begins with.
            seed: Of what is random.
        """

        def work() -> tuple[SimulatedFleet, str]:
            from viaspline.studio.fleet import simulated_fleet

            found = simulated_fleet.simulated_fleet(plan, seed)
            return found, encoded({**head, **simulated_fleet.driven_fleet_answer(found)})

        return await self._worker.run(work)

    async def fly(self, plan: SpatialPlan, *, head: Mapping[str, Any]) -> tuple[SpatialRun, str]:
        """Fly a plan in space; the flight and the answer as text.

        Args:
            plan: What is flown.
            head: What the answer begins with.
        """

        def work() -> tuple[SpatialRun, str]:
            from viaspline.space.online.fly import fly
            from viaspline.studio.space import simulated_flight

            run = fly(plan)
            return run, encoded({**head, **simulated_flight.flown(run)})

        return await self._worker.run(work)

    async def plan_file(self, plan: AnyPlan, kind: str, name: str) -> bytes:
        """One of the files of a plan, or of a fleet's."""

        def work() -> bytes:
            from viaspline.studio.exports import plan_file

            return plan_file(plan, kind, name)

        return await self._worker.run(work)

    async def path_file(
        self, plan: Plan | SpatialPlan, kind: str, name: str, origin: LatLon | None
    ) -> tuple[bytes, tuple[str, ...]]:
        """The path of a plan in a format of other people's, and what is to be said of it."""

        def work() -> tuple[bytes, tuple[str, ...]]:
            from viaspline.studio.exports import path_file

            return path_file(plan, kind, name, origin)

        return await self._worker.run(work)

    async def run_file(self, run: AnyRun, kind: str, name: str, seed: int) -> bytes:
        """One of the files of a run."""

        def work() -> bytes:
            from viaspline.studio.exports import run_file

            return run_file(run, kind, name, seed)

        return await self._worker.run(work)
