from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.studio.background.background import Background
from viaspline.studio.background.studio_settings import (
    StudioSettings,
    checked_origin,
    read_settings,
    write_settings,
)
from viaspline.studio.folder import Folder
from viaspline.studio.refused_error import RefusedError

NUMBERS = st.floats(-1e6, 1e6)
CORNERS = st.tuples(NUMBERS, NUMBERS).map(lambda low: (low, (low[0] + 1.5, low[1] + 2.5)))
BACKGROUNDS = st.builds(
    Background,
    st.text(min_size=1, max_size=20),
    st.floats(0, 1),
    st.sampled_from(["metres", "degrees", "EPSG:32632"]),
    st.none() | CORNERS,
)
SETTINGS = st.builds(
    StudioSettings,
    st.none() | st.tuples(st.floats(1, 90), st.floats(-180, 180)),
    st.none() | BACKGROUNDS,
    st.dictionaries(st.sampled_from(["later", "note"]), st.integers()),
)


@settings(max_examples=30)
@given(kept=SETTINGS)
def test_what_is_kept_is_read_again_keys_of_others_too(
    kept: StudioSettings, tmp_path_factory: pytest.TempPathFactory
) -> None:
    root = tmp_path_factory.mktemp("kept")
    write_settings(Folder(root), "a.yaml", kept)
    assert read_settings(Folder(root), "a.yaml") == (kept, ())
    before = [path.read_bytes() for path in root.iterdir()]
    write_settings(Folder(root), "a.yaml", kept)
    assert [path.read_bytes() for path in root.iterdir()] == before


def test_nothing_is_written_where_there_is_nothing_to_keep(tmp_path: Path) -> None:
    folder = Folder(tmp_path)
    write_settings(folder, "a.yaml", StudioSettings())
    assert list(tmp_path.iterdir()) == []
    write_settings(folder, "a.yaml", StudioSettings((47.0, 8.0)))
    write_settings(folder, "a.yaml", StudioSettings())
    assert read_settings(folder, "a.yaml") == (StudioSettings(), ())


@pytest.mark.parametrize(
    "text",
    [
        "no json", "[]", '{"origin": 5}', '{"origin": [91, 0]}', '{"origin": [NaN, 0]}',
        '{"origin": [true, false]}', '{"origin": [0, 0]}', '{"background": 3}',
        '{"background": {}}', '{"background": {"picture": "x", "colour": 1}}',
        '{"background": {"picture": "x", "opacity": 2}}',
        '{"background": {"picture": "x", "grid": "feet"}}',
        '{"background": {"picture": "x", "corners": [[0, 0], [0, 5]]}}',
        '{"background": {"picture": "x", "corners": [[0, 0], ["1", 5]]}}', "[" * 100_000,
    ],
)  # fmt: skip
def test_a_broken_file_is_left_out_and_told_of(tmp_path: Path, text: str) -> None:
    (tmp_path / "a.yaml.studio.json").write_text(text)
    found, (note,) = read_settings(Folder(tmp_path), "a.yaml")
    assert found == StudioSettings()
    assert note.startswith("a.yaml.studio.json is left out: ")
    assert str(tmp_path) not in note


def test_it_is_neither_read_nor_written_through_a_link_out_of_the_folder(tmp_path: Path) -> None:
    inner = tmp_path / "missions"
    inner.mkdir()
    (tmp_path / "secret").write_text('{"origin": [47, 8]}')
    (inner / "a.yaml.studio.json").symlink_to(tmp_path / "secret")
    assert read_settings(Folder(inner), "a.yaml")[0].origin is None
    with pytest.raises(RefusedError, match="outside"):
        write_settings(Folder(inner), "a.yaml", StudioSettings((1.0, 2.0)))


def test_a_picture_is_named_from_the_folder_that_a_mission_is_saved_in(tmp_path: Path) -> None:
    kept = StudioSettings(background=Background("pictures/site.png"))
    moved = kept.moved(tmp_path, tmp_path / "rounds").background
    assert moved is not None
    assert moved.picture == "../pictures/site.png"
    assert kept.moved(tmp_path, tmp_path) is kept


@pytest.mark.parametrize("pair", [(91.0, 8.0), (47.0, 181.0), (0.0, 0.0), ("a", 8.0), (True, 1)])
def test_an_origin_that_is_nowhere_is_refused(pair: tuple[object, object]) -> None:
    with pytest.raises(RefusedError, match="can't be the origin"):
        checked_origin(*pair)
