import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.studio import document
from viaspline.studio.document import changed
from viaspline.studio.key_paths import path_of
from viaspline.studio.page_messages import decoded
from viaspline.studio.refused_error import RefusedError

PLAIN = {"route": {"start": [0, 0], "via": [[1, 1], {"at": [2, 2], "name": "b"}], "goal": [9, 0]}}


def test_a_document_is_not_changed_in_place() -> None:
    before = json.dumps(PLAIN)
    after = changed(PLAIN, [[["route", "via", 0], [5, 5]], [["robot"], {"radius_m": 1}]])
    assert json.dumps(PLAIN) == before
    assert after["route"]["via"][0] == [5, 5]
    assert after["robot"] == {"radius_m": 1}


def test_what_has_not_changed_is_the_same_object() -> None:
    after = changed(PLAIN, [[["route", "start"], [1, 2]]])
    assert after["route"]["via"] is PLAIN["route"]["via"]


def test_parts_are_taken_out_and_appended() -> None:
    after = changed(
        PLAIN, [[["route", "via", 0]], [["route", "via", 1], [7, 7]], [["route", "goal"]]]
    )
    assert after == {"route": {"start": [0, 0], "via": [{"at": [2, 2], "name": "b"}, [7, 7]]}}


@pytest.mark.parametrize(
    "changes",
    [
        None, 5, "x", [5], [[]], [[["route"], 1, 2]], [["route", 1]], [[[True], 1]], [[[1.5], 1]],
        [[["nowhere", "x"], 1]], [[["route", "via", 9], 1]], [[["route", "via", -1], 1]],
        [[["route", "start", "x"], 1]], [[[], [1, 2]]], [[[], None]], [[["a"] * 99, 1]],
    ],
)  # fmt: skip
def test_changes_that_make_no_sense_are_refused(changes: object) -> None:
    with pytest.raises(RefusedError):
        changed(PLAIN, changes)


def test_documents_that_are_too_large_or_too_deep_are_refused() -> None:
    circles = [{"circle": {"center": [0, 0], "radius": 1}}] * 5001
    with pytest.raises(RefusedError, match="5001 items"):
        changed(PLAIN, [[["world"], {"known": circles}]])
    with pytest.raises(RefusedError, match="values"):
        changed(PLAIN, [[["world"], {"fences": [[[0, 0]] * 200_000]}]])
    deep: object = 1
    for _ in range(40):
        deep = [deep]
    with pytest.raises(RefusedError, match="deeper"):
        changed(PLAIN, [[["world"], {"x": deep}]])
    with pytest.raises(RefusedError):
        changed(PLAIN, [[["a"], 1]] * (document.MAX_CHANGES_PER_MESSAGE + 1))


@pytest.mark.parametrize(
    "text", ["", "[]", "5", '{"type": 5}', '{"a": 1}', '{"type": "x", "v": NaN}', "[" * 100_000]
)
def test_messages_that_are_none_are_refused(text: str) -> None:
    with pytest.raises(RefusedError):
        decoded(text)


scalars = (
    st.none()
    | st.booleans()
    | st.integers(-5, 5)
    | st.floats(allow_nan=False)
    | st.text(max_size=3)
)
values = st.recursive(
    scalars,
    lambda v: st.lists(v, max_size=3) | st.dictionaries(st.text(max_size=2), v, max_size=3),
    max_leaves=8,
)


@given(st.lists(st.lists(values, max_size=3), max_size=4))
def test_any_changes_give_a_document_or_a_refusal(changes: list[object]) -> None:
    try:
        after = changed(PLAIN, changes)
    except RefusedError:
        return
    assert isinstance(after, dict)


def test_keys_are_taken_apart_as_they_are_spelt() -> None:
    from viaspline.mission.unplaced_faults import spell

    for path in (("route", "via", 2, "at"), ("world", "known", 0, "polygon", 3), ("route",), ()):
        assert path_of(spell(path)) == path
    assert math.isfinite(len(path_of("")))
