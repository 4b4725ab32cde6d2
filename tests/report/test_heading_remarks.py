import math

import pytest

from viaspline.mission.model import Mission
from viaspline.report.heading_remarks import heading_remarks


def remarks_of(heading: float) -> list[str]:
    start = {"at": [0, 0], "heading_deg": heading}
    return heading_remarks(Mission.model_validate({"route": {"start": start, "goal": [9, 0]}}))


@pytest.mark.parametrize("eighths", [k for k in range(-8, 9) if k != 0])
@pytest.mark.parametrize("decimals", [2, 3, 6, 15])
def test_an_eighth_of_a_turn_in_radians_is_told_in_degrees(eighths: int, decimals: int) -> None:
    (told,) = remarks_of(round(eighths * math.pi / 4, decimals))
    assert told.endswith(f"those would be {45 * eighths} degrees")


@pytest.mark.parametrize("heading", [0, 1, -2, 3, 5, 6, 0.5, 1.5, 2.5, 7.9, 45, 90, 180, -135, 359])
def test_degrees_are_taken_for_degrees(heading: float) -> None:
    assert remarks_of(heading) == []
