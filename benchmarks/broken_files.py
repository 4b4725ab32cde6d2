"""Broken files of terrain, voxels and way points: each ends in words that name file and remedy.

    python benchmarks/broken_files.py [FILES] [FIRST] [--kind asc 3dmap bt plan wpl] [--limit 20]

Sound files are cut short, bytes of them flipped, numbers of them swapped for absurd ones, lines
dropped and doubled. Each is checked and planned as ``viaspline`` does it, in a process with a limit
of its memory. A file may still be sound; else the exit code is 2, and what is said names the file.
Anything else is told with its seed: tracebacks, warnings of numpy, what takes too long.
"""

from __future__ import annotations

import argparse
import json
import math
import re
import resource
import tempfile
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from work_pool import done

FINE = (0, 3, 5)
MOST_BYTES = 6_000_000_000
ABSURD = [
    "nan", "-nan", "NaN", "inf", "-inf", "1e400", "-1e308", "1e308", "1e-320", "-0", "0", "-1", "2",
    "1e9", "1e10", "99999999999999999999", "4294967296", "2147483647", "65536", "0x10", "1_000",
    "1,5", "١٢", "1e", "--1", "+", "''", "null", "true", "[]", "{}", "1.5", "1000000000", "32000",
    "4096", "-9999", "1e-9", "255", "11", "10", "5", "6", "21", "22", "16", "3",
]  # fmt: skip
NUMBER = re.compile(rb"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def terrain(rng: np.random.Generator) -> bytes:
    columns, rows = (int(n) for n in rng.integers(2, 9, 2))
    lines = [f"ncols {columns}", f"nrows {rows}", "xllcorner 0", "yllcorner 0", "cellsize 10"]
    if rng.random() < 0.5:
        lines.append("NODATA_value -9999")
    lines += [" ".join(f"{h:.2f}" for h in rng.uniform(0, 5, columns)) for _ in range(rows)]
    return ("\n".join(lines) + "\n").encode()


def cubes(rng: np.random.Generator) -> bytes:
    size = rng.integers(4, 20, 3)
    places = rng.integers(0, size, (int(rng.integers(0, 40)), 3))
    lines = ["voxel " + " ".join(map(str, size)), *(" ".join(map(str, row)) for row in places)]
    return ("\n".join(lines) + "\n").encode()


def octree(rng: np.random.Generator) -> bytes:
    """A tree of random words, whole, of the sixteen levels down to its cubes."""
    words: list[int] = []

    def grow(level: int) -> None:
        word, inner = 0, 0
        for child in range(8):
            state = int(rng.integers(0, 3))
            if level < 15 and ((inner == 0 and child == 7) or (level > 12 and rng.random() < 0.2)):
                state, inner = 3, inner + 1
            word |= state << (2 * child)
        if level < 12:  # down along one line only, so that the box is small
            word = 3 << (2 * (7 if level == 0 else 0))
        words.append(word)
        for child in range(8):
            if word >> (2 * child) & 3 == 3:
                grow(level + 1)

    grow(0)
    leaves = sum(sum(word >> (2 * child) & 3 in (1, 2) for child in range(8)) for word in words)
    head = f"# Octomap OcTree binary file\nid OcTree\nsize {len(words) + leaves}\nres 0.5\ndata\n"
    return head.encode() + b"".join(word.to_bytes(2, "little") for word in words)


def plan(rng: np.random.Generator) -> bytes:
    items = []
    for k in range(int(rng.integers(2, 6))):
        frame = int(rng.choice([0, 2, 3, 5, 6, 10, 11, 3, 3]))
        height = float(np.round(rng.uniform(5, 40), 1))
        item = {
            "type": "SimpleItem", "command": int(rng.choice([16, 16, 16, 22, 21, 20, 195, 19, 18])),
            "frame": frame, "autoContinue": True, "doJumpId": k + 1,
            "params": [0, 0, 0, None, 47.0 + 1e-4 * k, 8.0 + 1e-4 * float(rng.integers(9)), height],
        }  # fmt: skip
        if rng.random() < 0.7:
            item |= {"AltitudeMode": int(rng.integers(0, 5)), "Altitude": height}
            item["AMSLAltAboveTerrain"] = None if rng.random() < 0.4 else 400 + height
        items.append(item)
    data = {
        "fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
        "mission": {"version": 2, "firmwareType": 12, "vehicleType": 2, "cruiseSpeed": 15,
                    "hoverSpeed": 5, "globalPlanAltitudeMode": int(rng.integers(0, 5)),
                    "plannedHomePosition": [47.0, 8.0, 400], "items": items},
        "geoFence": {"version": 2, "polygons": [], "circles": [
            {"circle": {"center": [47.0002, 8.001], "radius": 5}, "inclusion": False}]},
        "rallyPoints": {"version": 2, "points": []},
    }  # fmt: skip
    return json.dumps(data, indent=1).encode()


def table(rng: np.random.Generator) -> bytes:
    lines = ["QGC WPL 110", "0\t1\t0\t16\t0\t0\t0\t0\t47.0\t8.0\t400\t1"]
    for k in range(1, int(rng.integers(3, 7))):
        frame = int(rng.choice([0, 3, 3, 3, 10, 11, 5, 6, 2, 1, 7]))
        command = int(rng.choice([16, 16, 16, 22, 21, 20, 195, 19, 5001, 5003]))
        place = f"{47.0 + 1e-4 * k}\t{8.0 + 1e-4 * int(rng.integers(9))}"
        lines.append(
            f"{k}\t0\t{frame}\t{command}\t0\t0\t0\t0\t{place}\t{rng.uniform(5, 40):.1f}\t1"
        )
    return ("\n".join(lines) + "\n").encode()


KINDS: dict[str, tuple[str, Callable[[np.random.Generator], bytes]]] = {
    "asc": ("broken.asc", terrain),
    "3dmap": ("broken.3dmap", cubes),
    "bt": ("broken.bt", octree),
    "plan": ("broken.plan", plan),
    "wpl": ("broken.waypoints", table),
}


def broken(rng: np.random.Generator, data: bytes) -> bytes:
    """A file with one to three things wrong with it."""
    for _ in range(int(rng.integers(1, 4))):
        data = WRONGS[int(rng.integers(len(WRONGS)))](rng, data)
    return data


def cut_short(rng: np.random.Generator, data: bytes) -> bytes:
    return data[: int(rng.integers(0, len(data) + 1))]


def flipped(rng: np.random.Generator, data: bytes) -> bytes:
    found = bytearray(data)
    for at in rng.integers(0, max(len(found), 1), int(rng.integers(1, 4))) if found else ():
        found[at] ^= 1 << int(rng.integers(8))
    return bytes(found)


def absurd(rng: np.random.Generator, data: bytes) -> bytes:
    numbers = list(NUMBER.finditer(data))
    if not numbers:
        return data
    found = numbers[int(rng.integers(min(len(numbers), int(rng.choice([6, 1000])))))]
    return data[: found.start()] + str(rng.choice(ABSURD)).encode() + data[found.end() :]


def other_lines(rng: np.random.Generator, data: bytes) -> bytes:
    lines = data.split(b"\n")
    k = int(rng.integers(len(lines)))
    doubled = [*lines[: k + 1], *lines[k:]]
    swapped = [*lines[k:], *lines[:k]]
    return b"\n".join([lines[:k] + lines[k + 1 :], doubled, swapped][int(rng.integers(3))])


def other_bytes(rng: np.random.Generator, data: bytes) -> bytes:
    made: list[Callable[[], bytes]] = [
        lambda: b"\xef\xbb\xbf" + data,
        lambda: data.replace(b"\n", b"\r\n"),
        lambda: data.replace(b"\n", b"\r"),
        lambda: data.decode("latin-1").encode("utf-16"),
        lambda: data.replace(b".", b","),
        lambda: data + b"\0" * 9,
        lambda: data * int(rng.integers(2, 9)),
        lambda: rng.bytes(len(data)),
        lambda: data.upper(),
        lambda: data.replace(b" ", b""),
        lambda: b"",
    ]
    return made[int(rng.integers(len(made)))]()


WRONGS = (cut_short, flipped, flipped, absurd, absurd, absurd, other_lines, other_bytes)


def mission_of(kind: str, name: str) -> dict[str, object]:
    """A mission about a broken file."""
    known, ground = [], None
    if kind == "asc":
        ground = {"terrain": name, "nodata": "free"}
    else:
        known = [{"voxels": {"file": name}}]
    return {
        "world": {"known": known, **({"ground": ground} if ground else {})},
        "robot": {"radius_m": 0.4},
        "route": {"start": [-3, 1, 9.0], "goal": [40, 20, 12.0]},
    }


def run(seed: int, kinds: tuple[str, ...]) -> tuple[str, str]:
    """What became of a file: a word, and what is wrong with that."""
    from click.testing import CliRunner

    from viaspline.cli import cli

    rng = np.random.default_rng(seed)
    kind = kinds[seed % len(kinds)]
    name, make = KINDS[kind]
    with tempfile.TemporaryDirectory() as folder:
        asked = Path(folder) / name
        asked.write_bytes(broken(rng, make(rng)))
        if kind not in ("plan", "wpl"):
            asked = Path(folder) / "mission.yaml"
            asked.write_text(json.dumps(mission_of(kind, name)), encoding="utf-8")
        for command in (["check", str(asked)], ["plan", str(asked), "--out", folder + "/out"]):
            result = CliRunner().invoke(cli, command)
            said = result.output
            if result.exception is not None and not isinstance(result.exception, SystemExit):
                return "defect", repr(result.exception)[:300]
            if "Traceback" in said or "encountered in" in said:
                return "defect", said[-300:]
            if result.exit_code == 2:
                named = name in said or asked.name in said
                return "refused", "" if named else f"names no file: {said[:300]}"
            if result.exit_code not in FINE:
                return "defect", f"exit code {result.exit_code}: {said[-300:]}"
        return {0: "planned", 3: "no path", 5: "gave up"}[result.exit_code], ""


def within_memory(seed: int, kinds: tuple[str, ...]) -> tuple[str, str]:
    """The same in a process that has so much memory and no more."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    return run(seed, kinds)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", type=int, nargs="?", default=1000)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--kind", nargs="+", choices=sorted(KINDS), default=sorted(KINDS))
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--limit", type=float, default=20.0, help="seconds for a file")
    asked = parser.parse_args()
    seeds = range(asked.first, asked.first + asked.files)
    told: Counter[str] = Counter()
    job = partial(within_memory, kinds=tuple(asked.kind))
    for seed, found in done(job, seeds, asked.processes, math.inf, asked.limit):
        word, wrong = ("too slow", f"took {asked.limit:g} s, or died") if found is None else found
        told[word] += 1
        if wrong:
            print(f"{seed} {asked.kind[seed % len(asked.kind)]}: {word}: {wrong}", flush=True)
    print(", ".join(f"{count} x {word}" for word, count in sorted(told.items())))


if __name__ == "__main__":
    main()
