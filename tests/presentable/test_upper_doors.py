import subprocess
import sys

import pytest

import viaspline as vs
from viaspline.errors import GeometryError
from viaspline.presentable.upper_doors import DOORS, opened, opened_for


@pytest.mark.parametrize("door", sorted(DOORS))
def test_there_is_a_function_behind_every_door(door: str) -> None:
    assert callable(opened(door))


def test_a_class_goes_through_the_door_of_the_one_above_it() -> None:
    spline = vs.CardinalSpline([(0, 0), (1, 0)])
    assert opened_for("marks", spline) is opened("marks of PiecewiseCubic")


def test_what_has_no_door_is_told() -> None:
    with pytest.raises(GeometryError, match="there is no door 'cellar'"):
        opened("cellar")
    with pytest.raises(GeometryError, match="there are no film of the class int"):
        opened_for("film", 5)


def test_a_plan_is_made_without_what_draws_it() -> None:
    code = (
        "import sys, viaspline as vs\n"
        "plan = vs.plan(vs.Mission.model_validate({'route': {'start': [0, 0], 'goal': [9, 0]}}))\n"
        "repr(plan), hash(plan), plan == plan, plan.samples(1.0)\n"
        "loaded = [m for m in sys.modules if m.startswith(('matplotlib', 'viaspline.report'))]\n"
        "sys.exit(f'loaded {loaded[:3]}' if loaded else 0)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
