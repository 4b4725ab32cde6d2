"""Kernels that a wheel brings along, compiled for a processor that many have.

They lie in ``kernels/compiled`` of the installed package with a note that says what they were
compiled with: the versions of Python, numba, llvmlite and numpy, and what the processor has to be
able to do. Where all of that holds here they are loaded instead of being compiled; where it
doesn't they are left alone. A folder is named after a module and the key of its sources, as in
the user's own cache, so that what was compiled from other sources is never taken.
"""

from __future__ import annotations

import json
import sysconfig
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import llvmlite
import numba
import numpy
from llvmlite import binding

SHIPPED_FOLDER: Final = Path(__file__).parent / "compiled"
NOTE_NAME: Final = "compiled.json"


def compiled_with() -> dict[str, str]:
    """What a compiled kernel depends on beside its sources and the processor.

    >>> sorted(compiled_with())
    ['llvmlite', 'numba', 'numpy', 'python', 'triple']
    """
    return {
        "python": str(sysconfig.get_config_var("SOABI")),
        "numba": numba.__version__,
        "llvmlite": llvmlite.__version__,
        "numpy": numpy.__version__,
        "triple": binding.get_process_triple(),
    }


@dataclass(frozen=True)
class ShippedKernels:
    """A folder of compiled kernels that can be loaded here.

    Attributes:
        folder: Where they lie.
        target: What they were compiled for, as numba's index of them says: the triple, the name of
            the processor and its features.
    """

    folder: Path
    target: tuple[str, str, str]

    @classmethod
    def found(
        cls, folder: Path = SHIPPED_FOLDER, host: Mapping[str, bool] | None = None
    ) -> ShippedKernels | None:
        """The kernels in a folder, if there are any that fit this machine.

        Args:
            folder: With the note and the kernels.
            host: What this processor can do; None: it is asked.
        """
        try:
            note: dict[str, Any] = json.loads((folder / NOTE_NAME).read_text(encoding="utf-8"))
            features, target = note["features"].split(","), tuple(note["target"])
        except (OSError, ValueError, KeyError, AttributeError, TypeError):
            return None
        can = binding.get_host_cpu_features() if host is None else host
        needed = (feature[1:] for feature in features if feature.startswith("+"))
        if note.get("with") != compiled_with() or not all(can.get(one, False) for one in needed):
            return None
        return cls(folder, (target[0], target[1], target[2]))


def write_note(folder: Path, target: tuple[str, str, str]) -> None:
    """Say beside kernels what they were compiled with and for.

    Args:
        folder: Where they lie.
        target: The triple, the name of the processor and its features, as numba says it.
    """
    note = {"with": compiled_with(), "features": target[2], "target": list(target)}
    (folder / NOTE_NAME).write_text(json.dumps(note, indent=2) + "\n", encoding="utf-8")


SHIPPED: Final = ShippedKernels.found()
