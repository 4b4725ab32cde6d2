"""What is read of a file that holds XML; other faults are tested in test_svg.py."""

from pathlib import Path

import pytest

from viaspline.errors import MissionError
from viaspline.maps.svg_tree import read_tree

HEAD = '<svg xmlns="http://www.w3.org/2000/svg">'


@pytest.mark.parametrize(
    ("head", "body", "fault"),
    [
        ('<!ENTITY a SYSTEM "file:///etc/passwd">', "&a;", "'a', which is another file, long or"),
        ('<!ENTITY a "x"><!ENTITY b "&a;&a;">', "", "'b', which is another file, long or made"),
        (f'<!ENTITY a "{"x" * 500}">', "", "'a', which is another file, long or made of others"),
        ('<!ENTITY % a "x">', "", "'a', which is another file, long or made of others; save"),
    ],
)
def test_entities_that_read_files_or_grow_are_refused(head: str, body: str, fault: str) -> None:
    with pytest.raises(MissionError) as caught:
        read_tree(Path("a.svg"), f"<!DOCTYPE svg [\n{head}]>{HEAD}{body}</svg>")
    assert str(caught.value).startswith("a.svg:2:")
    assert f": declares the entity {fault}" in str(caught.value)


def test_short_entities_as_illustrator_has_them_are_read() -> None:
    root = read_tree(
        Path("a.svg"),
        '<!DOCTYPE svg [<!ENTITY ns "http://www.w3.org/2000/svg">]>'
        '<svg xmlns="&ns;"><rect width="1" height="1"/></svg>',
    )
    assert [child.tag for child in root.children] == ["rect"]
