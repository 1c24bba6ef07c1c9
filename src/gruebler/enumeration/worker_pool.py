"""Long runs: pieces of work done by workers that may die.

A piece is done by a pure function, so it may be done twice. Nothing is printed here; `Progress` says how far a run is.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from time import monotonic
from typing import Generic, TypeVar

from gruebler.errors import RunError

__all__ = ["ProcessPools", "Progress", "ProgressCounter", "run_work"]

P = TypeVar("P")
R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a run is."""

    pieces: int
    """Finished pieces, those of an earlier run included."""
    chains: int
    """Chains in them."""
    fresh: int
    """Chains of this run alone."""
    seconds: float
    """Since this run began."""
    expected: int | None = None
    """Chains in all, if known or estimated."""

    @property
    def rate(self) -> float:
        """Chains a second in this run."""
        return self.fresh / self.seconds if self.seconds > 0 else 0.0

    @property
    def seconds_left(self) -> float | None:
        """Estimated from the rate; None where nothing can be said yet.

        >>> Progress(3, 500, 500, 2.0, 1500).seconds_left
        4.0
        """
        if self.expected is None or not self.rate:
            return None
        return max(self.expected - self.chains, 0) / self.rate


class ProcessPools:
    """Makes process pools, one after another, whose workers end when this process does.

    Workers ignore the interrupt key; each watches a pipe that only this process holds open, so that neither a kill
    nor an interrupt leaves workers behind. `stop` ends them at once, whatever they are doing.
    """

    def __init__(self, jobs: int) -> None:
        if jobs < 1:
            raise RunError("the work is done by at least one process, not by {jobs}", jobs=jobs)
        self.jobs = jobs
        self._line: Connection | None = None

    def __call__(self) -> ProcessPoolExecutor:
        """A fresh pool; the workers of the one before are ended."""
        self.stop()
        # Forking is quick and inherits loaded kernels, but is safe only where no other thread runs.
        alone = sys.platform == "linux" and threading.active_count() == 1
        context = get_context("fork" if alone else "spawn")
        watched, self._line = context.Pipe(duplex=False)
        return ProcessPoolExecutor(
            self.jobs, mp_context=context, initializer=_begin_work, initargs=(watched, self._line)
        )

    def stop(self) -> None:
        """End the workers of the last pool."""
        if self._line is not None:
            self._line.close()
            self._line = None


def _begin_work(watched: Connection, line: Connection) -> None:
    line.close()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(watched,), daemon=True).start()


def _end_with(watched: Connection) -> None:
    """Wait until nobody holds the other end of the pipe, then end this process."""
    try:
        watched.recv_bytes()
    except (EOFError, OSError):
        os._exit(1)


def run_work(
    function: Callable[[P], R],
    work: Iterable[P],
    executor: Executor | Callable[[], Executor] | None = None,
    *,
    known: Callable[[int], R | None] | None = None,
    finished: Callable[[int, R], None] | None = None,
    ahead: int = 32,
    retries: int = 3,
) -> Iterator[R]:
    """The results of a function for every piece of work, in the order of the pieces.

    Args:
        function: a pure function of a piece; for processes, function, pieces and results can be pickled.
        work: the pieces, taken lazily.
        executor: where to do them: an executor, a function that makes one (it is then shut down here), or here if None.
        known: gives the result of the piece of a number if it need not be done any more.
        finished: called with number and result as soon as a piece is done here, in any order.
        ahead: how many pieces may be out or waiting for an earlier one.
        retries: how often in a row workers may be lost before anything is finished again.

    Results that travel between processes should be small (some kilobytes): a worker killed while it sends a large one
    leaves half of it in the pipe, and the pool waits for the rest without end. Large results go through
    `checkpoint.PieceFiles`.

    A piece lost with its worker is done again on a fresh pool. A broken `ProcessPoolExecutor` that was given is
    replaced by one of its kind for the rest.

    Raises:
        RunError: workers are lost again and again, or an executor broke that cannot be made anew.
        Whatever the function raises.
    """
    kept = known if known is not None else _nothing
    told = finished if finished is not None else _nothing
    if executor is None:
        return _done_here(function, work, kept, told)
    return _done_by(lambda: _Workers(function, executor, retries), work, kept, told, ahead)


def _nothing(*_: object) -> None:
    return None


def _done_here(
    function: Callable[[P], R],
    work: Iterable[P],
    known: Callable[[int], R | None],
    finished: Callable[[int, R], None],
) -> Iterator[R]:
    for number, piece in enumerate(work):
        result = known(number)
        if result is None:
            result = function(piece)
            finished(number, result)
        yield result


def _done_by(
    gather: Callable[[], _Workers[P, R]],
    work: Iterable[P],
    known: Callable[[int], R | None],
    finished: Callable[[int, R], None],
    ahead: int,
) -> Iterator[R]:
    crew = gather()
    ready: dict[int, R] = {}
    source = enumerate(work)
    place = 0
    exhausted = False
    try:
        while not exhausted or crew or ready:
            while not exhausted and len(crew) + len(ready) < ahead:
                number, piece = next(source, (-1, None))
                if piece is None:
                    exhausted = True
                elif (result := known(number)) is not None:
                    ready[number] = result
                else:
                    crew.send(number, piece)
            while place in ready:
                yield ready.pop(place)
                place += 1
            for number, result in crew.collect():
                finished(number, result)
                ready[number] = result
    finally:
        crew.dismiss()


class _Workers(Generic[P, R]):
    """An executor with the pieces that are out, and their rescue when workers are lost."""

    def __init__(self, function: Callable[[P], R], executor: Executor | Callable[[], Executor], retries: int) -> None:
        self.function = function
        self.given = executor
        self.own = not isinstance(executor, Executor)
        self.executor = executor if isinstance(executor, Executor) else executor()
        self.retries = retries
        self.losses = 0
        self.out: dict[Future[R], tuple[int, P]] = {}
        self.again: list[tuple[int, P]] = []

    def __len__(self) -> int:
        return len(self.out) + len(self.again)

    def send(self, number: int, piece: P) -> None:
        try:
            self.out[self.executor.submit(self.function, piece)] = number, piece
        except BrokenExecutor:
            self.again.append((number, piece))

    def collect(self) -> list[tuple[int, R]]:
        """Wait for something to be finished; everything finished now."""
        found = []
        done = wait(self.out, return_when=FIRST_COMPLETED).done if self.out else set()
        for future in done:
            number, piece = self.out.pop(future)
            try:
                found.append((number, future.result()))
            except BrokenExecutor:
                self.again.append((number, piece))
        if found:
            self.losses = 0
        if self.again:
            self._renew()
        return sorted(found, key=lambda item: item[0])

    def _renew(self) -> None:
        """Put a fresh executor in the place of a broken one, and send out again what was lost."""
        self.losses += 1
        self.again += self.out.values()
        self.out.clear()
        if self.losses > self.retries:
            raise RunError(
                "workers were lost {losses} times in a row without finishing a piece of work; is there enough "
                "memory for so many of them?",
                losses=self.losses,
            )
        if self.own:
            self.executor.shutdown(wait=True, cancel_futures=True)
        if callable(self.given):
            self.executor = self.given()
        elif isinstance(self.given, ProcessPoolExecutor):
            self.given = ProcessPools(getattr(self.given, "_max_workers", None) or os.cpu_count() or 1)
            self.executor, self.own = self.given(), True
        else:
            raise RunError(
                "the {name} broke and cannot be made anew; give a function that can", name=type(self.given).__name__
            )
        lost, self.again = sorted(self.again, key=lambda item: item[0]), []
        for number, piece in lost:
            self.send(number, piece)

    def dismiss(self) -> None:
        if isinstance(self.given, ProcessPools) and self.out:
            self.given.stop()
        elif not self.own:
            for future in self.out:
                future.cancel()
        if self.own:
            self.executor.shutdown(wait=True, cancel_futures=True)
        if isinstance(self.given, ProcessPools):
            self.given.stop()


class ProgressCounter:
    """Counts what is finished and tells how far the run is."""

    def __init__(self, tell: Callable[[Progress], None] | None, expected: int | None = None) -> None:
        self._tell = tell
        self._expected = expected
        self._begun = monotonic()
        self._pieces = self._chains = self._fresh = 0

    def add(self, chains: int, *, fresh: bool) -> None:
        """One more piece with so many chains, done in this run or kept from an earlier one."""
        self._pieces += 1
        self._chains += chains
        self._fresh += chains * fresh
        if self._tell is not None:
            seconds = monotonic() - self._begun
            self._tell(Progress(self._pieces, self._chains, self._fresh, seconds, self._expected))
