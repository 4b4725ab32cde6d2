"""``plan.json`` as it is read again: numbers where numbers have to be, and each fault named.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path as File
from typing import Any, Final

import numpy as np

from viaspline.bounded_file import FileKind, read_text
from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path, PathVia, ViaKind
from viaspline.errors import GeometryError, SavedPlanError
from viaspline.kernels.arrays import Floats

PLAN_FILE: Final = FileKind("plan.json", 400_000_000, "plan the mission again")
REMEDY: Final = "plan the mission again, or take the file as it was written"
MAP: Final = "map '"  # with that begins what a map is called that has no name
ON_PATH_M: Final = 1e-6  # that a via point may lie beside the path that it is on [m]


@dataclass(frozen=True)
class PlanFile:
    """What a ``plan.json`` says.

    Attributes:
        file: Where it stands.
        data: All of it.
    """

    file: File
    data: Mapping[str, Any]

    @classmethod
    def read(cls, file: File, kind: FileKind = PLAN_FILE) -> PlanFile:
        """Read one.

        Args:
            file: Where it stands.
            kind: What it is taken for.

        Raises:
            MissionError: There is no such file, or it can't be read.
            SavedPlanError: It is no plan.
        """
        try:
            data = json.loads(read_text(file, kind))
        except (ValueError, RecursionError) as error:
            raise SavedPlanError(file, f"isn't JSON ({error}); {REMEDY}") from None
        if not isinstance(data, dict):
            raise SavedPlanError(file, f"holds no plan; {REMEDY}")
        return cls(file, data)

    def wrong(self, problem: str) -> SavedPlanError:
        """The error of what is wrong in it."""
        return SavedPlanError(self.file, f"{problem}; {REMEDY}")

    def part(self, *keys: str) -> Any:
        """What stands at a key, a key in that, and so on.

        Raises:
            SavedPlanError: Nothing does.
        """
        found: Any = self.data
        for key in keys:
            if not isinstance(found, Mapping) or key not in found:
                raise self.wrong(f"has no {'.'.join(keys)}")
            found = found[key]
        return found

    def number(self, *keys: str) -> float:
        """A number that stands there; infinite where nothing limits it, which JSON can't say.

        Raises:
            SavedPlanError: Something else does.
        """
        found = self.part(*keys)
        if found is None:
            return math.inf
        if isinstance(found, bool) or not isinstance(found, int | float):
            raise self.wrong(f"{'.'.join(keys)} is {found!r:.40}, not a number")
        return float(found)

    def numbers(self, *keys: str) -> Floats:
        """An array of finite numbers that stands there.

        Raises:
            SavedPlanError: Something else does.
        """
        try:
            array = np.array(self.part(*keys), np.float64)
        except (TypeError, ValueError, OverflowError):
            raise self.wrong(f"{'.'.join(keys)} holds something else than numbers") from None
        if not np.isfinite(array).all():
            raise self.wrong(f"{'.'.join(keys)} holds something that isn't a finite number")
        return array

    def path(self) -> Path:
        """The path, with its via points where it runs through them.

        Raises:
            SavedPlanError: It is none, or a via point isn't on it.
        """
        listed = self.part("path", "vias")
        try:
            vias = [_via(one) for one in listed]
            path = Path(self.numbers("path", "spans"), vias)
            places = [np.asarray(path.evaluate(via.u)) for via in vias]
        except (GeometryError, KeyError, TypeError, ValueError, OverflowError) as error:
            raise self.wrong(f"path is none: {error}") from None
        for via, place in zip(vias, places, strict=True):
            if len(via.at) != len(place) or not math.dist(via.at, place) <= ON_PATH_M:
                raise self.wrong(f"via point '{via.name}' isn't on the path")
        return path

    def check(self, what: str, said: float, found: float, off: float) -> None:
        """Hold a number of the file against the one that was found again.

        Raises:
            SavedPlanError: They are farther off each other than they may be.
        """
        if said != found and not abs(said - found) <= off:
            raise self.wrong(f"says {said:.6g} of {what}, and {found:.6g} is found again")

    def named(self, certificate: Certificate) -> Certificate:
        """A proof that was made again, which calls a map without a name as the file does.

        Such a map is called by its file, as the mission has it, which stands elsewhere now.

        Raises:
            SavedPlanError: Something else is nearest than the file says.
        """
        said, found = self.part("certificate", "nearest"), certificate.obstacle
        if said != found:
            if not (str(said).startswith(MAP) and str(found).startswith(MAP)):
                raise self.wrong(f"says that {said!r:.80} is nearest, and it is {found!r:.80}")
            return replace(certificate, obstacle=str(said))
        return certificate


def _via(one: Mapping[str, Any]) -> PathVia:
    kinds: dict[str, ViaKind] = {"user": "user", "detour": "detour"}
    at = tuple(float(value) for value in one["at"])
    index = one["route_index"]
    dwell, u = float(one["dwell_s"]), float(one["u"])
    place = None if index is None else int(index)
    return PathVia(str(one["name"]), at, kinds[one["kind"]], u, dwell, place)
