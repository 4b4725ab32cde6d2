"""What is asked of straight lines: against shapely, and against the plan's own proof."""

import numpy as np
import pytest
import shapely

from viaspline.exports.line_proof import LineProver, polyline_curve
from viaspline.mission.model import Mission
from viaspline.plan_mission import plan

DISC = {"circle": {"center": [25, 0.5], "radius": 4}}
ROUTE = {"start": [0, 0], "goal": [50, 0]}


def test_a_line_is_as_clear_as_its_distance_from_what_is_there() -> None:
    planned = plan(Mission.model_validate({"world": {"known": [DISC]}, "route": ROUTE}))
    prover = LineProver.of(planned)
    line = np.array([[10.0, -7.0], [40.0, -6.0]])
    found = prover.proof(line, 20.0)
    away = shapely.LineString(line).distance(shapely.Point(25, 0.5)) - 4 - 0.5
    assert away - 1e-3 <= found.clearance <= away
    assert found.away is not None
    assert found.away[1] == pytest.approx(-1.0, abs=0.01)


def test_a_body_is_proven_on_the_line_and_where_it_turns_to_the_next_one() -> None:
    robot = {"footprint": [[-1, -0.5], [3, -0.5], [3, 0.5], [-1, 0.5]], "clearance_m": 0.1}
    asked = {"world": {"known": [DISC]}, "robot": robot, "route": ROUTE}
    prover = LineProver.of(plan(Mission.model_validate(asked)))
    corners = np.array([[10.0, -6.0], [25.0, -6.0], [25.0, -20.0]])
    alone = prover.proof(corners[:2], 5.0).clearance
    turning = prover.proof(corners, 5.0).clearance
    assert turning == pytest.approx(2.5 - np.hypot(1.0, 0.5), abs=2e-3)  # its rear swings round
    assert alone == pytest.approx(2.0, abs=2e-3)


def test_on_upright_legs_the_ground_does_not_count() -> None:
    asked = {
        "world": {"ground": {"flat_m": 0}},
        "robot": {"radius_m": 0.5, "clearance_m": 2},
        "route": {"start": [0, 0], "takeoff": {"to_agl_m": 10}, "land": {"at": [50, 0]}},
    }
    planned = plan(Mission.model_validate(asked))
    prover = LineProver.of(planned)
    up = np.array([[0, 0, 0.5], [0, 0, 10.0]])
    assert np.isinf(prover.proof(up, 5.0).clearance)
    assert prover.proof(up + np.array([0, 0, 0.5]), planned.airborne[0] + 5.0).clearance < 2.0


def test_straight_lines_are_a_curve_through_their_corners() -> None:
    corners = np.array([[0, 0, 1], [3, 4, 1], [3, 4, 9]], float)
    curve = polyline_curve(corners)
    assert np.array_equal(curve.spans[:, 0], corners[:-1])
    assert curve.length == pytest.approx(13.0)
