import ast
from pathlib import Path

import viaspline
from viaspline.warming.driven_kinds import IMPORTED_LATE, TURNING
from viaspline.warming.mission_kind import PARTS

SOURCE = Path(viaspline.__file__).parent
ROOMS = ("curve", "kernels", "machine", "planning", "robot", "spacetime", "trajectory", "world")


def imported_late(file: Path) -> set[str]:
    """What a file imports inside of its functions."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.FunctionDef):
            for inner in ast.walk(node):
                if isinstance(inner, ast.ImportFrom) and inner.module:
                    found.add(inner.module)
                elif isinstance(inner, ast.Import):
                    found |= {name.name for name in inner.names}
    return found


def test_whatever_planning_and_driving_import_late_is_imported_before() -> None:
    files = (file for room in ROOMS for file in (SOURCE / room).rglob("*.py"))
    assert set().union(*map(imported_late, files)) <= set(IMPORTED_LATE)


def test_the_parts_that_turn_are_parts() -> None:
    assert set(TURNING) <= set(PARTS)
