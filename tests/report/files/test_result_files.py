from __future__ import annotations

import os
from pathlib import Path

import pytest

from viaspline.errors import OutputError
from viaspline.report.files.result_files import ResultFolder, replacing, write


def test_a_file_is_replaced_whole(tmp_path: Path) -> None:
    file = tmp_path / "plan.json"
    file.write_text("old")
    write(file, "new")
    assert file.read_text() == "new"
    assert os.listdir(tmp_path) == ["plan.json"]


@pytest.mark.parametrize("failure", [ValueError, KeyboardInterrupt])
def test_a_failure_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, failure: type[BaseException]
) -> None:
    file = tmp_path / "plan.json"
    file.write_text("old")
    with pytest.raises(failure), replacing(file) as temporary:  # noqa: PT012
        temporary.write_text("half")
        raise failure
    assert file.read_text() == "old"
    assert os.listdir(tmp_path) == ["plan.json"]


def test_a_new_file_may_be_read_by_whom_the_umask_says(tmp_path: Path) -> None:
    write(tmp_path / "new", b"")
    (tmp_path / "usual").write_bytes(b"")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_folder_is_made_with_its_parents(tmp_path: Path) -> None:
    folder = ResultFolder(tmp_path / "a" / "b")
    folder.write("x.txt", "x")
    assert (tmp_path / "a" / "b" / "x.txt").read_text() == "x"


def test_a_folder_that_stayed_empty_is_forgotten_with_the_parents_it_made(tmp_path: Path) -> None:
    ResultFolder(tmp_path / "a" / "b").forget_if_empty()
    assert os.listdir(tmp_path) == []


def test_a_folder_that_was_there_before_is_not_forgotten(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    ResultFolder(tmp_path / "a").forget_if_empty()
    assert (tmp_path / "a").is_dir()


@pytest.mark.parametrize("below", ["", "deeper", "deeper/still"])
def test_a_file_where_the_folder_should_be_is_named_with_the_remedy(
    tmp_path: Path, below: str
) -> None:
    (tmp_path / "taken").write_text("")
    with pytest.raises(OutputError, match=r"taken: is a file, not a folder; give another"):
        ResultFolder(tmp_path / "taken" / below)


def test_a_folder_where_a_file_has_to_go_is_found_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "plan.png").mkdir()
    with pytest.raises(OutputError, match="is a folder where a file has to go"):
        ResultFolder(tmp_path, ["plan.json", "plan.png"])


@pytest.mark.skipif(os.name != "posix" or os.getuid() == 0, reason="root may write anywhere")
def test_a_read_only_folder_is_found_before_the_work(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(OutputError, match=r"permission denied.*; allow writing there"):
        ResultFolder(tmp_path)


def test_a_full_disk_is_named_with_the_remedy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OutputError, match=r"no space left on device.*free some space"):
        write(tmp_path / "x", b"x")
    assert os.listdir(tmp_path) == []


def test_earlier_results_are_noticed(tmp_path: Path) -> None:
    assert not ResultFolder(tmp_path, ["plan.json"]).holds_earlier_results()
    (tmp_path / "plan.json").write_text("")
    assert ResultFolder(tmp_path, ["plan.json"]).holds_earlier_results()
