"""The studio as an ASGI application: the page, pictures of maps, scenes, and the connection.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from viaspline.studio.background.background_pictures import BackgroundPictures
from viaspline.studio.engine import Engine
from viaspline.studio.folder import Folder
from viaspline.studio.guard import Guard
from viaspline.studio.page_files import page_files
from viaspline.studio.session import Session


def application(
    folder: Folder,
    engine: Engine,
    *,
    name: str | None,
    hosts: frozenset[str] | None,
    token: str | None,
) -> ASGIApp:
    """The application.

    Args:
        folder: Where missions are opened and saved.
        engine: Plans and drives.
        name: The mission to begin with.
        hosts: See `Guard`.
        token: See `Guard`.
    """
    files = page_files()
    backgrounds = BackgroundPictures(folder)

    async def page(request: Request) -> Response:
        found = files.get(request.path_params.get("name", "index.html"))
        if found is None:
            return PlainTextResponse("there is no such file\n", 404)
        return Response(found[0], media_type=found[1])

    async def picture(request: Request) -> Response:
        content = engine.picture(request.path_params["name"])
        if content is None:
            return PlainTextResponse("there is no such map\n", 404)
        return Response(content, media_type="image/png")

    async def background(request: Request) -> Response:
        found = backgrounds.content(request.path_params["name"])
        if found is None:
            return PlainTextResponse("there is no such picture\n", 404)
        return Response(found.data, media_type=found.media_type)

    async def scene(request: Request) -> Response:
        content = engine.scene(request.path_params["name"])
        if content is None:
            return PlainTextResponse("there is no such scene\n", 404)
        return Response(content, media_type="application/json")

    async def talk(socket: WebSocket) -> None:
        await Session(socket, engine, folder, name, backgrounds).talk()

    routes = [
        Route("/", page),
        Route("/grids/{name}.png", picture),
        Route("/backgrounds/{name}", background),
        Route("/scenes/{name}.json", scene),
        WebSocketRoute("/talk", talk),
        Route("/page/{name:path}", page),
    ]
    return Guard(Starlette(routes=routes), hosts, token)
