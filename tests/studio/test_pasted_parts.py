"""What of a pasted text is a part of a mission."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from shutil import which
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.formats.yaml_document import yaml_document
from viaspline.studio.page_files import PAGE_FOLDER
from viaspline.studio.pasted_parts import MAX_PASTED_CHARACTERS, pasted_parts
from viaspline.studio.refused_error import RefusedError

EXAMPLES = Path(__file__).parents[2] / "examples"
START = Callable[..., Any]


def test_a_whole_mission_file_gives_its_points_obstacles_and_areas() -> None:
    parts = pasted_parts((EXAMPLES / "fig8-patrol.yaml").read_text())
    assert set(parts) == {"route", "world"}
    assert set(parts["world"]) <= {"known", "unseen", "fences", "speed_zones"}
    names = [point.get("name") for point in parts["route"]["via"] if isinstance(point, dict)]
    assert all("heading_deg" not in point for point in parts["route"]["via"])
    assert len(names) == len(set(names) - {None}) + names.count(None)


@pytest.mark.parametrize(
    "text",
    [
        None, 7, "", "hello", "- 1", "route: {via: 5}", "route: {via: [[.inf, 0]]}", "a: [", "\0",
        "route: {via: [[1, 2]], via: [[3, 4]]}", "&a [*a]", "world: {known: [null]}",
        "x" * (MAX_PASTED_CHARACTERS + 1),
    ],
)  # fmt: skip
def test_what_holds_no_part_of_a_mission_is_refused_in_words(text: Any) -> None:
    with pytest.raises(RefusedError):
        pasted_parts(text)


def test_the_server_reads_what_is_pasted(start: START, patrol: Path) -> None:
    with start(patrol).client() as client:
        asked = client.ask("paste", "pasted", text="world: {known: [{circle: {radius: 1}}]}")
        assert asked["parts"] == {"world": {"known": [{"circle": {"radius": 1}}]}}
        assert "route.via" in client.ask("paste", "refused", text="Dear all")["message"]


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**9), 10**9) | st.text(max_size=8)
    | st.floats(-1e6, 1e6, allow_nan=False),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(st.text(max_size=6), inner, max_size=3),
    max_leaves=8,
)  # fmt: skip
WRITE = """
import {yamlOf} from %s;
process.stdout.write(yamlOf(JSON.parse(process.argv[1])));
"""


@pytest.mark.slow
@pytest.mark.skipif(which("node") is None, reason="node isn't installed")
@settings(max_examples=4, deadline=None)
@given(st.lists(st.dictionaries(st.text(max_size=6), VALUES, max_size=4), min_size=1, max_size=40))
def test_the_yaml_that_the_page_writes_reads_as_what_was_copied(items: list[Any]) -> None:
    module = (PAGE_FOLDER / "js/select/yaml.js").as_uri()
    script = WRITE % json.dumps(module)
    parts = {"world": {"known": items}}
    done = subprocess.run(
        ["node", "--input-type=module", "-e", script, json.dumps(parts)],
        check=True, capture_output=True, timeout=60,
    )  # fmt: skip
    document = yaml_document(done.stdout.decode(), "page")
    assert not document.faults
    assert document.data == parts
