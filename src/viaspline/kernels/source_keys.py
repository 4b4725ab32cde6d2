"""What a compiled kernel depends on: its own source, and all that it can reach.

numba's cache sees the file of a kernel alone. Here a module's key is a hash of its source and of
the sources of every kernel module that it imports, directly or not. A module that answers a
question of ``clearance/world_protocol`` belongs to all who ask it, though none of them names it.
So an edit compiles again what it may have changed, and nothing else; and no path is in a key: one
checkout's kernels serve another's, and a wheel's everybody. Who keeps compiled kernels changes
none, and is in no key.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

PACKAGE = "viaspline.kernels"
_IMPORT = re.compile(rb"^\s*(?:from|import) (viaspline\.kernels[\w.]*)(?: import ([^\n]*))?", re.M)
_ANSWERS = re.compile(rb"^@answers\w*\(", re.M)
_KEY_LENGTH = 16
KEEPERS = frozenset(
    f"{PACKAGE}.{name}"
    for name in (
        "compile_events", "compile_lock", "kernel_cache", "loaded_kernels", "shipped_kernels",
        "sooner_compiled", "source_keys",
    )
)  # fmt: skip
"""The modules that keep compiled kernels."""


@dataclass(frozen=True)
class SourceKeys:
    """The key of every kernel module, by its dotted name.

    Attributes:
        of: Sixteen hexadecimal digits for each module.
        whole: The same of all modules together.
    """

    of: Mapping[str, str]
    whole: str

    @classmethod
    def read(cls, root: Path) -> SourceKeys:
        """Read the sources below the folder of the package ``viaspline.kernels``.

        Raises:
            OSError: If a source can't be read.
        """
        files = {_name(root, file): file for file in sorted(root.rglob("*.py"))}
        sources = {name: files[name].read_bytes() for name in files if name not in KEEPERS}
        near = _neighbours(sources)
        digests = {name: hashlib.sha256(source).hexdigest() for name, source in sources.items()}
        keys = {name: _joined(digests, _reached(name, near)) for name in sources}
        return cls(keys, _joined(digests, set(sources)))


def _name(root: Path, file: Path) -> str:
    parts = file.relative_to(root).with_suffix("").parts
    return ".".join((PACKAGE, *(part for part in parts if part != "__init__")))


def _imported(source: bytes, known: Mapping[str, bytes]) -> set[str]:
    """The modules that a source imports; ``from package import module`` names one as well."""
    found = set()
    for module, names in _IMPORT.findall(source):
        home = module.decode()
        words = re.findall(r"\w+", names.decode())
        found |= {one for one in (home, *(f"{home}.{word}" for word in words)) if one in known}
    return found


def _neighbours(sources: Mapping[str, bytes]) -> dict[str, set[str]]:
    """What each module imports, and for a protocol the modules that answer it as well."""
    near = {name: _imported(source, sources) for name, source in sources.items()}
    for name, source in sources.items():
        if _ANSWERS.search(source):
            for protocol in near[name]:
                if protocol.endswith("_protocol"):
                    near[protocol] = near[protocol] | {name}
    return near


def _reached(first: str, near: Mapping[str, set[str]]) -> set[str]:
    reached, todo = {first}, [first]
    while todo:
        for one in near[todo.pop()] - reached:
            reached.add(one)
            todo.append(one)
    return reached


def _joined(digests: Mapping[str, str], names: set[str]) -> str:
    text = "\n".join(f"{name} {digests[name]}" for name in sorted(names))
    return hashlib.sha256(text.encode()).hexdigest()[:_KEY_LENGTH]
