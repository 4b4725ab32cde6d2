"""A list of numbers that is taken whole is the list that YAML says it is, in the same places."""

from collections.abc import Callable, Iterator
from typing import Any
from unittest.mock import patch

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from ruamel.yaml.nodes import ScalarNode
from ruamel.yaml.scanner import Scanner

from viaspline.errors import MissionError
from viaspline.formats import number_lists, yaml_document
from viaspline.formats.number_lists import is_number_list

numbers = st.one_of(
    st.integers(-(10**6), 10**6).map(str),
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
    st.sampled_from(["0", "-0", "1e3", "2E-3", "0.50", "1e999"]),
)
odd = st.sampled_from(["+1", ".5", "1.", "0x10", "1_000", "~", "a", "'1'", "{b: 1}", "007", "1-2"])
gaps = st.sampled_from(["", " ", "  ", "\n      ", "\r\n      ", " # [1, 2]\n      "])


@st.composite
def flow(draw: Callable[[Any], Any], depth: int) -> str:
    """A flow list of some depth, laid out at random; now and then something odd in it."""
    if depth == 0:
        return draw(odd) if draw(st.integers(0, 30)) == 0 else draw(numbers)
    items = draw(st.lists(flow(depth - draw(st.integers(1, depth))), min_size=0, max_size=4))
    spaced = [draw(gaps) + item + draw(gaps) for item in items]
    return f"[{','.join(spaced)}]"


@st.composite
def block(draw: Callable[[Any], Any]) -> str:
    """A block list, most of its lines with flow lists."""
    indent = draw(st.sampled_from(["", "  ", "      "]))
    rows = draw(st.lists(flow(1) | flow(2) | st.sampled_from(["5", "{at: [1, 2]}"]), max_size=4))
    rests = st.sampled_from(["", "  ", " # then", "\n", "\n  # then\n", "\r"])
    return "".join(f"\n{indent}- {row}{draw(rests)}" for row in rows)


def everywhere(data: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    yield path
    items = enumerate(data) if isinstance(data, list) else ()
    for key, item in data.items() if isinstance(data, dict) else items:
        yield from everywhere(item, (*path, key))


def understood(text: str) -> Any:
    """The data, the place of everything in it, the faults; or the lines of what is no YAML."""
    try:
        document = yaml_document.yaml_document(text, "a.yaml")
    except MissionError as error:
        return [fault.line for fault in error.faults]
    places = [document.mark(path, at_key=False) for path in everywhere(document.data)]
    return repr(document.data), places, document.faults


def as_before(text: str) -> Any:
    """The same by a scanner that takes nothing whole."""
    with patch.object(yaml_document, "NumberListScanner", Scanner):
        return understood(text)


@given(flow(3) | block() | flow(1).map(lambda key: f"\n  {key}: 5"))
@example(" [[1, 2],\n [3, 4]]")
@example("\n  - [1, 2]\n  - [3, 4]\n  -\n   [5]")
@example("\n  - [1, 2]\n  - [3, 4]\n\n  # on\n  - 5")
@example("\n- [1, 2]\n- [3, 4]")
@example("\n  - - [1, 2]\n    - [3, 4]\n  - - [1, 2]")
@example("\n  - [1, 2]\n  - [3, 4]\n    - [5]")
@example(" -5")
def test_whatever_stands_there_is_read_as_without_taking_lists_whole(value: str) -> None:
    text = f"first: 1\nlist: {value}\nlast: [1, 2]\n"
    assert understood(text) == as_before(text)


def whole(text: str) -> int:
    """How many lists were taken whole."""
    taken: list[bool] = []

    def watched(node: Any) -> bool:
        taken.append(is_number_list(node))
        return taken[-1]

    with patch.object(yaml_document, "is_number_list", watched):
        yaml_document.yaml_document(text, "a.yaml")
    return sum(taken)


@pytest.mark.parametrize(
    "text",
    [
        "a: [[1, 2], [3, 4.5]]",
        "a: [[[1, 2], [3, 4.5]], [[-1e-3, 0]]]",
        "a:\n  - [1, 2]\n  - [3, 4]\nb: 5\n",
        "a: &b\n  - [1, 2]\n  - [3, 4]\n\n# end\n",
    ],
)
def test_lists_of_plain_numbers_are_taken_whole(text: str) -> None:
    assert whole(text) == 1


def test_a_quoted_list_and_a_negative_number_are_no_lists() -> None:
    assert not is_number_list(ScalarNode("", "[1]", None, None, style='"'))
    assert not is_number_list(ScalarNode("", "-1", None, None))


def test_a_document_of_too_many_parts_is_refused_where_it_is_too_much(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(number_lists, "MAX_PARTS", 20)
    text = "a:\n" + "".join(f"  - b{i}\n" for i in range(30))
    with pytest.raises(MissionError, match=r"a.yaml:9:4: from here on there are more than the"):
        yaml_document.yaml_document(text, "a.yaml")


def test_aliases_of_aliases_are_refused_before_they_are_followed() -> None:
    lists = [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 50)}]" for i in range(1, 9)]
    text = "\n".join(["a0: &a0 [1, 2]", *lists])
    with pytest.raises(MissionError, match="with its aliases the file has more than"):
        yaml_document.yaml_document(text, "a.yaml")


@pytest.mark.parametrize(
    ("text", "remedy"),
    [
        ("robot: {radius_m: 0,1}", "write 0.1 for 0,1"),
        ("route: {start: 0,0}", "a place as [0, 1]"),
        ("robot: {[1]: 2}", "keys are words such as route"),
    ],
)
def test_a_comma_in_a_number_or_a_place_is_told_as_what_it_is(text: str, remedy: str) -> None:
    (fault,) = yaml_document.yaml_document(text, "a.yaml").faults
    assert remedy in fault.remedy
