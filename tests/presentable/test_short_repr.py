import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import viaspline as vs
from viaspline.presentable.short_repr import LONGEST, short

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
