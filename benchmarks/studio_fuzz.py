"""Random edits in a row in the studio's page; at the end the page and the command line agree.

    python benchmarks/studio_fuzz.py [--edits 10000] [--seed 1]

Points and obstacles come, go and move, sides are forced, tensions turned, everything undone and
redone, as fast as the page takes it. Looked at are errors of the page, the memory of the server
and of the page, and whether the saved mission is planned to the same bytes.
"""

from __future__ import annotations

import argparse
import base64
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from studio import chromium, opened, studio

HERE = Path(__file__).parent
PATROL = HERE.parent / "examples" / "fig8-patrol.yaml"


def memory(process: int) -> float:
    """Resident memory of a process [MB]."""
    pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    return pages * 4096 / 1e6


def heap(page) -> float:
    """What the page's JavaScript holds after collecting [MB]."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    return used / 1e6


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--edits", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    errors: list[str] = []
    with tempfile.TemporaryDirectory() as folder, chromium() as page:
        mission = Path(shutil.copy(PATROL, folder))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda m: errors.append(m.text) if m.type == "error" else None)
        with studio(mission) as (url, _, process):
            opened(page, url)
            page.evaluate((HERE / "studio_fuzz.js").read_text())
            begin, parts = time.perf_counter(), 10
            for part in range(parts):
                page.evaluate(
                    "([seed, count]) => studioFuzz(seed, count)",
                    [arguments.seed * 1000 + part, arguments.edits // parts],
                )
                print(
                    f"{(part + 1) * arguments.edits // parts} edits: "
                    f"server {memory(process):.0f} MB, page {heap(page):.1f} MB, "
                    f"{time.perf_counter() - begin:.0f} s",
                    flush=True,
                )
            assert page.evaluate("studioMend()")
            page.evaluate("studio.files.write('end.yaml', true)")
            page.wait_for_timeout(1000)
            out = Path(folder) / "out"
            words = [sys.executable, "-m", "viaspline", "plan", f"{folder}/end.yaml", "-q"]
            done = subprocess.run([*words, "--out", str(out)], check=False, capture_output=True)
            assert done.returncode == 0, done.stderr.decode()
            ask = "studio.link.ask({type: 'export', kind: 'plan.json'})"
            drawn = base64.b64decode(page.evaluate(ask)["data"])
            assert drawn == (out / "plan.json").read_bytes()
            page.goto("about:blank")
    print(f"errors of the page: {errors or 'none'}; plan.json is the same, byte by byte")
    if errors:
        sys.exit(1)


if __name__ == "__main__":
    main()
