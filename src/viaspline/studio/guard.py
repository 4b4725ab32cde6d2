"""Who may talk to the studio: pages that it served itself, to people who have its address.

A page of another site may ask the browser to connect to a port of this machine. Its Origin gives
it away; a name that was made to point here (DNS rebinding) is given away by the Host.
"""

from __future__ import annotations

import hmac
from dataclasses import dataclass
from typing import Final
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

PUBLIC_PATH: Final = "/page/"  # what is no secret: the page's own files

SECURITY_HEADERS: Final = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
        "connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    ),
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-cache",
}


@dataclass(frozen=True)
class Guard:
    """Refuses whoever comes from elsewhere.

    Attributes:
        app: What is guarded.
        hosts: What the Host may be, with the port; None: anything, the token is enough.
        token: What the address has to hold; None: nothing.
    """

    app: ASGIApp
    hosts: frozenset[str] | None
    token: str | None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or pass on."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        problem = self._problem(scope)
        if problem is None:
            await self.app(scope, receive, _with_headers(send))
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008, "reason": problem})
        else:
            response = PlainTextResponse(f"{problem}\n", 403, SECURITY_HEADERS)
            await response(scope, receive, send)

    def _problem(self, scope: Scope) -> str | None:
        headers = Headers(scope=scope)
        host, origin = headers.get("host", ""), headers.get("origin")
        if self.hosts is not None and host not in self.hosts:
            return "this studio is not reached by that name"
        if scope["type"] == "http" and scope["method"] not in ("GET", "HEAD"):
            return "nothing is sent to the studio this way"
        is_foreign = origin is not None and origin != f"http://{host}"
        if is_foreign or (scope["type"] == "websocket" and origin is None):
            return "only the studio's own page may talk to it"
        if self.token is not None and not scope["path"].startswith(PUBLIC_PATH):
            query = parse_qs(scope["query_string"].decode("latin-1"))
            given = query.get("token", [""])[0]
            if not hmac.compare_digest(given.encode(), self.token.encode()):
                return "the address lacks the studio's token"
        return None


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in SECURITY_HEADERS.items():
                headers[name] = value
        await send(message)

    return sent
