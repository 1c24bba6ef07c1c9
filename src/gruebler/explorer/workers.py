"""Work for the page in processes of its own, so that it can be cancelled and a failure harms nobody else."""

from __future__ import annotations

import asyncio
import multiprocessing
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from typing import Any

from gruebler.errors import GrueblerError
from gruebler.text import error_in_language, translate

__all__ = ["CancelledError", "Workers"]

LONGEST = 120.0
"""Seconds after which a request is ended."""


class CancelledError(Exception):
    """The request was cancelled by who asked."""


def serve(pipe: Connection) -> None:
    """Answer one request after another until the pipe is closed; runs in a process of its own."""
    from gruebler.explorer.requests import answer

    while True:
        try:
            method, params, lang = pipe.recv()
        except (EOFError, KeyboardInterrupt):
            return
        try:
            result = answer(method, params, lang, lambda text: pipe.send(("progress", text)))
        except GrueblerError as error:
            pipe.send(("error", error_in_language(error, lang)))
        except KeyboardInterrupt:
            return
        except RecursionError:
            pipe.send(("error", translate("the request is nested too deeply", lang)))
        else:
            pipe.send(("result", result))


class _Worker:
    """A process and the pipe to it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, far = context.Pipe()
        self.process = context.Process(target=serve, args=(far,), daemon=True, name="gruebler explore")
        self.process.start()
        far.close()

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


class Workers:
    """At most so many processes, begun when they are needed and kept for the next request.

    Memory is bounded by their number: a request waits until one is free.
    """

    def __init__(self, most: int = 2) -> None:
        self._free: list[_Worker] = []
        self._busy: set[_Worker] = set()
        self._slots = asyncio.Semaphore(most)
        self._threads = ThreadPoolExecutor(most, thread_name_prefix="worker")

    async def ask(
        self,
        method: str,
        params: dict[str, Any],
        lang: str,
        progress: Callable[[str], None],
        cancelled: asyncio.Event,
        longest: float = LONGEST,
    ) -> Any:
        """The answer to a request of `gruebler.explorer.requests`.

        Raises `GrueblerError` with what is wrong with the question, or if its work takes too long or fails, and
        `CancelledError` once the event is set.
        """
        async with self._slots:
            if cancelled.is_set():
                raise CancelledError
            worker = self._free.pop() if self._free else _Worker()
            self._busy.add(worker)
            loop = asyncio.get_running_loop()
            done = loop.run_in_executor(
                self._threads, _exchange, worker, (method, params, lang), lambda s: loop.call_soon_threadsafe(progress, s)
            )
            stop = asyncio.ensure_future(cancelled.wait())
            try:
                await asyncio.wait({done, stop}, timeout=longest, return_when=asyncio.FIRST_COMPLETED)
                if done.done():
                    return self._result(worker, done.result(), lang)
                self._drop(worker)
                await asyncio.wait({done})
                if cancelled.is_set():
                    raise CancelledError
                raise GrueblerError("this took longer than {seconds:g} s and was ended", seconds=longest)
            finally:
                stop.cancel()

    def _result(self, worker: _Worker, found: tuple[str, Any] | None, lang: str) -> Any:
        if found is None:
            self._drop(worker)
            raise GrueblerError("gruebler failed at this request; its terminal shows the reason")
        self._busy.discard(worker)
        self._free.append(worker)
        kind, content = found
        if kind == "error":
            raise _Answered(content)
        return content

    def _drop(self, worker: _Worker) -> None:
        self._busy.discard(worker)
        worker.end()

    def close(self) -> None:
        """End all processes."""
        for worker in (*self._free, *self._busy):
            worker.end()
        self._free.clear()
        self._busy.clear()
        self._threads.shutdown(wait=False)


class _Answered(GrueblerError):
    """What a worker said, in the language of the request."""

    def __init__(self, text: str) -> None:
        super().__init__("{text}", text=text)


def _exchange(
    worker: _Worker, request: tuple[str, dict[str, Any], str], progress: Callable[[str], None]
) -> tuple[str, Any] | None:
    """Send a request and wait for its answer; None if the process ends before."""
    try:
        worker.pipe.send(request)
        while True:
            kind, content = worker.pipe.recv()
            if kind != "progress":
                return kind, content
            progress(content)
    except (EOFError, OSError):
        return None
