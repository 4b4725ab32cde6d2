from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.formats.yaml_document import read_document
from viaspline.studio.yaml_round_trip import read, text_of

EXAMPLES = Path(__file__).parents[2] / "examples"

TEXT = """\
# the round
world:
  bounds: [0, 0, 500, 500]          # all of it
  known:                            # on the map
    - {name: well, circle: {center: [120, 250], radius: 12}}
    - {name: tank, polygon: [[200, 300], [230, 300], [215, 340]]}   # leaks
robot:
  radius_m: 0.50                    # measured
footprint: {corners: [[1, 2], [3, 4]]}   # of a later version
route:
  start: {at: [50, 250], heading_deg: 45}
  via:
    - [90, 330]
    - {at: [140, 170], name: pump-house}     # a station
  goal: [350, 250]
"""


def test_what_is_not_edited_stays_as_it_was_written() -> None:
    data = read(TEXT)
    assert text_of(data, TEXT) == TEXT.replace("   # leaks", "  # leaks").replace(
        "  # leaks", "   # leaks"
    )


def test_an_edit_keeps_comments_order_and_unknown_keys() -> None:
    data = read(TEXT)
    data["route"]["via"][0] = [91.5, 330]
    data["robot"]["max_speed_mps"] = 1.5
    text = text_of(data, TEXT)
    assert read(text) == data
    for kept in (
        "# the round",
        "# all of it",
        "radius_m: 0.50",
        "# a station",
        "# of a later version",
        "# leaks",
    ):
        assert kept in text
    assert "    - [91.5, 330]\n" in text


def test_a_point_taken_out_takes_only_its_own_line_along() -> None:
    data = read(TEXT)
    del data["route"]["via"][0]
    del data["world"]["known"][0]
    text = text_of(data, TEXT)
    assert read(text) == data
    assert "{at: [140, 170], name: pump-house}     # a station" in text


def test_aliases_are_written_out_rather_than_changed_twice() -> None:
    text = "route:\n  start: &a [1, 2]\n  via: [*a]\n  goal: [9, 9]\n"
    data = read(text)
    data["route"]["start"] = [5, 5]
    after = text_of(data, text)
    assert read(after) == {"route": {"start": [5, 5], "via": [[1, 2]], "goal": [9, 9]}}


@pytest.mark.parametrize("name", sorted(path.name for path in EXAMPLES.glob("*.yaml")))
def test_examples_come_back_as_they_are(name: str, tmp_path: Path) -> None:
    data = read_document(EXAMPLES / name).data
    for old in (None, (EXAMPLES / name).read_text()):
        file = tmp_path / "again.yaml"
        file.write_text(text_of(data, old))
        assert read_document(file).data == data


numbers = st.integers(-1000, 1000) | st.floats(allow_nan=False, allow_infinity=False)
names = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=8)
values = st.recursive(
    numbers | st.booleans() | st.none() | names,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from("abcd"), inner, max_size=3)
    ),
    max_leaves=12,
)
documents = st.dictionaries(
    st.sampled_from(["world", "robot", "route", "later"]), values, min_size=1
)


@given(documents, documents)
def test_any_document_is_read_as_it_was_saved_over_any_other(
    first: dict[str, object], second: dict[str, object]
) -> None:
    assert read(text_of(second, text_of(first))) == second
