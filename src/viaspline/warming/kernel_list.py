"""The kernels that a kind of mission was seen to need, kept beside the kernels themselves.

A list is good for the sources that it was made from: all of viaspline's, for it is the Python code
that calls the kernels. With a list a process loads in a second what it would come across one by
one, in the middle of a drive.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Final

from viaspline.kernels import kernel_cache
from viaspline.kernels.loaded_kernels import LoadedKernel, load_kernels, loaded_kernels
from viaspline.warming.mission_kind import MissionKind

LISTS: Final = "lists"
_KEY_LENGTH: Final = 16
_OWN: Final = "viaspline.warming"
_PACKAGES: Final = ("viaspline", "numba", "numpy", "scipy", "shapely")


def package_key() -> str:
    """A hash of all sources of viaspline."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for file in sorted(root.rglob("*.py")):
        digest.update(file.relative_to(root).as_posix().encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()[:_KEY_LENGTH]


@dataclass(frozen=True)
class KernelList:
    """What missions of a kind were seen to need.

    Attributes:
        modules: The dotted names of the modules that they import.
        kernels: The kernels that they call.
    """

    modules: tuple[str, ...]
    kernels: tuple[LoadedKernel, ...]

    @classmethod
    def of_this_process(cls) -> KernelList:
        """All that this process has imported, compiled and loaded."""
        return cls(tuple(sorted(_imported())), tuple(sorted(loaded_kernels())))

    @classmethod
    def read(cls, kind: MissionKind, key: str) -> KernelList | None:
        """The list of a kind, the wheel's or the user's own; None if there is none.

        Args:
            kind: Of mission.
            key: That of the sources, by ``package_key``.
        """
        for folder in kernel_cache.kernel_folders():
            with suppress(OSError, ValueError, KeyError, TypeError):
                text = (folder / LISTS / _name(kind, key)).read_text(encoding="utf-8")
                read = json.loads(text)
                kernels = tuple(LoadedKernel(*one) for one in read["kernels"])
                return cls(tuple(map(str, read["modules"])), kernels)
        return None

    def write(self, kind: MissionKind, key: str) -> None:
        """Keep it in the user's cache, if that can be."""
        if kernel_cache.CACHE_FOLDER is None:
            return
        text = json.dumps({"modules": self.modules, "kernels": self.kernels}, indent=0)
        folder = kernel_cache.CACHE_FOLDER / LISTS
        with suppress(OSError):
            folder.mkdir(exist_ok=True)
            number, name = tempfile.mkstemp(dir=folder)
            with os.fdopen(number, "w", encoding="utf-8") as file:
                file.write(text)
            Path(name).replace(folder / _name(kind, key))

    def load(self) -> tuple[LoadedKernel, ...]:
        """Import and load it all; returns what nobody has compiled yet."""
        for module in self.modules:
            if module not in sys.modules:
                with suppress(ImportError):  # of another version of a library
                    import_module(module)
        return load_kernels(self.kernels)


def _name(kind: MissionKind, key: str) -> str:
    return f"{kind.name}-{key}.json"


def _imported() -> Iterator[str]:
    """What was imported of the packages that take their time, but for what finds this out."""
    for name, module in list(sys.modules.items()):
        spec = getattr(module, "__spec__", None)
        is_one = spec is not None and spec.name == name and not name.startswith(_OWN)
        if is_one and name.partition(".")[0] in _PACKAGES:
            yield name
