"""The studio's server: one process, one port, until it is interrupted."""

from __future__ import annotations

import errno
import ipaddress
import secrets
import socket
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from threading import Timer
from typing import TYPE_CHECKING, Final
from urllib.parse import quote

from viaspline.errors import StudioError
from viaspline.studio.page_messages import MAX_MESSAGE_BYTES

if TYPE_CHECKING:
    import uvicorn

DEFAULT_PORT: Final = 8474
LOOPBACK_HOST: Final = "127.0.0.1"
STUDIO_PACKAGES: Final = ("starlette", "uvicorn", "websockets")


def check_installed() -> None:
    """Refuse to start without the extra.

    Raises:
        StudioError: Saying what to install.
    """
    missing = [name for name in STUDIO_PACKAGES if find_spec(name) is None]
    if missing:
        raise StudioError(
            f"the studio needs {' and '.join(missing)}, which "
            f"{'is' if len(missing) == 1 else 'are'} not installed: "
            "pip install 'viaspline[studio]'"
        )


@dataclass(frozen=True)
class Address:
    """Where the studio listens.

    Attributes:
        listener: The socket, bound.
        host: As it was asked for.
        port: The real one.
        token: What the page's address has to hold; None on loopback, unless one was asked for.
    """

    listener: socket.socket
    host: str
    port: int
    token: str | None

    @classmethod
    def bound(cls, host: str, port: int, token: str | None) -> Address:
        """Take a port.

        Args:
            host: Loopback, or an address that others can reach: then there is a token.
            port: 0 for any that is free.
            token: To be used; None: one is made where there has to be one.

        Raises:
            StudioError: It can't be had, naming the port and the remedy.
        """
        try:
            family, kind, protocol, _, place = socket.getaddrinfo(
                host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
            )[0]
        except (socket.gaierror, UnicodeError):
            problem = f"there is no address '{host}' on this machine"
            raise StudioError(f"{problem}; leave out --host for {LOOPBACK_HOST}") from None
        listener = socket.socket(family, kind, protocol)
        try:
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind(place)
            listener.listen(64)
        except OSError as error:
            listener.close()
            raise StudioError(_taken(host, port, error)) from None
        if token is None and not is_loopback(host):
            token = secrets.token_urlsafe(18)
        return cls(listener, host, int(listener.getsockname()[1]), token)

    @property
    def url(self) -> str:
        """What to open in a browser."""
        name = "localhost" if self.host in ("0.0.0.0", "::", "") else self.host
        host = f"[{name}]" if ":" in name else name
        query = "" if self.token is None else f"?token={quote(self.token)}"
        return f"http://{host}:{self.port}/{query}"

    @property
    def hosts(self) -> frozenset[str] | None:
        """What a browser may call it; None: anything."""
        if not is_loopback(self.host):
            return None
        return frozenset(f"{name}:{self.port}" for name in (LOOPBACK_HOST, "localhost", "[::1]"))


def is_loopback(host: str) -> bool:
    """Whether an address is reached from this machine only.

    >>> is_loopback("127.0.0.1"), is_loopback("localhost"), is_loopback("0.0.0.0")
    (True, True, False)
    """
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def _taken(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return (
            f"port {port} is taken, perhaps by another studio; give another one "
            f"(--port {port + 1}) or any that is free (--port 0)"
        )
    if error.errno in (errno.EACCES, errno.EPERM):
        return f"port {port} is not for everyone; give one above 1023 (--port {DEFAULT_PORT})"
    reason = (error.strerror or str(error)).lower()
    return (
        f"{host} port {port} can't be listened on ({reason}); leave out --host for {LOOPBACK_HOST}"
    )


def server_of(address: Address, mission: Path | None) -> uvicorn.Server:
    """A server that is ready to run.

    Args:
        address: Where it listens.
        mission: A mission file, or a folder of them; None: the working directory. Files are read
            and written in this folder only.

    Raises:
        MissionError: The mission can't be opened.
        RefusedError: It is a link out of its folder.
    """
    import uvicorn

    from viaspline.studio.app import application
    from viaspline.studio.document import is_fleet, is_spatial
    from viaspline.studio.engine import WARM_UP_DOCUMENT, WARM_UP_FLEET, Engine
    from viaspline.studio.folder import Folder
    from viaspline.studio.load_document import opened

    name, warm_up = None, [WARM_UP_DOCUMENT]
    root = Path() if mission is None else mission
    if mission is not None and not mission.is_dir():
        # what is wrong with it is said here, not in the page
        document = opened(mission).document
        if is_fleet(document):
            warm_up.append(WARM_UP_FLEET)
        elif is_spatial(document):
            warm_up.clear()  # what it needs is compiled for its own plan, and nothing before
        name, root = mission.name, mission.parent
    folder = Folder(root)
    if name is not None:
        folder.to_open(name)  # a link may lead out of the folder
    engine = Engine(folder, warm_up)
    engine.prepare()
    app = application(folder, engine, name=name, hosts=address.hosts, token=address.token)
    config = uvicorn.Config(
        app, ws="websockets-sansio", ws_max_size=MAX_MESSAGE_BYTES, ws_per_message_deflate=False,
        lifespan="off", log_config=None, access_log=False, server_header=False,
        timeout_graceful_shutdown=1,
    )  # fmt: skip
    return uvicorn.Server(config)


def serve(
    mission: Path | None,
    *,
    host: str = LOOPBACK_HOST,
    port: int = DEFAULT_PORT,
    token: str | None = None,
    browser: bool = True,
    say: Callable[[str], None] = print,
) -> None:
    """Serve the studio until it is interrupted.

    Args:
        mission: See `server_of`.
        host: See `Address.bound`.
        port: See `Address.bound`.
        token: See `Address.bound`.
        browser: Whether to open the page.
        say: Is told the address.

    Raises:
        StudioError: It can't be served.
        MissionError: The mission can't be opened.
    """
    check_installed()
    address = Address.bound(host, port, token)
    try:
        server = server_of(address, mission)
        say(f"the studio is at {address.url} (Ctrl-C ends it)")
        if browser:
            opening = Timer(0.3, webbrowser.open, [address.url])
            opening.daemon = True
            opening.start()
        server.run(sockets=[address.listener])
    finally:
        address.listener.close()
