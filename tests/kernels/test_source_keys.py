from collections.abc import Callable
from pathlib import Path

import grimp
import pytest

from viaspline import kernels
from viaspline.kernels import source_keys
from viaspline.kernels.source_keys import PACKAGE, SourceKeys

SOURCES = {
    "__init__.py": "",
    "heap.py": "x = 1",
    "deep/__init__.py": "",
    "deep/search.py": "from viaspline.kernels.heap import x\n",
    "deep/loop.py": "import viaspline.kernels.deep.loop_b\n",
    "deep/loop_b.py": "def f():\n    from viaspline.kernels.deep import loop\n",
    "asked_protocol.py": "def answers(): ...",
    "asker.py": "from viaspline.kernels.asked_protocol import answers\n",
    "answer.py": "from viaspline.kernels.asked_protocol import answers\n@answers(1)\ndef f(): ...",
    "route_protocol.py": "def answers_route(): ...",
    "searcher.py": "from viaspline.kernels.route_protocol import answers_route\n",
    "moves.py": (
        "from viaspline.kernels.route_protocol import answers_route\n"
        "@answers_route(1)\ndef f(): ..."
    ),
    "alone.py": "y = 2",
    "kernel_cache.py": "z = 3",
    "kept.py": "import viaspline.kernels.kernel_cache\n",
}


def _write(root: Path, **changed: str) -> SourceKeys:
    for name, text in (SOURCES | {f"{key}.py": text for key, text in changed.items()}).items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return SourceKeys.read(root)


@pytest.fixture
def moved(tmp_path: Path) -> Callable[..., set[str]]:
    def which(**changed: str) -> set[str]:
        before, after = _write(tmp_path / "before"), _write(tmp_path / "after", **changed)
        return {
            name.removeprefix(f"{PACKAGE}.")
            for name in before.of
            if before.of[name] != after.of[name]
        }

    return which


def test_the_same_sources_in_another_folder_have_the_same_keys(tmp_path: Path) -> None:
    assert _write(tmp_path / "one") == _write(tmp_path / "two")


def test_an_edit_moves_the_keys_of_those_who_reach_it_and_no_others(
    moved: Callable[..., set[str]],
) -> None:
    assert moved(heap="x = 2") == {"heap", "deep.search"}
    assert moved(alone="y = 3") == {"alone"}


def test_who_asks_a_protocol_depends_on_who_answers_it(moved: Callable[..., set[str]]) -> None:
    edit = SOURCES["answer.py"] + "  # edited"
    assert moved(answer=edit) == {"answer", "asker", "asked_protocol"}


def test_who_asks_a_protocol_of_its_own_depends_on_who_answers_it_as_well(
    moved: Callable[..., set[str]],
) -> None:
    edit = SOURCES["moves.py"] + "  # edited"
    assert moved(moves=edit) == {"moves", "searcher", "route_protocol"}


def test_a_search_for_routes_depends_on_what_its_spaces_answer() -> None:
    root = Path(kernels.__path__[0])
    files = {source_keys._name(root, file): file for file in root.rglob("*.py")}
    sources = {name: files[name].read_bytes() for name in files.keys() - source_keys.KEEPERS}
    near = source_keys._neighbours(sources)
    routing = f"{PACKAGE}.space.routing"
    for search in ("lazy_theta", "pull_taut", "way_checks", "contact_graph"):
        reached = source_keys._reached(f"{routing}.{search}", near)
        assert {f"{routing}.shape_moves", f"{routing}.voxel_moves"} <= reached


def test_who_keeps_compiled_kernels_is_in_no_key(moved: Callable[..., set[str]]) -> None:
    assert moved(kernel_cache="z = 4") == set()
    assert moved(kept="import viaspline.kernels.kernel_cache  # edited") == {"kept"}


def test_modules_that_import_each_other_move_together(moved: Callable[..., set[str]]) -> None:
    edit = SOURCES["deep/loop.py"] + "# edited"
    assert moved(**{"deep/loop": edit}) == {"deep.loop", "deep.loop_b"}


def test_any_edit_moves_the_key_of_the_whole(tmp_path: Path) -> None:
    assert _write(tmp_path / "one").whole != _write(tmp_path / "two", alone="y = 3").whole


def test_of_our_own_kernels_no_import_is_overlooked() -> None:
    root = Path(kernels.__path__[0])
    files = {source_keys._name(root, file): file for file in root.rglob("*.py")}
    sources = {name: files[name].read_bytes() for name in files.keys() - source_keys.KEEPERS}
    near = source_keys._neighbours(sources)
    graph = grimp.build_graph("viaspline", cache_dir=None)
    for module in sources:
        imported = graph.find_modules_directly_imported_by(module) & set(sources)
        assert imported <= near[module], module
