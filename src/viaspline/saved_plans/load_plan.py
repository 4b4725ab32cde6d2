"""A plan that was saved, read again: its path is taken, its proofs and times are made anew."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from viaspline.bounded_file import is_folder, is_there
from viaspline.errors import SavedPlanError
from viaspline.formats.asked_for import AskedMission, asked_mission
from viaspline.handed_in import check_kind
from viaspline.planner import Plan
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.space.spatial_plan import SpatialPlan

PLAN_NAME: Final = "plan.json"
MISSION_NAME: Final = "planned-mission.yaml"
FLEET_NAME: Final = "fleet.json"
WHOLE_FLEET: Final = (
    "holds the plan of a fleet; call load_fleet_plan(folder), or load_plan(folder / NAME, "
    "member.mission) for one of fleet.members"
)


def load_plan(folder: str | Path, mission: AskedMission | None = None) -> Plan | SpatialPlan:
    """The plan that ``plan.save(folder)`` or ``viaspline plan`` wrote there.

    What can be proven isn't believed: the path is taken from ``plan.json``, and its clearance to
    the world of the mission is proven again, as are its heights, its distance to what moves, and
    that it serves the route; the time law is made again, or held against the robot's limits. So it
    equals what was saved, or is refused. The ledger is a record of what was tried, and taken as it
    stands.

    Args:
        folder: With ``plan.json``, or that file itself. The plan of a whole fleet is loaded by
            ``load_fleet_plan``.
        mission: What was planned, with its via points in the order in which they are served; not
            needed where ``planned-mission.yaml`` stands beside the plan.

    Returns:
        The plan: in the plane or in space, as its mission is.

    Raises:
        MissionError: A file isn't there or can't be read, or the mission has faults.
        SavedPlanError: The file is no plan of the mission, or says what isn't so: somebody changed
            it, or the mission, or a map of it.

    Example:
        >>> from tempfile import TemporaryDirectory
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> made = plan(Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}}))
        >>> with TemporaryDirectory() as folder:
        ...     files = made.save(folder)
        ...     load_plan(folder) == made
        True
    """
    check_kind("folder", folder, (str, Path), "give the path of a folder with plan.json")
    file = Path(folder)
    if file.name != PLAN_NAME or is_folder(file):
        if is_there(file / FLEET_NAME) and not is_there(file / PLAN_NAME):
            raise SavedPlanError(file, WHOLE_FLEET)
        file = file / PLAN_NAME
    saved = PlanFile.read(file)
    if mission is None:
        beside = file.with_name(MISSION_NAME)
        if not beside.exists():
            problem = f"there is no {MISSION_NAME} beside it"
            raise SavedPlanError(file, f"{problem}; give load_plan the mission of the plan")
        mission = beside
    asked = asked_mission(mission)
    if asked.is_spatial:
        from viaspline.saved_plans.plan_in_space import plan_in_space

        return plan_in_space(saved, asked)
    from viaspline.saved_plans.planar_plan import planar_plan

    return planar_plan(saved, asked)
