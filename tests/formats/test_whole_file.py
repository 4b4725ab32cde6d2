from pathlib import Path

import pytest

from viaspline.errors import OutputError
from viaspline.formats.whole_file import write_whole


def test_a_text_replaces_the_file_that_was_there(tmp_path: Path) -> None:
    for text in ("route: 1\n", "ü\n"):
        write_whole(tmp_path / "m.yaml", text)
        assert (tmp_path / "m.yaml").read_bytes() == text.encode()
    assert [file.name for file in tmp_path.iterdir()] == ["m.yaml"]


def test_a_file_that_cannot_be_written_leaves_nothing_behind(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="no such file or directory"):
        write_whole(tmp_path / "none" / "m.yaml", "route: 1\n")
    (tmp_path / "folder").mkdir()
    with pytest.raises(OutputError):
        write_whole(tmp_path / "folder", "route: 1\n")
    assert [file.name for file in tmp_path.iterdir()] == ["folder"]
