"""The ledger speaks of the curve that is driven."""

import numpy as np

from viaspline.mission.model import Mission
from viaspline.planner import plan


def test_the_chosen_curve_of_every_entry_is_the_one_that_is_driven() -> None:
    mission = Mission.model_validate(
        {
            "world": {
                "known": [
                    {"circle": {"center": [25, 1], "radius": 5}},
                    {"circle": {"center": [75, -1], "radius": 5}},
                    {"circle": {"center": [75, 52], "radius": 6}},
                ]
            },
            "route": {"start": [0, 0], "via": [[50, 0], [100, 0], [100, 50]], "goal": [50, 54]},
        }
    )
    result = plan(mission)
    assert len(result.ledger) >= 3
    for entry in result.ledger:
        assert entry.chosen is not None
        spans = entry.chosen.spans
        starts = [k for k in range(len(result.path.spans)) if np.array_equal(
            result.path.spans[k : k + len(spans)], spans)]  # fmt: skip
        assert len(starts) == 1
