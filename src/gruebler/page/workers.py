"""Work for the page in processes of its own, so that it can be cancelled and a failure harms nobody else."""

from __future__ import annotations

import asyncio
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import msgspec

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message

LONGEST = 120.0
"""Seconds after which a request is ended."""
_NEARLY = 0.5
"""Seconds in which a process may still answer who does not want it any more: to start another one takes longer."""
_LONG = message("this took longer than {seconds:g} s and was ended")
_ENDED = {
    "synthesise": message(
        "this took longer than {seconds:g} s and was ended; fewer targets, a fixed order of all of them or no least "
        "transmission angle take less time"
    )
}
"""What is said of requests that are so long, with what makes them shorter."""
_WIDEST = 64_000_000  # bytes of an answer


class CancelledError(Exception):
    """The request was cancelled by who asked."""


class Workers:
    """At most so many processes, begun when they are needed and kept for the next request.

    Memory is bounded by their number: a request waits until one is free.
    """

    def __init__(self, most: int = 2) -> None:
        self._free: list[Process] = []
        self._all: set[Process] = set()
        self._slots = asyncio.Semaphore(most)

    async def begin(self) -> None:
        """Start one that loads what it will need, so that the first request need not wait for it."""
        self._free.append(await self._started("load"))

    async def ask(
        self,
        method: str,
        params: dict[str, Any],
        lang: str,
        progress: Callable[[str], None],
        cancelled: asyncio.Event,
        longest: float = LONGEST,
    ) -> Any:
        """The answer to a request of `gruebler.page.requests`.

        Raises `GrueblerError` with what is wrong with the question, or if its work takes too long or fails, and
        `CancelledError` once the event is set.
        """
        async with self._slots:
            if cancelled.is_set():
                raise CancelledError
            used: list[Process] = []
            answer = asyncio.ensure_future(self._answer([method, params, lang], progress, used))
            stop = asyncio.ensure_future(cancelled.wait())
            reply = None
            try:
                await asyncio.wait({answer, stop}, timeout=longest, return_when=asyncio.FIRST_COMPLETED)
            finally:  # whoever went away leaves no process with half an answer
                stop.cancel()
                if not answer.done():
                    await asyncio.wait({answer}, timeout=_NEARLY)
                done = answer.done()
                answer.cancel()
                if done and answer.exception() is None:
                    reply = answer.result()
                if reply is not None:
                    self._free += used
                else:
                    for process in used:
                        await self._end(process)
            if cancelled.is_set():
                raise CancelledError
            if reply is None:
                if not done:
                    raise GrueblerError(
                        "{text}", text=_ENDED.get(method, _LONG).filled(seconds=longest).in_language(lang)
                    )
                answer.result()  # or what went wrong on this side
                raise GrueblerError("gruebler failed at this request; its terminal shows the reason")
            kind, content = reply
            if kind == "error":
                raise GrueblerError("{text}", text=content)
            return content

    async def _answer(
        self, request: list[Any], progress: Callable[[str], None], used: list[Process]
    ) -> tuple[str, Any] | None:
        """The answer of a process, which is in ``used`` from then on; None if it ends before it has answered.

        A process that was ended while it waited, and so has not begun, is replaced.
        """
        while True:
            waited = bool(self._free)
            used[:] = [self._free.pop() if waited else await self._started()]
            begun, reply = await _exchange(used[0], request, progress)
            if begun or not waited:
                return reply
            await self._end(used[0])

    async def _started(self, *arguments: str) -> Process:
        command = (sys.executable, "-m", "gruebler.page.worker", *arguments)
        process = await asyncio.create_subprocess_exec(*command, stdin=PIPE, stdout=PIPE, limit=_WIDEST)
        self._all.add(process)
        return process

    async def _end(self, process: Process) -> None:
        self._all.discard(process)
        if process.returncode is None:
            with suppress(ProcessLookupError):
                process.kill()
        await process.wait()

    async def close(self) -> None:
        """End all processes."""
        self._free.clear()
        for process in list(self._all):
            await self._end(process)


async def _exchange(
    process: Process, request: list[Any], progress: Callable[[str], None]
) -> tuple[bool, tuple[str, Any] | None]:
    """Send a request: whether the process has begun with it, and its answer, None if it ends before."""
    begun = False
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        process.stdin.write(msgspec.json.encode(request) + b"\n")
        await process.stdin.drain()
        while line := await process.stdout.readline():
            kind, content = msgspec.json.decode(line)
            if kind not in ("begun", "progress"):
                return True, (kind, content)
            begun = True
            if kind == "progress":
                progress(content)
    except (BrokenPipeError, ConnectionResetError):
        pass
    return begun, None
