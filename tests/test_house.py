"""What holds for the whole house: every name once, every file with its tests."""

import ast
import re
from collections import defaultdict
from pathlib import Path

import grimp
import pytest

import viaspline as vs
from viaspline.kernels.loaded_kernels import LoadedKernel

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "src" / "viaspline"
FILES = sorted(path for path in SOURCE.rglob("*.py") if not path.name.startswith("__"))
THROUGH = re.compile(r"Tested through ((?:``[\w/]+``(?:,| and)?\s*)+)")


def relative(path: Path) -> str:
    return path.relative_to(SOURCE).as_posix()


def more_than_once(names: list[tuple[str, str]]) -> dict[str, list[str]]:
    """Where the names stand that stand in more than one place."""
    places = defaultdict(list)
    for name, place in names:
        places[name].append(place)
    return {name: found for name, found in places.items() if len(found) > 1}


def test_no_two_files_have_the_same_name() -> None:
    assert not more_than_once([(path.name, relative(path)) for path in FILES])


def test_no_two_classes_have_the_same_name() -> None:
    names = [
        (node.name, relative(path))
        for path in FILES
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.ClassDef)
    ]
    assert not more_than_once(names)


def test_type_checkers_find_every_public_name_where_it_is_imported_from() -> None:
    (typed,) = (
        node for node in ast.parse((SOURCE / "__init__.py").read_text()).body
        if isinstance(node, ast.If)
    )  # fmt: skip
    homes = {
        one.name: node.module for node in typed.body if isinstance(node, ast.ImportFrom)
        for one in node.names
    }  # fmt: skip
    assert homes == {name: f"viaspline.{home}" for name, home in vs._HOMES.items()}


def test_arrays_have_their_names_in_one_file() -> None:
    again = re.compile(r"^(?:Floats|Ints|Flags|Bytes|Columns)\b[^(\n]*=", re.MULTILINE)
    found = [relative(path) for path in FILES if again.search(path.read_text())]
    assert found == ["kernels/arrays.py"]


@pytest.mark.parametrize("path", FILES, ids=relative)
def test_a_file_has_tests_of_its_name_or_says_through_which_it_is_tested(path: Path) -> None:
    own = ROOT / "tests" / path.relative_to(SOURCE).with_name(f"test_{path.name}")
    if own.exists():
        return
    text = path.read_text()
    module = ast.parse(text)
    only_values = all(
        isinstance(node, ast.Import | ast.ImportFrom | ast.AnnAssign | ast.Assign | ast.Expr)
        for node in module.body
    )
    if only_values or ">>> " in text:
        return  # nothing that runs, or examples that run as doctests
    said = THROUGH.search(ast.get_docstring(module) or "")
    assert said is not None, f"{relative(path)} has no {own.name} and names no other test"
    for name in re.findall(r"``([\w/]+)``", said[1]):
        assert (ROOT / "tests" / f"{name}.py").exists(), f"{relative(path)} names {name}"


def test_a_docstring_says_what_a_thing_is_and_not_that_it_is_the_same() -> None:
    found = [relative(path) for path in FILES if '"""The same' in path.read_text()]
    assert not found


def test_tests_stand_where_their_files_do() -> None:
    rooms = {path.parent.relative_to(SOURCE).as_posix() for path in FILES}
    for test in (ROOT / "tests").rglob("test_*.py"):
        assert test.parent.relative_to(ROOT / "tests").as_posix() in rooms


def test_every_room_is_on_the_map_of_the_house() -> None:
    """By its path or, where it is told of with the room that it is in, by its name."""
    told = (ROOT / "docs" / "house.md").read_text()
    rooms = {path.parent.relative_to(SOURCE) for path in FILES} - {Path()}
    assert not [
        room.as_posix() for room in sorted(rooms)
        if f"`{room.as_posix()}/`" not in told and f"`{room.name}/`" not in told
    ]  # fmt: skip


def test_nothing_is_planned_where_tests_are_imported(
    loaded_to_collect: frozenset[LoadedKernel],
) -> None:
    """Every process that runs tests would do it before its first one: let fixtures do it."""
    assert not sorted(f"{one.module}.{one.name}" for one in loaded_to_collect)


def test_commands_of_the_documentation_name_files_that_exist() -> None:
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")):
        for name in re.findall(r"`((?:[\w-]+/)+[\w-]+\.(?:py|md|yaml))`", page.read_text()):
            places = (ROOT / name, SOURCE / name, ROOT / "src" / name)
            assert any(place.exists() for place in places), f"{page.name} names {name}"


def test_no_files_import_each_other_in_a_circle() -> None:
    """Imports inside functions count, too."""
    graph = grimp.build_graph("viaspline")
    imports = {name: graph.find_modules_directly_imported_by(name) for name in graph.modules}
    while free := [name for name, needed in imports.items() if not needed & imports.keys()]:
        for name in free:
            del imports[name]
    circle = {name: needed & imports.keys() for name, needed in imports.items()}
    assert not circle
