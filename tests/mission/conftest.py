"""A good mission, to be spoiled in tests."""

import copy
from collections.abc import Callable
from typing import Any

import pytest

GOOD: dict[str, Any] = {
    "world": {
        "bounds": [0, 0, 500, 500],
        "fences": [[[1, 1], [499, 1], [499, 499], [1, 499]]],
        "known": [
            {"circle": {"center": [120, 200], "radius": 12}, "pass_on": "left"},
            {"name": "tank", "polygon": [[200, 300], [230, 300], [215, 340]]},
            {
                "polygon": [[400, 400], [450, 400], [450, 450], [400, 450]],
                "holes": [[[410, 410], [440, 410], [440, 440], [410, 440]]],
            },
        ],
        "unseen": [{"circle": {"center": [240, 180], "radius": 8}}],
    },
    "robot": {"radius_m": 0.5, "clearance_m": 0.5, "sensor": {"range_m": 40}},
    "route": {
        "start": {"at": [50, 250], "heading_deg": 45},
        "via": [[90, 330], {"at": [140, 170], "name": "pump", "dwell_s": 20}],
        "goal": [350, 250],
        "closed": False,
    },
    "spline": {"tension": [0.1, 0, -0.5], "knots": "chordal"},
}


@pytest.fixture(scope="session")
def good() -> Callable[[], dict[str, Any]]:
    """Makes the good mission, a new one each time."""
    return lambda: copy.deepcopy(GOOD)


@pytest.fixture(scope="session")
def spoiled() -> Callable[[str, Any], dict[str, Any]]:
    """Makes the good mission with another value at a dotted path; indices are numbers."""

    def spoil(path: str, value: Any) -> dict[str, Any]:
        data = copy.deepcopy(GOOD)
        *parents, last = [int(part) if part.isdigit() else part for part in path.split(".")]
        node: Any = data
        for part in parents:
            node = node[part]
        node[last] = value
        return data

    return spoil
