"""The gallery: every example planned or driven, with its picture, its file and its time."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

from shrink_picture import shrink_picture

INTRODUCTION = """# Gallery

Every example, planned by `viaspline plan examples/…` while this page was built, or driven by
`viaspline run` where there are things that only the robot's sensor finds. A click on a picture
shows it in its full size. The time is that of the first plan of a process, without starting
Python: half a second to a second of it is loading compiled kernels, which a
[program that goes on](../benchmarks/README.md#plans-in-vector-worlds) does once.
"""
UNSEEN = re.compile(r"^  unseen:", re.MULTILINE)
PICTURES = ("fleet.png", "run.png", "plan.png")

PLANNING = ("plan_s", "laying_paths_s", "timing_s", "proving_s")
"""The stages of planning that ``timing.json`` tells of: the last three are a fleet's."""


def gallery(root: Path, work: Path, pictures: Path) -> str:
    """Plan or drive every example of the list in ``examples/README.md`` and make the page.

    Args:
        root: The checkout.
        work: Where the plans go.
        pictures: Where the pictures go; the page takes them to be in ``pictures/gallery``.

    Raises:
        RuntimeError: If an example can't be planned.
    """
    listed = (root / "examples" / "README.md").read_text(encoding="utf-8")
    parts = [INTRODUCTION]
    pictures.mkdir(parents=True, exist_ok=True)
    for name, words in re.findall(r"^\| `([\w.-]+)` \| (.+) \|$", listed, re.MULTILINE):
        out = work / name
        print(f"shows {name}", flush=True)
        mission = root / "examples" / name
        verb = "run" if UNSEEN.search(mission.read_text(encoding="utf-8")) else "plan"
        done = subprocess.run(
            [sys.executable, "-m", "viaspline", verb, mission, "--out", out],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        shown = next((out / one for one in PICTURES if (out / one).exists()), None)
        if shown is None:
            raise RuntimeError(f"{name}: {done.stdout}{done.stderr}")
        shrink_picture(shown, pictures / f"{Path(name).stem}.png")
        picture = f"pictures/gallery/{Path(name).stem}.png"
        parts.append(
            f"## {Path(name).stem}\n\n{words[0].upper()}{words[1:]}. "
            f"[`{name}`](../examples/{name}){_seconds(out)}\n\n"
            f"[![{words}]({picture})]({picture})\n"
        )
    return "\n".join(parts)


def _seconds(out: Path) -> str:
    told = json.loads((out / "timing.json").read_text(encoding="utf-8"))
    parts = [told[stage] for stage in PLANNING if stage in told]
    return f", planned in {sum(parts):.2g} s" if parts else ""
