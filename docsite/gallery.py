"""The gallery: every example planned, with its picture, its file and how long the plan took."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

from shrink_picture import shrink_picture

INTRODUCTION = """# Gallery

Every example, planned by `viaspline plan examples/…` while this page was built. The time is that of
the plan alone, without starting Python, on the machine that built the page, two cores of which were
busy.
"""
PICTURES = ("fleet.png", "plan.png")


def gallery(root: Path, work: Path, pictures: Path) -> str:
    """Plan every example of the list in ``examples/README.md`` and make the page.

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
        print(f"plans {name}", flush=True)
        done = subprocess.run(
            [sys.executable, "-m", "viaspline", "plan", root / "examples" / name, "--out", out],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        shown = next((out / one for one in PICTURES if (out / one).exists()), None)
        if shown is None:
            raise RuntimeError(f"{name}: {done.stdout}{done.stderr}")
        shrink_picture(shown, pictures / f"{Path(name).stem}.png")
        parts.append(
            f"## {Path(name).stem}\n\n{words[0].upper()}{words[1:]}. "
            f"[`{name}`](../examples/{name}){_seconds(out)}\n\n"
            f"![{words}](pictures/gallery/{Path(name).stem}.png)\n"
        )
    return "\n".join(parts)


def _seconds(out: Path) -> str:
    told = json.loads((out / "timing.json").read_text(encoding="utf-8"))
    taken = told.get("plan_s")
    return "" if taken is None else f", planned in {taken:.2g} s"
