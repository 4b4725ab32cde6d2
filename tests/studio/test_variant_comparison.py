"""Variants of the mission that is open: told row by row, stopped, refused in words."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan

Start = Callable[..., Any]
EXAMPLES = Path(__file__).parents[2] / "examples"


def compared(client: Any, number: int, *variants: list[Any]) -> tuple[list[Any], Any]:
    """The rows of a comparison, and what is answered at its end."""
    end = client.ask("compare", "compared", number=number, variants=list(variants))
    rows = [m for m in client.heard if m["type"] == "variant" and m["number"] == number]
    return rows, end


def test_each_row_says_of_its_variant_what_its_own_plan_says(start: Start, patrol: Path) -> None:
    with start(patrol).client() as client:
        rows, end = compared(
            client,
            1,
            [],
            [[["spline", "tension"], 0.6]],
            [[["robot", "clearance_m"], 60]],
        )
    assert (end["done"], end["stopped"]) == (3, False)
    assert [row["index"] for row in rows] == [0, 1, 2]
    document = client.hello["document"]
    data = {**document, "spline": {**document["spline"], "tension": 0.6}}
    own = plan(Mission.model_validate(data))
    row = rows[1]
    assert row["length"] == own.path.length
    assert row["duration"] == own.trajectory.duration
    assert row["clearance"] == own.certificate.clearance
    assert row["jumps"] == own.drivability.curvature_jumps
    assert row["verdict"] == own.drivability.verdict
    assert row["radius"] == pytest.approx(1 / own.path.max_curvature()[0], rel=1e-6)
    assert len(row["spans"]) == 8 * len(own.path.spans)
    assert not rows[2]["ok"]
    assert "inside the clearance" in rows[2]["words"][0]
    assert "move it to" in rows[2]["words"][0]
    assert rows[0]["length"] != row["length"]


def test_a_comparison_is_stopped_and_the_next_one_takes_its_place(
    start: Start, tmp_path: Path
) -> None:
    slow = Path(shutil.copy(EXAMPLES / "mecanum-shelves.yaml", tmp_path))
    with start(slow).client() as client:
        variants = [[[["robot", "clearance_m"], 0.2 + 0.001 * k]] for k in range(16)]
        client.send(type="compare", id=1, number=1, variants=variants)
        client.hear("variant")
        client.send(type="stop_comparing")
        first = client.hear("compared")
        assert (first["id"], first["stopped"]) == (1, True)
        assert 1 <= first["done"] < 16
        client.send(type="compare", id=2, number=2, variants=variants)
        client.send(type="compare", id=3, number=3, variants=[[]])
        ends = {client.hear("compared")["id"] for _ in range(2)}
        assert ends == {2, 3}
        assert [m["index"] for m in client.heard if m.get("number") == 3] == [0]


@pytest.mark.parametrize("variants", [None, [], [[[["a", "b"], 1]]] * 17, [[["route"]]], "all"])
def test_what_makes_no_sense_is_refused(start: Start, patrol: Path, variants: Any) -> None:
    with start(patrol).client() as client:
        answer = client.ask("compare", "refused", number=1, variants=variants)
        assert answer["about"] == "compare"
        assert "defect" not in answer["message"]
