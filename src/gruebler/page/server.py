"""The page from a server on this machine: an address with a token, one WebSocket a tab, nothing else.

Whoever does not know the token gets nothing. The Host of every request and the Origin of every WebSocket must be the
server's own, so that another page cannot reach it under a name of its own (DNS rebinding). docs/theory/explorer.md has
the protocol and the limits.
"""

from __future__ import annotations

import asyncio
import hmac
import re
import secrets
import socket
from collections import deque
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager, nullcontext, suppress
from typing import Any, Literal

import msgspec
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from gruebler.base.atomic_files import atomic_file
from gruebler.base.errors import GrueblerError, RunError
from gruebler.base.private_folder import private_folder
from gruebler.base.text import LANGUAGES, error_in_language, message, reason_of
from gruebler.page.page import module_text, served_page, style_policy
from gruebler.page.requests import error_on_page
from gruebler.page.workers import CancelledError, Workers

LARGEST = 400_000
"""Characters of a message; the document of a linkage of a hundred links has a tenth of it."""
OPENED = "opened"
"""The page of a linkage in space that is no machine of the catalog."""
MOST_WAITING = 200
"""Requests of one page that may wait; more are refused."""
_LONG = frozenset({"synthesise", "realise", "chains", "modes", "forces", "fall", "export"})
_FRAME = 4_000_000  # bytes of a frame: beyond it the connection is closed by the protocol itself
_ASKED_IN_SPACE = ("resize", "export_in_space")
_NOT_HERE = message("Open the address that gruebler explore has printed.")
_HOST = re.compile(r"(\[[0-9a-fA-F:.]+\]|[^:]+)(?::\d{1,5})?")
_POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_HEADERS = {
    "Content-Security-Policy": _POLICY,
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}


class _Message(msgspec.Struct, forbid_unknown_fields=True):
    """What a page sends: a request, or that a request is not wanted any more."""

    id: int
    method: str = ""
    params: dict[str, Any] = {}
    lang: Literal["en", "de"] = "en"
    cancel: bool = False


class ExplorerServer:
    """The application: what it answers depends on nothing but the model it opens with.

    Args:
        model: what `gruebler.page.model.model_of` returns; the page opens with it.
        token: the first part of every path.
        lang: the language of the page; that of the browser if empty.
        names: what a Host may be beside the loopback names.
        in_space: a page of a linkage in space that is no machine of the catalog, served as ``space/opened.html``.
    """

    def __init__(
        self,
        model: Mapping[str, Any],
        token: str,
        *,
        lang: str = "",
        names: frozenset[str] = frozenset(),
        in_space: str = "",
    ) -> None:
        self.model, self.token, self.lang, self.in_space = model, token, lang, in_space
        self.names = names | {"127.0.0.1", "localhost", "[::1]"}
        self._workers: Workers | None = None
        self.application = Starlette(
            routes=[
                Route("/{token}/", self._page),
                Route("/{token}/explorer.js", self._module),
                Route("/{token}/space/{id}.html", self._machine_in_space),
                Route("/{token}/space/{method}", self._asked_in_space, methods=["POST"]),
                WebSocketRoute("/{token}/ws", self._socket),
                Route("/{path:path}", self._nothing),
            ],
            middleware=[Middleware(GZipMiddleware)],  # the script is half as long, for pages that are not here
            lifespan=self._lifespan,
            exception_handlers={405: self._wrong_method},
        )

    @asynccontextmanager
    async def _lifespan(self, _: Starlette) -> AsyncIterator[None]:
        self._workers = Workers()
        await self._workers.begin()
        try:
            yield
        finally:
            await self._workers.close()

    def _known(self, request: Request | WebSocket) -> bool:
        """Whether a request names this server and knows the token."""
        named = _HOST.fullmatch(request.headers.get("host", ""))
        token = str(request.path_params.get("token", ""))
        return named is not None and named[1] in self.names and hmac.compare_digest(token.encode(), self.token.encode())

    async def _page(self, request: Request) -> Response:
        if not self._known(request):
            return self._refusal()
        text = served_page(self.model, self.lang, _language(request))
        headers = _HEADERS | {"Content-Security-Policy": f"{_POLICY}; {style_policy()}"}
        return Response(text, media_type="text/html", headers=headers)

    async def _module(self, request: Request) -> Response:
        if not self._known(request):
            return self._refusal()
        return Response(module_text(), media_type="text/javascript", headers=_HEADERS)

    async def _machine_in_space(self, request: Request) -> Response:
        """A page of its own, whose policy stands in it."""
        id = str(request.path_params["id"])
        if not self._known(request):
            return self._refusal()
        text = self.in_space
        if id != OPENED:
            assert self._workers is not None
            lang = self.lang or _language(request)
            try:
                text = await self._workers.ask("space", {"id": id}, lang, lambda _: None, asyncio.Event())
            except GrueblerError as error:
                return PlainTextResponse(f"{error}\n", status_code=404, headers=_HEADERS)
        headers = _HEADERS | {"Content-Security-Policy": "frame-ancestors 'none'"}
        return Response(text, media_type="text/html", headers=headers) if text else self._refusal()

    async def _asked_in_space(self, request: Request) -> Response:
        """Other sizes or a file of a machine in space, whose page has no WebSocket; or why there is none."""
        method = str(request.path_params["method"])
        if not self._known(request) or not _from_here(request) or method not in _ASKED_IN_SPACE:
            return self._refusal()
        assert self._workers is not None
        lang = "en"
        try:
            asked = _read(await _text_of(request))
            lang = asked.lang
            result = await self._workers.ask(method, asked.params, lang, lambda _: None, asyncio.Event())
            content = {"result": result}
        except GrueblerError as error:
            content = {"error": error_on_page(error, lang)}
        return Response(msgspec.json.encode(content), media_type="application/json", headers=_HEADERS)

    async def _nothing(self, _: Request) -> Response:
        return self._refusal()

    async def _wrong_method(self, _: Request, __: Exception) -> Response:
        return self._refusal()

    def _refusal(self) -> Response:
        text = "".join(f"{_NOT_HERE.in_language(lang)}\n" for lang in LANGUAGES)
        return PlainTextResponse(text, status_code=404, headers=_HEADERS)

    async def _socket(self, socket: WebSocket) -> None:
        if not self._known(socket) or not _from_here(socket):
            await socket.close(4403)
            return
        await socket.accept()
        assert self._workers is not None
        await _Conversation(socket, self._workers).run()


def _from_here(request: Request | WebSocket) -> bool:
    """Whether a page of this server asks."""
    host = request.headers.get("host", "")
    return request.headers.get("origin", "") in {f"{scheme}://{host}" for scheme in ("http", "https")}


async def _text_of(request: Request) -> str:
    """What a request sends, as far as a message may be long, and one byte more."""
    content = b""
    async for part in request.stream():
        content += part
        if len(content) > LARGEST:
            break
    return content.decode("utf-8", "replace")


def _language(request: Request) -> str:
    """The one of our languages that the browser asks for first."""
    asked = re.findall(r"(?:^|,)\s*([a-z]+)", request.headers.get("accept-language", "").lower())  # without regions
    return next((lang for lang in asked if lang in LANGUAGES), LANGUAGES[0])


class _Lane:
    """Requests that are answered one after the other."""

    def __init__(self) -> None:
        self.waiting: deque[tuple[_Message, asyncio.Event]] = deque()
        self.arrived = asyncio.Event()


class _Conversation:
    """One page: its requests are answered in three lanes, in each of them in their order; it may cancel any of them.

    Long work and pictures of the catalog have lanes of their own, so that what is answered at once waits for neither.
    It takes turns with pictures: one process serves both, where a second one would first have to load what the other
    has.
    """

    def __init__(self, socket: WebSocket, workers: Workers) -> None:
        self.socket, self.workers = socket, workers
        self.at_once, self.pictures, self.long = self.lanes = (_Lane(), _Lane(), _Lane())
        self.turn = asyncio.Lock()
        self.events: dict[int, asyncio.Event] = {}
        self.lock = asyncio.Lock()

    async def run(self) -> None:
        """Until the page goes."""
        answering = asyncio.gather(*(self._answer_all(lane) for lane in self.lanes))
        try:
            while True:
                received = await self.socket.receive()
                if received["type"] == "websocket.disconnect":
                    return
                await self._take(received.get("text"))
        except WebSocketDisconnect:
            return
        finally:
            answering.cancel()
            with suppress(asyncio.CancelledError):
                await answering

    async def _take(self, text: str | None) -> None:
        try:
            message = _read(text)
            if message.cancel:
                await self._cancel(message.id)
                return
            lane = self._lane(message.method)
            if len(lane.waiting) >= MOST_WAITING:
                raise GrueblerError("more than {most} requests wait; ask again later", most=MOST_WAITING)
        except GrueblerError as error:
            await self._send({"id": _id_of(text), "error": error_in_language(error, "en")})
            return
        event = self.events.setdefault(message.id, asyncio.Event())
        lane.waiting.append((message, event))
        lane.arrived.set()

    def _lane(self, method: str) -> _Lane:
        if method in _LONG:
            return self.long
        return self.pictures if method == "picture" else self.at_once

    async def _cancel(self, id: int) -> None:
        """End the work of a request; one that has not begun is answered at once, whatever goes before it."""
        if id in self.events:
            self.events[id].set()
        for lane in self.lanes:
            for request in [each for each in lane.waiting if each[0].id == id]:
                lane.waiting.remove(request)
                self.events.pop(id, None)
                await self._send({"id": id, "cancelled": True})

    async def _answer_all(self, lane: _Lane) -> None:
        while True:
            while not lane.waiting:
                lane.arrived.clear()
                await lane.arrived.wait()
            message, event = lane.waiting.popleft()
            async with nullcontext() if lane is self.long else self.turn:
                answer = await self._answer(message, event)
            self.events.pop(message.id, None)
            await self._send({"id": message.id} | answer)

    async def _answer(self, message: _Message, event: asyncio.Event) -> dict[str, Any]:
        def progress(text: str) -> None:
            task = asyncio.ensure_future(self._send({"id": message.id, "progress": text}))
            running.add(task)
            task.add_done_callback(running.discard)

        running: set[asyncio.Future[None]] = set()
        try:
            result = await self.workers.ask(message.method, message.params, message.lang, progress, event)
        except CancelledError:
            return {"cancelled": True}
        except GrueblerError as error:
            return {"error": error_on_page(error, message.lang)}
        return {"result": result}

    async def _send(self, content: dict[str, Any]) -> None:
        async with self.lock:
            try:
                await self.socket.send_text(msgspec.json.encode(content).decode("utf-8"))
            except (WebSocketDisconnect, RuntimeError):
                return  # the page has gone


def _read(text: str | None) -> _Message:
    """A message, or `GrueblerError` in one sentence."""
    if text is None:
        raise GrueblerError("a message is a text, not bytes")
    if len(text) > LARGEST:
        raise GrueblerError("a message has at most {most:,} characters, not {found:,}", most=LARGEST, found=len(text))
    try:
        return msgspec.json.decode(text.encode("utf-8"), type=_Message)
    except (msgspec.DecodeError, UnicodeEncodeError) as error:
        raise GrueblerError("this is not a message: {problem}", problem=str(error)) from None
    except RecursionError:
        raise GrueblerError("the request is nested too deeply") from None


def _id_of(text: str | None) -> int | None:
    """The number of a message that cannot be read otherwise, if it has one."""
    if text is None or len(text) > LARGEST:
        return None
    try:
        return msgspec.json.decode(text.encode("utf-8"), type=_Numbered).id
    except (msgspec.DecodeError, UnicodeEncodeError, RecursionError):
        return None


class _Numbered(msgspec.Struct):
    id: int


def kept_token() -> str:
    """The token of this user, kept from run to run so that open pages find the server again; readable by the user only.

    Where nothing can be kept it is a fresh one.
    """
    folder = private_folder()
    token = secrets.token_urlsafe(18)
    if folder is None:
        return token
    file = folder / "explorer-token"
    try:
        kept = file.read_text(encoding="ascii").strip()
        if len(kept) >= len(token):
            return kept
    except (OSError, UnicodeDecodeError):
        pass  # there is none yet, or none that can be read
    with suppress(RunError), atomic_file(file, durable=False) as stream:  # the folder is the user's own
        stream.write(token.encode("ascii"))
    return token


def bound_socket(host: str, port: int, asked: bool) -> socket.socket:
    """A socket that listens; if nobody asked for the port and it is taken, on any free one.

    Raises `GrueblerError` if it cannot listen there.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    connection = socket.socket(family, socket.SOCK_STREAM)
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        connection.bind((host, port))
    except OSError as error:
        if asked:
            connection.close()
            raise GrueblerError(
                "cannot listen on {host}, port {port}: {reason}",
                host=host,
                port=port,
                reason=reason_of(error),
            ) from None
        connection.bind((host, 0))
    return connection


def run_server(server: ExplorerServer, listening: socket.socket) -> None:
    """Serve until interrupted."""
    import uvicorn

    from gruebler.page.timed_protocol import TimedProtocol

    config = uvicorn.Config(
        server.application,
        http=TimedProtocol,
        log_level="warning",
        access_log=False,
        ws_max_size=_FRAME,
        timeout_graceful_shutdown=1,
        server_header=False,
    )
    uvicorn.Server(config).run(sockets=[listening])
