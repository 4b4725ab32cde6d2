"""What a kind of drive is that says nothing of itself: one that does as it is told."""

from __future__ import annotations

import pytest

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive_kind import Contradiction, DriveKind
from viaspline.mission.drives.drive_limits import DriveLimits
from viaspline.mission.semantic_checks import semantic_faults


class Plain(DriveKind):
    pass


def test_without_a_word_it_turns_on_the_spot_and_asks_for_nothing() -> None:
    kind = Plain()
    assert kind.turn_radius is None
    assert kind.can_turn_on_spot
    assert kind.held_heading is None
    assert kind.actuators() == pytest.approx(Actuators(), nan_ok=True)
    assert kind.limits(2.0, 1.0) == DriveLimits()
    assert kind.actuator_values(1.0, 0.5) == {}
    assert kind.contradictions(has_footprint=True) == ()


def test_what_contradicts_the_robot_is_a_fault_at_its_key(monkeypatch: pytest.MonkeyPatch) -> None:
    from viaspline.mission.drives.differential import Differential
    from viaspline.mission.drives.drive import Drive
    from viaspline.mission.partial_mission import PartialMission
    from viaspline.mission.robot_parts import RobotSpec

    said = (Contradiction("track_m", "doesn't fit", "give a narrower one"),)
    monkeypatch.setattr(Differential, "contradictions", lambda *_, **__: said)
    robot = RobotSpec(drive=Drive(differential=Differential(track_m=0.5)))
    (fault,) = semantic_faults(PartialMission(robot=robot, has_route=False))
    assert fault.path == ("robot", "drive", "differential", "track_m")
    assert (fault.problem, fault.remedy) == ("doesn't fit", "give a narrower one")
