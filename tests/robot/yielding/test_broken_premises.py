"""What breaks the premises of passive safety is told, once, by name; what keeps them isn't."""

from __future__ import annotations

from typing import Any

import pytest

import viaspline as vs


def events_of(motion: dict[str, Any], sensor: dict[str, Any], **moving: Any) -> list[vs.Event]:
    """The broken premises of a drive past one thing."""
    thing = {"name": "dog", "circle": {"center": [0, 0], "radius": 0.4}, "motion": motion}
    mission = vs.Mission.model_validate(
        {
            "world": {"unseen": [thing]},
            "robot": {"sensor": sensor, **moving},
            "route": {"start": [0, 0], "goal": [20, 0]},
        }
    )
    return [event for event in vs.simulate(mission, step=0.1).events if event.kind == "premise"]


SLOW = {"keyframes": [[0, 2, 7], [40, 30, 7]], "after": "stay"}
FAST = {"keyframes": [[0, 2, 7], [3, 4, 7], [5, 12, 7], [40, 14, 7]], "after": "stay"}


@pytest.mark.parametrize(
    "sensor",
    [
        {"range_m": 15},
        {"range_m": 15, "velocity_noise_mps": 0.05},
        {"lidar": {"range_m": 15, "fov_deg": 360, "beams": 720}},
    ],
)
def test_what_is_faster_than_the_mission_says_is_told_and_what_is_not_is_not(
    sensor: dict[str, Any],
) -> None:
    moving = {"moving": {"max_speed_mps": 2.0, "safety": "none"}}
    found = events_of(FAST, sensor, **moving)
    assert found
    assert all("the premise is broken" in event.message for event in found)
    assert all(3.0 <= event.time <= 5.5 for event in found)
    assert events_of(SLOW, sensor, **moving) == []


def test_noise_does_not_make_things_too_fast() -> None:
    """Velocities were taken to be right to a millimetre a second: told of 16 times in a drive."""
    motion = {"keyframes": [[0, -5, 7], [20, 33, 7]], "after": "stay"}  # 1.9 m/s
    sensor = {"range_m": 15, "velocity_noise_mps": 0.2}
    assert events_of(motion, sensor, moving={"max_speed_mps": 2.0, "safety": "none"}) == []


def test_what_jumps_is_told_when_it_does() -> None:
    motion = {"keyframes": [[0, 4, 7], [6, 7, 7]], "after": "loop"}
    with pytest.warns(vs.MissionWarning, match="jumps"):
        found = events_of(
            motion, {"range_m": 15, "velocity_noise_mps": 0.1}, moving={"max_speed_mps": 2.0}
        )
    assert [round(event.time, 1) for event in found] == [6.0]
    assert found[0].data == {"name": "dog"}
    assert "'dog' jumped" in found[0].message


def test_nothing_is_told_where_the_mission_has_no_premise() -> None:
    assert events_of(FAST, {"range_m": 15}) == []
