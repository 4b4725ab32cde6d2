"""The studio as an ASGI application: the page, the pictures of maps, and the connection."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from viaspline.studio.engine import Engine
from viaspline.studio.folder import Folder
from viaspline.studio.guard import Guard
from viaspline.studio.session import Session

PAGE: Final = Path(__file__).parent / "page"


def application(
    folder: Folder,
    engine: Engine,
    *,
    name: str | None = None,
    hosts: frozenset[str] | None,
    token: str | None = None,
) -> ASGIApp:
    """The application.

    Args:
        folder: Where missions are opened and saved.
        engine: Plans and drives.
        name: The mission to begin with.
        hosts: See `Guard`.
        token: See `Guard`.
    """

    async def page(_: Request) -> Response:
        return FileResponse(PAGE / "index.html")

    async def picture(request: Request) -> Response:
        content = engine.picture(request.path_params["name"])
        if content is None:
            return PlainTextResponse("there is no such map\n", 404)
        return Response(content, media_type="image/png")

    async def talk(socket: WebSocket) -> None:
        await Session(socket, engine, folder, name).talk()

    routes = [
        Route("/", page),
        Route("/grids/{name}.png", picture),
        WebSocketRoute("/talk", talk),
        Mount("/page", StaticFiles(directory=PAGE)),
    ]
    return Guard(Starlette(routes=routes), hosts, token)
