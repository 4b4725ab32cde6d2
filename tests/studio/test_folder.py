from pathlib import Path

import pytest

from viaspline.studio.folder import Folder
from viaspline.studio.refused_error import RefusedError


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    root = tmp_path / "missions"
    (root / "maps").mkdir(parents=True)
    (root / "a.yaml").write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    (root / "maps" / "depot.yaml").write_text("image: depot.png\nresolution: 0.1\n")
    (tmp_path / "secret.yaml").write_text("route: {}\n")
    (root / "link.yaml").symlink_to(tmp_path / "secret.yaml")
    (root / "out").symlink_to(tmp_path)
    (root / "inner.yaml").symlink_to(root / "a.yaml")
    return Folder(root)


@pytest.mark.parametrize(
    "name",
    [
        "../secret.yaml",
        "maps/../../secret.yaml",
        "link.yaml",
        "out/secret.yaml",
        "/etc/passwd",
        "~/x.yaml",
        "",
        ".",
        "a\0.yaml",
        "nothing.yaml",
        "maps",
    ],
)
def test_nothing_outside_of_the_folder_is_opened(folder: Folder, name: str) -> None:
    with pytest.raises(RefusedError):
        folder.to_open(name)


@pytest.mark.parametrize(
    "name",
    [
        "../new.yaml",
        "link.yaml",
        "out/new.yaml",
        "/tmp/new.yaml",
        "x.json",
        "no/new.yaml",
        "maps",
        "a.yaml/b.yaml",
    ],
)
def test_nothing_outside_of_the_folder_is_saved(folder: Folder, name: str) -> None:
    with pytest.raises(RefusedError):
        folder.to_save(name)


def test_files_within_are_opened_and_listed(folder: Folder) -> None:
    assert folder.to_open("a.yaml").name == "a.yaml"
    assert folder.to_open("inner.yaml").name == "a.yaml"
    assert folder.to_save("maps/new.yaml").parent.name == "maps"
    for name in ("new.yml", "new.plan", "new.waypoints", "maps/NEW.TXT"):
        assert folder.to_save(name).name == Path(name).name
    assert folder.missions() == ["a.yaml", "inner.yaml"]
    assert folder.maps() == ["maps/depot.yaml"]


def test_what_is_told_names_files_from_the_folder(folder: Folder) -> None:
    text = f"{folder.root}/maps/depot.yaml: there is no picture {folder.root}/maps/depot.png"
    assert folder.told(text) == "maps/depot.yaml: there is no picture maps/depot.png"
