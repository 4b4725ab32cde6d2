from functools import cache
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.presentable.named_columns import Table

MISSION = vs.Mission.model_validate(
    {
        "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
        "route": {"start": [0, 0], "via": [{"at": [30, 20], "dwell_s": 3}], "goal": [50, 0]},
    }
)
TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLIGHT = vs.Mission.model_validate(
    {
        "world": {"known": [TOWER], "ground": {"flat_m": 2}},
        "route": {"start": [0, 0, 10], "goal": [50, 0, 15]},
    }
)
PAIR = vs.Fleet.model_validate(
    {
        "fleet": [
            {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
            {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ]
    }
)


@cache
def planned() -> vs.Plan:
    return vs.plan(MISSION)


@cache
def flown() -> Any:
    return vs.plan(FLIGHT)


@cache
def fleet_plan() -> vs.FleetPlan:
    return vs.plan_fleet(PAIR)


@pytest.fixture(scope="module", params=[planned, flown, fleet_plan])
def table(request: pytest.FixtureRequest) -> Table:
    found: Table = request.param().samples(5.0)
    return found


def test_the_columns_of_a_plan_are_what_the_path_and_the_law_say() -> None:
    table = planned().samples(step=0.1)
    assert table.dtype.names == (
        "distance_m", "x_m", "y_m", "heading_rad", "curvature_1pm", "speed_mps", "time_s",
    )  # fmt: skip
    along = table["distance_m"]
    assert along[0] == 0.0
    assert along[-1] == planned().path.length
    assert 0.0 < np.diff(along).min() <= np.diff(along).max() <= 0.1 + 1e-9
    places = planned().path.at_distance(along)
    assert np.array_equal(np.column_stack((table["x_m"], table["y_m"])), places)
    assert np.array_equal(table["speed_mps"], planned().trajectory.speed_at(along))
    assert np.array_equal(table["time_s"], planned().trajectory.time_at(along))
    u = planned().path.parameter(along)
    assert table["heading_rad"] == pytest.approx(planned().path.heading(u))
    assert table["curvature_1pm"] == pytest.approx(planned().path.curvature(u))


def test_a_path_with_heights_has_a_column_for_them() -> None:
    high = vs.Mission.model_validate({"route": {"start": [0, 0, 5], "goal": [9, 0, 6]}})
    assert "z_m" in vs.plan(high).samples(1.0).dtype.names
    table = flown().samples(0.5)
    assert {"z_m", "agl_m", "climb_mps"} <= set(table.dtype.names)
    assert table["agl_m"] == pytest.approx(table["z_m"] - 2.0)


def test_the_columns_of_runs_are_what_was_driven() -> None:
    run = vs.simulate(MISSION, plan=planned())
    table = run.samples()
    assert np.array_equal(table["time_s"], run.times)
    assert np.array_equal(table["x_m"], run.positions[:, 0])
    flight = vs.fly(flown())
    assert np.array_equal(flight.samples()["climb_mps"], flight.climbs)


def test_a_fleet_has_a_column_for_its_robots() -> None:
    table = fleet_plan().samples(1.0)
    assert set(table["robot"]) == {"a", "b"}
    own = table[table["robot"] == "b"]
    assert own["x_m"] == pytest.approx(np.full(len(own), 20.0))
    done = vs.simulate_fleet(PAIR, plan=fleet_plan())
    driven = done.samples(0.5)
    assert driven["distance_m"].max() == pytest.approx(40.0)
    assert driven["time_s"].max() == pytest.approx(done.end_s)


@pytest.mark.parametrize("step", [0, -1, float("nan"), 1e-12, "fine", None])
def test_a_step_that_makes_no_table_is_refused(step: Any) -> None:
    for value in (planned(), flown(), fleet_plan()):
        with pytest.raises(vs.GeometryError):
            value.samples(step)


def test_pandas_takes_the_columns_by_their_names(table: Table) -> None:
    pandas = pytest.importorskip("pandas", reason="pandas isn't installed")
    frame = pandas.DataFrame(table)
    assert tuple(frame.columns) == table.dtype.names
    assert frame["x_m"].to_numpy() == pytest.approx(table["x_m"])


def test_polars_takes_the_columns_by_their_names(table: Table) -> None:
    polars = pytest.importorskip("polars", reason="polars isn't installed")
    frame = polars.from_numpy(table)
    assert tuple(frame.columns) == table.dtype.names
    assert frame["x_m"].to_numpy() == pytest.approx(table["x_m"])
