"""A studio on a free port, a client that speaks its protocol, and a real browser."""

from __future__ import annotations

import gc
import json
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

from viaspline.studio.serve import Address, server_of

EXAMPLES = Path(__file__).parents[2] / "examples"
PATIENCE = 400.0  # the first plan on a machine compiles [s]

Message = dict[str, Any]


@dataclass
class Client:
    """Somebody who talks to a studio as its page does."""

    socket: ClientConnection
    hello: Message
    revision: int = 0
    heard: list[Message] = field(default_factory=list)

    def send(self, **message: Any) -> None:
        self.socket.send(json.dumps(message))

    def hear(self, kind: str) -> Message:
        """The next message of a type; others are kept in ``heard``."""
        deadline = time.monotonic() + PATIENCE
        while True:
            message: Message = json.loads(self.socket.recv(deadline - time.monotonic()))
            if message["type"] == kind:
                return message
            self.heard.append(message)

    def edit(self, *changes: list[Any]) -> Message:
        """Change the document; what came of it."""
        self.revision += 1
        self.send(type="edit", rev=self.revision, changes=list(changes))
        while (answer := self.hear("planned"))["rev"] != self.revision:
            pass
        return answer

    def ask(self, kind: str, answer: str, /, **message: Any) -> Message:
        self.send(**{"type": kind, "id": 7, **message})
        return self.hear(answer)


@dataclass
class Studio:
    """A running studio."""

    address: Address
    folder: Path

    @property
    def url(self) -> str:
        return self.address.url

    @contextmanager
    def client(self, origin: str | None = "own", query: str = "") -> Iterator[Client]:
        host = f"127.0.0.1:{self.address.port}"
        asked: Any = f"http://{host}" if origin == "own" else origin
        # No pings: while kernels are compiled the server may not answer one in time.
        with connect(
            f"ws://{host}/talk{query}", origin=asked, max_size=None, ping_interval=None
        ) as socket:
            yield Client(socket, json.loads(socket.recv(PATIENCE)))


Start = Callable[..., Studio]


@contextmanager
def running(
    mission: Path | None, host: str = "127.0.0.1", token: str | None = None
) -> Iterator[Studio]:
    address = Address.bound(host, 0, token)
    server = server_of(address, mission)
    thread = Thread(target=server.run, kwargs={"sockets": [address.listener]}, daemon=True)
    thread.start()
    while not server.started:
        time.sleep(0.005)
    root = Path() if mission is None else mission if mission.is_dir() else mission.parent
    # A planner may be stopped in the midst of a callback that hypothesis has left behind.
    callbacks, gc.callbacks[:] = gc.callbacks[:], []
    try:
        yield Studio(address, root)
    finally:
        gc.callbacks[:] = callbacks
        server.should_exit = True
        thread.join(10)
        address.listener.close()


@pytest.fixture
def start() -> Iterator[Start]:
    """Starts studios, which end with the test."""
    from contextlib import ExitStack

    with ExitStack() as stack:
        yield lambda *args, **kwargs: stack.enter_context(running(*args, **kwargs))


@pytest.fixture
def patrol(tmp_path: Path) -> Path:
    """A copy of the patrol in a folder of its own."""
    return Path(shutil.copy(EXAMPLES / "fig8-patrol.yaml", tmp_path))


def _browsers() -> Iterator[str | None]:
    for name in ("chromium", "chromium-browser", "google-chrome", "chrome"):
        yield shutil.which(name)
    yield None  # playwright's own


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Chromium without a screen, or a skip that says what is missing."""
    api = pytest.importorskip("playwright.sync_api", reason="playwright isn't installed")
    with api.sync_playwright() as playwright:
        for path in _browsers():
            is_last = path is None
            if is_last and not Path(playwright.chromium.executable_path).exists():
                break
            if not is_last and not path:
                continue
            with suppress(api.Error):
                started = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
                yield started
                started.close()
                return
        pytest.skip("no chromium on the PATH and none of playwright's: apt install chromium")


PLACE = """([x, y]) => {
  const box = studio.scene.canvas.getBoundingClientRect();
  const [px, py] = studio.camera.toScreen(x, y);
  return [px + box.left, py + box.top];
}"""

SHOWN = """async () => {
  const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  for (await wait(120); !studio.isUpToDate(); await wait(10));
}"""
"""Until the panels have followed, in the page's own time: a busy machine may be late with it."""


class Page:
    """A page of the studio, in the words of the person before it."""

    def __init__(self, page: Any, url: str) -> None:
        self.page = page
        self.errors: list[str] = []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        self.open(url)

    def open(self, url: str) -> None:
        self.page.goto(url)
        self.page.wait_for_selector("body[data-ready]", timeout=1000 * PATIENCE)
        self.settle()

    def js(self, script: str, argument: Any = None) -> Any:
        return self.page.evaluate(script, argument)

    def until(self, script: str) -> None:
        """Wait for something to become true; the page forbids waiting by eval."""
        deadline = time.monotonic() + PATIENCE
        while not self.js(script):
            assert time.monotonic() < deadline, script
            self.page.wait_for_timeout(10)

    def settle(self) -> None:
        self.until("studio.store.plan?.rev === studio.store.revision")
        self.show()

    def show(self) -> None:
        """Wait until map and panels show what the page knows."""
        self.js(SHOWN)

    @property
    def doc(self) -> Any:
        return self.js("studio.store.doc")

    @property
    def plan(self) -> Any:
        return self.js("studio.store.plan")

    def place(self, at: list[float]) -> tuple[float, float]:
        x, y = self.js(PLACE, at)
        return x, y

    def drag(self, start: list[float], end: list[float]) -> None:
        x, y = self.place(start)
        ex, ey = self.place(end)
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        mouse.move((x + ex) / 2, (y + ey) / 2, steps=4)
        mouse.move(ex, ey, steps=4)
        mouse.up()
        self.settle()

    def click(self, at: list[float]) -> None:
        self.page.mouse.click(*self.place(at))
        self.settle()

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()


@pytest.fixture
def page_of() -> type[Page]:
    """Makes a page of the studio of a browser's page and an address."""
    return Page


@pytest.fixture
def visit(browser: Any, start: Start) -> Iterator[Callable[..., Page]]:
    """Opens pages, and finds no error in any of them at the end."""
    contexts, pages = [], []

    def open_page(
        mission: Path | Any, *, width: int = 1280, height: int = 820, **options: Any
    ) -> Page:
        studio = mission if hasattr(mission, "url") else start(mission)
        context = browser.new_context(
            viewport={"width": width, "height": height}, accept_downloads=True, **options
        )
        context.set_default_timeout(1000 * PATIENCE)
        contexts.append(context)
        pages.append(Page(context.new_page(), studio.url))
        return pages[-1]

    yield open_page
    errors = [error for page in pages for error in page.errors]
    for context in contexts:
        context.close()
    assert errors == []
