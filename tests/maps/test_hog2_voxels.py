from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError
from viaspline.maps.hog2_voxels import read_hog2_voxels
from viaspline.maps.voxels import Voxels


def written(folder: Path, text: str) -> Path:
    file = folder / "a.3dmap"
    file.write_text(text)
    return file


@settings(deadline=None)
@given(seed=st.integers(0, 9999))
def test_what_was_written_is_read(seed: int, tmp_path_factory: pytest.TempPathFactory) -> None:
    rng = np.random.default_rng(seed)
    cubes = rng.random(rng.integers(1, 6, 3)) < 0.4
    lines = [f"voxel {' '.join(map(str, cubes.shape))}"]
    lines += (" ".join(map(str, place)) for place in rng.permutation(np.argwhere(cubes)).tolist())
    end = rng.choice(["\n", "\r\n"])
    file = written(tmp_path_factory.mktemp("map"), end.join(lines) + end * int(rng.integers(0, 3)))
    assert read_hog2_voxels(file) == Voxels(cubes, 1.0)
    assert read_hog2_voxels(file, 0.5, (1, 2, 3)) == Voxels(cubes, 0.5, (1, 2, 3))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "a.3dmap:1:1: the header of the voxels is broken"),
        ("voxel 3 3\n", "a.3dmap:1:1: the header of the voxels is broken"),
        ("voxel 3 3 0\n", "3 x 3 x 0 voxels; give at least one"),
        ("voxel 4000 4000 4000\n", "4000 x 4000 x 4000 voxels; cut it"),
        ("voxel 5000 1 1\n", "at most 4096 aside"),
        ("voxel 3 3 3\n1 1 1\n1 1\n", 'a.3dmap:3:1: found "1 1"'),
        ("voxel 3 3 3\n1 1\n1 1 1 1\n", 'a.3dmap:2:1: found "1 1"'),
        ("voxel 3 3 3\n1 1 1\n1 1 -1\n", 'a.3dmap:3:1: found "1 1 -1"'),
        ("voxel 3 3 3\n1 1 1\n\n1 1 3\n", "a.3dmap:4:1: cube 1 1 3 is outside"),
        ("voxel 3 3 3\n1 1 99999999999\n", "a.3dmap:2:1: found"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(MissionError, match=words):
        read_hog2_voxels(written(tmp_path, text))
