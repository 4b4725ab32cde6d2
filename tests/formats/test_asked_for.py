from pathlib import Path

import pytest

import viaspline as vs
from viaspline.formats.asked_for import asked_fleet, asked_mission

EXAMPLES = Path(__file__).parents[2] / "examples"
PATROL = EXAMPLES / "fig8-patrol.yaml"
CARTS = EXAMPLES / "crossing-carts.yaml"
TOWER = """
world: {known: [{circle: {center: [25, 0.5], radius: 4}, height_m: [0, 30]}]}
route: {start: [0, 0, 10], goal: [50, 0, 10]}
"""
PAIR = """
fleet:
  - {name: a, route: {start: [0, 0], goal: [9, 0]}}
  - {name: b, route: {start: [0, 5], goal: [9, 5]}}
"""


def test_a_mission_is_taken_as_it_is_or_read_from_its_file() -> None:
    mission = vs.load(PATROL)
    assert isinstance(mission, vs.Mission)
    assert asked_mission(mission) is mission
    assert asked_mission(PATROL) == asked_mission(str(PATROL)) == mission


def test_every_verb_takes_the_file_of_what_it_does(tmp_path: Path) -> None:
    assert vs.plan(str(PATROL)) == vs.plan(vs.load(PATROL))
    assert vs.simulate(PATROL).reached
    tower, pair = tmp_path / "tower.yaml", tmp_path / "pair.yaml"
    tower.write_text(TOWER)
    pair.write_text(PAIR)
    assert vs.fly(tower) == vs.fly(vs.plan(tower))
    assert vs.plan_fleet(str(pair)).served
    assert vs.simulate_fleet(pair).reached


def test_what_goes_to_another_verb_says_to_which(tmp_path: Path) -> None:
    pair = tmp_path / "pair.yaml"
    pair.write_text(PAIR)
    with pytest.raises(vs.GeometryError, match=r"holds a fleet.*plan_fleet"):
        vs.plan(pair)
    with pytest.raises(vs.GeometryError, match="mission is a fleet"):
        vs.simulate(vs.load(pair))  # type: ignore[arg-type]
    with pytest.raises(vs.GeometryError, match="holds a mission of one robot"):
        vs.plan_fleet(PATROL)
    with pytest.raises(vs.GeometryError, match="fleet is a mission of one robot"):
        asked_fleet(vs.load(PATROL))  # type: ignore[arg-type]
    with pytest.raises(vs.GeometryError, match="nothing of heights; hand it to simulate"):
        vs.fly(PATROL)


def test_a_file_that_is_not_there_is_named() -> None:
    for verb in (vs.plan, vs.simulate, vs.fly, vs.plan_fleet, vs.simulate_fleet):
        with pytest.raises(vs.MissionError, match=r"patrol\.yaml: there is no such file"):
            verb("patrol.yaml")
