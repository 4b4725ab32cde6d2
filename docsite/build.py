"""Build the site of the documentation: run each page, make the reference, lay it out, check links.

    python docsite/build.py [PAGE ...] [--keep] [--gallery] [--pictures] [--no-site]

In ``build/``: ``pages/`` mirrors the repository, with the pages as they were run, so that a link
means the same file here and there; ``site/`` is the site. It needs no network, neither to be built
nor to be read; its search asks for ``python -m http.server -d build/site``.
With pages (``docs/start/five-minutes.md``) only those are run.
``--keep`` writes the pictures and the reference that were made back to ``docs/``, and the studio's
page of what is proven to it; ``--gallery`` plans or drives all examples for their page, which takes
minutes, and writes it to ``docs/``; ``--pictures`` makes the pictures that README shows anew, those
of the studio by Chromium.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from check_links import broken_links
from command_reference import command_reference, error_reference
from fences import fences, pictures
from gallery import gallery
from mission_reference import mission_reference
from proven_page import TARGET, proven_page
from run_page import PageError, run_page
from shrink_picture import shrink_picture
from standing_pictures import standing_pictures

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
RUNNING = ("python", "sh")
REFERENCE = {
    "docs/reference/mission.md": mission_reference,
    "docs/reference/commands.md": command_reference,
    "docs/reference/errors.md": error_reference,
}
FOLDERS = ("docs", "examples", "benchmarks")
FILES = ("CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "README.md")


def main() -> None:
    """Build what the arguments ask for."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("pages", nargs="*", help="run these alone (below docs/)")
    parser.add_argument("--keep", action="store_true", help="write what was made to docs/")
    parser.add_argument("--gallery", action="store_true", help="plan all examples for the gallery")
    parser.add_argument("--pictures", action="store_true", help="make README's pictures anew")
    parser.add_argument("--no-site", action="store_true", help="run the pages, and no more")
    asked = parser.parse_args()
    if asked.pictures:
        standing_pictures(ROOT, BUILD / "work-of-pictures")
    pages = gathered()
    for name, make in REFERENCE.items():
        (pages / name).write_text(make(), encoding="utf-8")
        if asked.keep:
            shutil.copyfile(pages / name, ROOT / name)
    if asked.keep:
        TARGET.write_text(proven_page(), encoding="utf-8")
    if asked.gallery:
        page = pages / "docs" / "gallery.md"
        shown = page.parent / "pictures" / "gallery"
        page.write_text(gallery(ROOT, BUILD / "work" / "gallery", shown), encoding="utf-8")
        shutil.copyfile(page, ROOT / "docs" / "gallery.md")
        shutil.copytree(shown, ROOT / "docs" / "pictures" / "gallery", dirs_exist_ok=True)
    written = sorted(str(page.relative_to(pages)) for page in (pages / "docs").rglob("*.md"))
    names = asked.pages or written
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        faults = [fault for fault in pool.map(lambda name: run(pages, name), names) if fault]
    if asked.keep:
        keep(pages, names)
    if faults:
        sys.exit("\n\n".join(faults))
    if not asked.no_site:
        lay_out()


def gathered() -> Path:
    """What the site is made of, in the folders that it has in the repository."""
    shutil.rmtree(BUILD / "work", ignore_errors=True)
    shutil.rmtree(BUILD / "pages", ignore_errors=True)
    for folder in FOLDERS:
        leave = shutil.ignore_patterns("*.py", "__pycache__")
        shutil.copytree(ROOT / folder, BUILD / "pages" / folder, ignore=leave)
    for file in FILES:
        shutil.copyfile(ROOT / file, BUILD / "pages" / file)
    (BUILD / "pages" / "docs" / "reference").mkdir(exist_ok=True)
    return BUILD / "pages"


def run(pages: Path, name: str) -> str | None:
    """Run a page in a folder of its own and take its pictures over; what went wrong, or None."""
    page = pages / name
    text = page.read_text(encoding="utf-8")
    if not any(block.language in RUNNING or block.title for block in fences(text)):
        return None
    folder = BUILD / "work" / name.removesuffix(".md")
    folder.mkdir(parents=True)
    shutil.copytree(ROOT / "examples", folder / "examples")
    print(f"runs {name}", flush=True)
    try:
        run_page(page, folder)
    except (PageError, subprocess.TimeoutExpired) as error:
        return str(error)
    for picture in pictures(text):
        if (folder / picture).is_file():
            (page.parent / picture).parent.mkdir(parents=True, exist_ok=True)
            shrink_picture(folder / picture, page.parent / picture)
    return None


def keep(pages: Path, names: list[str]) -> None:
    """Write the pictures that pages have made back to the documentation."""
    for name in names:
        for picture in pictures((pages / name).read_text(encoding="utf-8")):
            made = BUILD / "work" / name.removesuffix(".md") / picture
            kept = (ROOT / name).parent / picture
            if made.is_file():
                kept.parent.mkdir(parents=True, exist_ok=True)
                shrink_picture(made, kept)


def lay_out() -> None:
    """Make the site and check its links."""
    words = [sys.executable, "-m", "zensical", "build", "--clean", "--strict"]
    done = subprocess.run(words, cwd=ROOT, check=False)
    if done.returncode:
        sys.exit("the site can't be built: see above")
    broken = broken_links(BUILD / "site")
    if broken:
        sys.exit("\n".join(broken))
    print(f"wrote {BUILD / 'site' / 'index.html'}")


if __name__ == "__main__":
    main()
