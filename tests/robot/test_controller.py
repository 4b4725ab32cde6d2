"""What a controller keeps of its commands: the one that acts stays until the next one does."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viaspline.kernels.tracking.drive_motion import GIVEN_AT
from viaspline.mission.model import Mission
from viaspline.robot.navigator import Navigator

Make = Callable[..., Mission]


def test_the_command_that_acts_is_kept_however_late_the_next_one_is(mission_of: Make) -> None:
    """After a search of two periods it had been dropped, and the simulated drive stopped."""
    nav = Navigator(mission_of([0, 0], [20, 0], drive={"differential": {"track_m": 0.4}}))
    _, nav = nav.step(nav.reference(0.0), [], 0.0)
    assert nav.controller is not None
    for late in (0.01, 0.1, 0.4, 2.0):
        given = nav.controller.gave(0.05 + late).given[:, GIVEN_AT]
        np.testing.assert_allclose(given[-2:], [0.0, 0.05 + late])
