from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viaspline as vs
from viaspline.presentable.short_repr import LONGEST, MOST_LINES, in_lines, short

anything = st.recursive(
    st.one_of(st.none(), st.text(), st.floats(), st.integers()),
    lambda inner: st.one_of(
        st.lists(inner),
        st.tuples(inner),
        st.dictionaries(st.text(), inner),
        st.frozensets(st.text()),
    ),
)


@given(value=anything)
def test_whatever_it_is_it_is_short(value: object) -> None:
    assert len(short(value)) <= LONGEST


def test_long_lists_are_counted_and_short_ones_are_told() -> None:
    assert short([1, 2]) == "[1, 2]"
    assert short((1,)) == "(1,)"
    assert short({"a": (1, 2)}) == "{'a': (1, 2)}"
    assert short(dict.fromkeys(range(9))).endswith("… 9 in all}")
    assert short(np.arange(3)) == "[0, 1, 2]"


def test_a_mission_tells_what_was_said_and_no_more() -> None:
    mission = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
    told = "Route(start=EndPoint(at=(0.0, 0.0)), goal=EndPoint(at=(9.0, 0.0)))"
    assert repr(mission) == f"Mission(route={told})"
    corners = [[np.cos(a), np.sin(a)] for a in np.linspace(0, 6, 900)]
    assert "900 in all" in repr(vs.Obstacle(polygon=corners))


EXAMPLES = Path(__file__).parents[2] / "examples"
MISSIONS = sorted(one for one in EXAMPLES.iterdir() if one.suffix in (".yaml", ".plan"))
WIDEST = 160


def is_short(value: object) -> bool:
    lines = repr(value).split("\n")
    return len(lines) <= MOST_LINES and max(map(len, lines)) <= WIDEST


@pytest.mark.filterwarnings("ignore::viaspline.errors.MissionWarning")
@pytest.mark.parametrize("file", MISSIONS, ids=lambda one: one.stem)
def test_missions_and_their_parts_are_told_in_a_line_or_ten(file: Path) -> None:
    asked = vs.load(file)
    named = [getattr(asked, name) for name in type(asked).model_fields]
    parts = [asked, *(one for one in named if not isinstance(one, tuple | dict))]
    parts += getattr(asked, "fleet", ())
    parts += [*asked.world.known, *asked.world.unseen, *asked.world.speed_zones]
    parts += [one.mission for one in getattr(asked, "members", ())]
    assert [one for one in parts if not is_short(one)] == []
    assert repr(asked) == str(asked)


@given(
    names=st.lists(st.text(min_size=1), max_size=30, unique=True),
    said=st.lists(st.text(), min_size=30, max_size=30),
)
def test_a_value_with_any_keys_takes_ten_lines_at_most(names: list[str], said: list[str]) -> None:
    told = in_lines("Value", list(zip(names, said, strict=False)))
    assert len(told.split("\n")) <= MOST_LINES or "\n" in "".join(names)
    assert max(map(len, told.split("\n"))) <= WIDEST


def _values(value: object, depth: int = 0) -> Iterator[object]:
    """A value and what can be had from it, but for the arrays that kernels see."""
    home = type(value).__module__
    if home.startswith("viaspline") and not home.startswith("viaspline.kernels"):
        yield value
    elif isinstance(value, tuple):
        for one in value[:3]:
            yield from _values(one, depth)
    if depth == 3 or not type(value).__module__.startswith("viaspline"):
        return
    for name in {*dir(type(value)), *getattr(value, "__dict__", {})}:
        if name[0] != "_" and not callable(getattr(type(value), name, None)):
            with suppress(AttributeError, NotImplementedError):
                yield from _values(getattr(value, name), depth + 1)


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_all_that_a_plan_and_a_run_hand_out_is_told_in_a_line_or_ten() -> None:
    mission = vs.load(EXAMPLES / "crossing-carts.yaml")
    assert isinstance(mission, vs.Mission)
    made = vs.plan(mission)
    fleet = vs.load(EXAMPLES / "corridor-bay.yaml")
    assert isinstance(fleet, vs.Fleet)
    of_fleet = vs.plan_fleet(fleet)
    roots = (made, vs.simulate(mission, plan=made), of_fleet)
    found = [one for root in roots for one in _values(root)]
    kinds = {type(one).__name__ for one in found}
    assert {"Plan", "Run", "Certificate", "MovingCertificate", "FleetPlan"} <= kinds
    assert {type(one).__name__ for one in found if not is_short(one)} == set()


def test_what_a_plan_went_through_is_told_in_a_line_or_ten() -> None:
    made = vs.plan(EXAMPLES / "fig7-obstacles.yaml")
    account = made.account
    parts = [account, *account.passed.values()]
    parts += [part for one in account.passed.values() for part in vars(one).values()]
    parts = [part for part in parts if type(part).__module__.startswith("viaspline")]
    assert len(parts) > 3
    assert {type(one).__name__ for one in parts if not is_short(one)} == set()
