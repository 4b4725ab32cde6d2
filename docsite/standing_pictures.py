"""The pictures of ``docs/`` itself, which README and several pages show: examples and the studio.

Those of the studio are taken by Chromium without a screen.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from shrink_picture import shrink_picture

WIDTH_PX, HEIGHT_PX = 1360, 860  # of the studio's window
PATIENCE_S = 240.0

MADE = {
    "barn-run.png": ("run examples/barn-unseen.yaml", "run.png"),
    "corridor-fleet.png": ("plan examples/corridor-bay.yaml", "fleet.png"),
    "crane-site.png": ("plan examples/crane-site.yaml", "plan.png"),
    "crossing-plan.png": ("plan examples/crossing-carts.yaml", "plan.png"),
    "depot-run.png": ("run examples/depot-round.yaml", "run.png"),
    "fig3-tensions.png": ("figures", "fig3.png"),
    "fig8-run.png": ("run examples/fig8-patrol.yaml", "run.png"),
    "hill-survey.png": ("plan examples/hill-survey.yaml", "plan.png"),
    "tower-fleet.png": ("plan examples/tower-fleet.yaml", "fleet.png"),
    "yard-run.png": ("run examples/yard-rover.yaml", "run.png"),
}
"""Each picture, the command that makes it and the file that it writes."""

SHOWN = {
    "studio.png": ("fig8-patrol.yaml", ()),
    "studio-motion.png": (
        "crossing-carts.yaml",
        ("studio.store.select('known:3')", "studio.preview.seek(22)"),
    ),
    "studio-space.png": ("plant-inspection.yaml", ()),
}
"""Each picture of the studio, its mission and what is done on the page before."""


def standing_pictures(root: Path, work: Path) -> None:
    """Make all of them, in ``docs/``.

    Args:
        root: The checkout.
        work: Where the results of the examples go.

    Raises:
        subprocess.CalledProcessError: If a command fails.
    """
    for name, (words, file) in MADE.items():
        print(f"makes {name}", flush=True)
        out = work / Path(name).stem
        command = [sys.executable, "-m", "viaspline", *words.split(), "--out", str(out), "--quiet"]
        subprocess.run(command, cwd=root, check=True)
        shrink_picture(out / file, root / "docs" / name)
    for name, (mission, steps) in SHOWN.items():
        print(f"takes {name}", flush=True)
        work.mkdir(parents=True, exist_ok=True)
        with studio(root / "examples" / mission) as address:
            photograph(address, steps, work / name)
        shrink_picture(work / name, root / "docs" / name, WIDTH_PX)


@contextmanager
def studio(mission: Path) -> Iterator[str]:
    """The address of a studio that is running with a mission."""
    command = [sys.executable, "-m", "viaspline", "studio", str(mission), "--no-browser"]
    told = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with subprocess.Popen([*command, "--port", "0"], text=True, env=environment, **told) as process:
        assert process.stdout is not None
        try:
            for line in process.stdout:
                if found := re.search(r"http://\S+", line):
                    yield found[0]
                    break
        finally:
            process.terminate()


def photograph(address: str, steps: tuple[str, ...], target: Path) -> None:
    """Take the page of a studio once it has planned and the steps are done."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        found = shutil.which("chromium") or shutil.which("chromium-browser")
        browser = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": WIDTH_PX, "height": HEIGHT_PX})
        page.goto(address)
        page.wait_for_selector("body[data-ready]", timeout=1e3 * PATIENCE_S)
        settle(page)
        for step in steps:
            page.evaluate(step)
        page.wait_for_timeout(1500)  # toasts go, pictures are drawn
        page.screenshot(path=str(target))
        browser.close()


def settle(page: Any) -> None:
    """Wait until what is shown is planned."""
    until = time.monotonic() + PATIENCE_S
    while not page.evaluate("studio.store.plan?.rev === studio.store.revision"):
        if time.monotonic() > until:
            raise TimeoutError("the studio hasn't planned")
        page.wait_for_timeout(50)
