"""OctoMaps from an encoder of our own, and from OctoMap's library where that is installed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError
from viaspline.maps.octomap import read_octomap
from viaspline.maps.voxels import Voxels

FREE, BLOCKED = 1, 2


def encoded(known: dict[tuple[int, int, int], int], side: int) -> tuple[Any, int]:
    """Bits of the node over a cube and how many nodes it is; a state where all of it has one."""
    if not known:
        return 0, 0
    if len(known) == side**3 and len(set(known.values())) == 1:
        return next(iter(known.values())), 1
    half = side // 2
    children = []
    for child in range(8):
        low = [half * (child >> axis & 1) for axis in range(3)]
        inside = {
            (x - low[0], y - low[1], z - low[2]): state
            for (x, y, z), state in known.items()
            if all(a <= b < a + half for a, b in zip(low, (x, y, z), strict=True))
        }
        children.append(encoded(inside, half))
    word, below, nodes = 0, b"", 1
    for child, (state, count) in enumerate(children):
        nodes += count
        word |= (3 if isinstance(state, bytes) else state) << (2 * child)
        below += state if isinstance(state, bytes) else b""
    return word.to_bytes(2, "little") + below, nodes


def tree(known: dict[tuple[int, int, int], int], cell: float = 0.5, depth: int = 3) -> bytes:
    """A file whose known cubes lie about the middle of the tree, ``2 ** depth`` aside."""
    bits, nodes = encoded(known, 2**depth)
    # Sixteen halvings down to one cube: each but the last keeps the corner at the middle.
    assert isinstance(bits, bytes)
    for level in range(16 - depth):
        child = 7 if level == 15 - depth else 0
        bits, nodes = (3 << (2 * child)).to_bytes(2, "little") + bits, nodes + 1
    header = f"# Octomap OcTree binary file\n# a comment\nid OcTree\nsize {nodes}\nres {cell}\n"
    return header.encode() + b"data\n" + bits


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 9999))
def test_every_cube_is_what_the_tree_says(
    seed: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    rng = np.random.default_rng(seed)
    states = rng.integers(0, 3, (8, 8, 8))
    low, high = np.sort(rng.integers(0, 9, (2, 3)), axis=0)
    states[low[0] : high[0], low[1] : high[1], low[2] : high[2]] = rng.integers(1, 3)
    states[rng.integers(8), rng.integers(8), rng.integers(8)] = BLOCKED
    states[0, 0, 0] = 0  # not all of it may have one state: the root has parts
    known = {(x, y, z): int(states[x, y, z]) for x, y, z in np.argwhere(states).tolist()}
    if not known:
        return
    file = tmp_path_factory.mktemp("map") / "a.bt"
    file.write_bytes(tree(known))
    first, beyond = np.argwhere(states).min(axis=0), np.argwhere(states).max(axis=0) + 1
    seen = states[tuple(slice(a, b) for a, b in zip(first, beyond, strict=True))]
    origin = tuple((first * 0.5).tolist())
    assert read_octomap(file) == Voxels(seen != FREE, 0.5, origin)
    assert read_octomap(file, "free") == Voxels(seen == BLOCKED, 0.5, origin)


def test_octomaps_own_library_says_the_same(tmp_path: Path) -> None:
    library = pytest.importorskip("pyoctomap")
    rng = np.random.default_rng(5)
    octree = library.OcTree(0.2)
    for x, y, z in rng.uniform(-3, 3, (800, 3)):
        octree.updateNode([x, y, z], bool(x * y + z > 0))
    for x in np.arange(-0.75, 0.8, 0.1):  # enough of one kind to be pruned
        for y in np.arange(-0.75, 0.8, 0.1):
            for z in np.arange(-0.75, 0.8, 0.1):
                octree.updateNode([x, y, z], False)
    octree.updateInnerOccupancy()
    octree.toMaxLikelihood()
    file = tmp_path / "a.bt"
    octree.writeBinary(str(file))
    voxels = read_octomap(file, "free")
    unseen = read_octomap(file, "blocked")
    nx, ny, nz = voxels.blocked.shape
    for i in range(0, nx, 2):
        for j in range(0, ny, 3):
            for k in range(nz):
                place = np.array(voxels.origin) + (np.array((i, j, k)) + 0.5) * voxels.cell
                node = octree.search(place.tolist())
                is_blocked = node is not None and octree.isNodeOccupied(node)
                assert voxels.blocked[i, j, k] == is_blocked
                assert unseen.blocked[i, j, k] == (is_blocked or node is None)


ONE = {(1, 2, 3): BLOCKED, (1, 2, 4): FREE}


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "isn't a binary OctoMap"),
        (b"# Octomap OcTree file\nid OcTree\n", "is a full OctoMap"),
        (b"# Octomap OcTree binary file\nid OcTree\nsize 3\nres 1\n", "its header has no end"),
        (tree(ONE).replace(b"res 0.5\n", b""), "the header lacks res"),
        (tree(ONE).replace(b"res 0.5", b"res -1"), 'res: found "-1"'),
        (tree(ONE).replace(b"res 0.5", b"res wide"), 'res: found "wide"'),
        (tree(ONE).replace(b"size ", b"size x"), "size: found"),
        (tree(ONE).replace(b"size ", b"size 1"), "nodes, but its header says 1"),
        (tree(ONE)[:-2], "it ends after"),
        (
            b"# Octomap OcTree binary file\nid OcTree\nsize 5\nres 0.5\ndata\n\xff\xff",
            "it ends after 9, and its header says 5 nodes",
        ),
        (tree(ONE) + b"more", "4 bytes are left over"),
        (b"# Octomap OcTree binary file\nid OcTree\nsize 0\nres 1\ndata\n", "nothing is known"),
    ],
)
def test_what_is_no_whole_tree_is_refused(data: bytes, words: str, tmp_path: Path) -> None:
    file = tmp_path / "a.bt"
    file.write_bytes(data)
    with pytest.raises(MissionError, match=words):
        read_octomap(file)


def test_a_tree_whose_finest_cubes_have_parts_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.bt"
    bits = (3).to_bytes(2, "little") * 17
    header = b"# Octomap OcTree binary file\nid OcTree\nsize 18\nres 1\ndata\n"
    file.write_bytes(header + bits)
    with pytest.raises(MissionError, match="has parts"):
        read_octomap(file)


def test_a_tree_of_more_cubes_than_are_taken_is_refused_before_they_are_made(
    tmp_path: Path,
) -> None:
    file = tmp_path / "a.bt"
    word = FREE | BLOCKED << 14  # two corners of all that a tree can hold
    header = b"# Octomap OcTree binary file\nid OcTree\nsize 3\nres 1\ndata\n"
    file.write_bytes(header + word.to_bytes(2, "little"))
    with pytest.raises(MissionError, match="65536 x 65536 x 65536 voxels"):
        read_octomap(file)
