"""The studio's figures: from the hand to the new certified path on the screen, and page ready.

    python benchmarks/studio.py [--drags 400] [--starts 7]

A via point is dragged round in headless Chromium. Counted is what the page measures itself: from
the input event's own time stamp to the first task after the frame in which the new path was drawn.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from playwright.sync_api import sync_playwright

PATIENCE = 120_000  # [ms]
PATROL = Path(__file__).parent.parent / "examples" / "fig8-patrol.yaml"


def scene(count: int, seed: int = 1) -> dict:
    """Half discs, half polygons in 500 m x 500 m, none of them near the points of the route."""
    source = random.Random(seed)
    points = [(20, 20), (120, 300), (250, 250), (400, 120), (480, 480)]
    size = 14.0 if count <= 50 else 6.0
    known = []
    while len(known) < count:
        x, y, r = source.uniform(20, 480), source.uniform(20, 480), source.uniform(0.4, 1) * size
        if any(math.hypot(x - px, y - py) < r + 26 for px, py in points):
            continue
        if len(known) % 2:
            known.append({"circle": {"center": [x, y], "radius": r}})
            continue
        corners = sorted(source.uniform(0, 2 * math.pi) for _ in range(5))
        if max(np.diff([*corners, corners[0] + 2 * math.pi])) > 2.6:
            continue
        known.append({"polygon": [[x + r * math.cos(a), y + r * math.sin(a)] for a in corners]})
    start, *via, goal = map(list, points)
    return {
        "world": {"bounds": [0, 0, 500, 500], "known": known},
        "robot": {"radius_m": 2, "clearance_m": 0.5, "max_speed_mps": 2},
        "route": {"start": start, "via": via, "goal": goal},
    }


@contextmanager
def studio(mission: Path | None, *arguments: str):
    """A studio in a process of its own; gives its address and the seconds that it took."""
    begin = time.perf_counter()
    words = [sys.executable, "-m", "viaspline", "studio", "--port", "0", "--no-browser"]
    process = subprocess.Popen(
        [*words, *arguments, *([str(mission)] if mission else [])],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    )  # fmt: skip
    try:
        line = process.stdout.readline()
        yield line.split(" at ")[1].split(" ")[0], begin, process.pid
    finally:
        process.terminate()
        process.wait()


@contextmanager
def chromium(**options):
    """A page of headless Chromium."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium") or shutil.which("google-chrome"),
            args=["--no-sandbox"],
        )
        page = browser.new_page(viewport={"width": 1440, "height": 900}, **options)
        yield page
        browser.close()


def started(page, mission: Path) -> tuple[float, float]:
    """Seconds from the command to the page that can be laid out, and to its first plan."""
    with studio(mission) as (url, begin, _):
        opened(page, url)
        began = time.time() - (time.perf_counter() - begin)
        script = """name => performance.timeOrigin
            + performance.getEntriesByName(name)[0].startTime"""
        shown, planned = (page.evaluate(script, n) for n in ("studio-open", "studio-ready"))
        return shown / 1e3 - began, planned / 1e3 - began


def opened(page, url: str) -> None:
    page.goto(url)
    page.wait_for_selector("body[data-ready]", timeout=PATIENCE)
    page.wait_for_timeout(500)


def dragged(page, drags: int) -> list[float]:
    """Drag the second via point round; milliseconds from hand to screen."""
    x, y = page.evaluate(
        """() => {
          const box = studio.scene.canvas.getBoundingClientRect();
          const [x, y] = studio.camera.toScreen(...studio.store.doc.route.via[1]);
          return [x + box.left, y + box.top];
        }"""
    )
    page.mouse.move(x, y)
    page.mouse.down()
    source = random.Random(2)
    for i in range(drags + 20):
        if i == 20:
            page.evaluate("studio.latencies.length = 0")
        page.mouse.move(x + 14 * math.sin(i / 15), y + 14 * math.sin(i / 11))
        time.sleep(source.uniform(0.010, 0.024))  # hands don't move in step with the screen
    page.mouse.up()
    page.wait_for_timeout(300)
    assert page.evaluate("studio.store.plan.ok")
    return page.evaluate("studio.latencies")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--drags", type=int, default=400)
    parser.add_argument("--starts", type=int, default=7)
    arguments = parser.parse_args()
    print(f"load of the machine before: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    with tempfile.TemporaryDirectory() as folder, chromium() as page:
        for count in (20, 200):
            mission = Path(folder) / f"obstacles-{count}.yaml"
            mission.write_text(json.dumps(scene(count)))
            with studio(mission) as (url, _, _):
                opened(page, url)
                times = np.array(dragged(page, arguments.drags))
                ms = page.evaluate("studio.store.plan.ms")
                print(
                    f"{count} obstacles: median {np.median(times):.1f} ms, "
                    f"95th percentile {np.percentile(times, 95):.1f} ms, worst "
                    f"{times.max():.0f} ms of {len(times)} drags (the last plan took {ms:.1f} ms)"
                )
        starts = np.array([started(page, PATROL) for _ in range(arguments.starts)])
        for name, row in zip(("page open", "planned"), starts.T, strict=True):
            print(
                f"{name} after the command: median {np.median(row):.2f} s, "
                f"{row.min():.2f} to {row.max():.2f} s in {len(row)} starts"
            )


if __name__ == "__main__":
    main()
