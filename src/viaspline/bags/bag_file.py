"""The file of a bag: whether it can be written is known before the long work begins."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from viaspline.bags.bag_writer import BagWriter, check_mcap
from viaspline.bags.drive_recorder import DriveRecorder
from viaspline.bags.own_messages import bag_book
from viaspline.errors import GeometryError, OutputError
from viaspline.handed_in import check_kind
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.report.files.result_files import ResultFolder, replacing
from viaspline.robot.simulation.driven_step import StepWatcher
from viaspline.robot.simulator import STEP_S, longest_step

BAG_SUFFIX: Final = ".mcap"


class BagFile:
    """Where a bag goes.

    Args:
        path: Ends in ``.mcap``.

    Raises:
        OutputError: For another kind, without the extra, or when the folder can't be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        if path.suffix.lower() != BAG_SUFFIX:
            raise OutputError(path, f"a bag ends in {BAG_SUFFIX}; rename it")
        check_mcap(path)
        self.folder = ResultFolder(path.parent, (path.name,))

    @contextmanager
    def recording(self, asked: Mission, plan: Plan, *, seed: int = 0) -> Iterator[StepWatcher]:
        """The block in which a drive is recorded; the file is there when it ends well.

        Args:
            asked: The mission as it was asked for.
            plan: Its plan.
            seed: Of the simulation.

        Returns:
            What is to hear of every step of the drive.

        Raises:
            GeometryError: The mission is one in space.
            OutputError: The file can't be written.
        """
        check_kind("asked", asked, Mission, "give Mission.model_validate({...}) or load(file)")
        check_kind("plan", plan, Plan, "give plan(mission)")
        if asked.is_spatial:
            raise GeometryError("a bag holds the drive of one robot in the plane")
        with replacing(self.path) as temporary, temporary.open("wb") as file:
            bag = BagWriter(file, bag_book())
            recorder = DriveRecorder(
                bag, asked, plan, period=STEP_S, reaction=longest_step(STEP_S), seed=seed
            )
            yield recorder.note
            bag.finish()
