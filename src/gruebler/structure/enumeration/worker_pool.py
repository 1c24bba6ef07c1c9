"""Long runs: pieces of work in worker processes, with recovery when workers are lost.

A pure function processes a piece, so it may run twice. Nothing is printed here; `Progress` reports the state of a run.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from time import monotonic
from typing import Generic, TypeVar

from gruebler.base.errors import RunError

P = TypeVar("P")
R = TypeVar("R")


@dataclass(frozen=True, slots=True, kw_only=True)
class Progress:
    """The state of a run."""

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
        """Estimated from the rate; None before there is a rate.

        >>> Progress(pieces=3, chains=500, fresh=500, seconds=2.0, expected=1500).seconds_left
        4.0
        """
        if self.expected is None or not self.rate:
            return None
        return max(self.expected - self.chains, 0) / self.rate


class ProcessPools:
    """Creates process pools, one after another, whose workers end when this process does.

    Workers ignore the interrupt key; each watches a pipe that only this process keeps open, so that neither a kill
    nor an interrupt leaves workers behind. `stop` terminates them immediately.
    """

    def __init__(self, jobs: int) -> None:
        if jobs < 1:
            raise RunError("the work needs at least one process, not {jobs}", jobs=jobs)
        self.jobs = jobs
        self._line: Connection | None = None

    def __call__(self) -> ProcessPoolExecutor:
        """A new pool; the workers of the previous one are terminated."""
        self.stop()
        # Forking is quick and inherits loaded kernels, but is safe only where no other thread runs.
        alone = sys.platform == "linux" and threading.active_count() == 1
        context = get_context("fork" if alone else "spawn")
        watched, self._line = context.Pipe(duplex=False)
        return ProcessPoolExecutor(
            self.jobs, mp_context=context, initializer=_begin_work, initargs=(watched, self._line)
        )

    def stop(self) -> None:
        """Terminate the workers of the last pool."""
        if self._line is not None:
            self._line.close()
            self._line = None


def _begin_work(watched: Connection, line: Connection) -> None:
    line.close()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(watched,), daemon=True).start()


def _end_with(watched: Connection) -> None:
    """Wait until the other end of the pipe is closed, then end this process."""
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
) -> Generator[R]:
    """The results of a function for every piece of work, in the order of the pieces.

    Args:
        function: a pure function of a piece; for processes, function, pieces and results can be pickled.
        work: the pieces, taken lazily.
        executor: an executor, a function that creates one (this function then shuts it down), or None for this process.
        known: returns the result of a piece, by its number, if an earlier run has finished it.
        finished: called with number and result as soon as a piece is finished, in any order.
        ahead: the largest number of pieces that are pending or waiting for an earlier one; more for an executor of many
            workers, so that none of them waits for work.
        retries: the number of successive losses of workers that is tolerated without a finished piece between them.

    Results that are sent between processes should be small (some kilobytes): a worker killed while it sends a large one
    leaves half of it in the pipe, and the pool waits for the remainder without end. Large results go through
    `checkpoint.PieceFiles`.

    A piece lost with its worker runs again on a new pool. A broken `ProcessPoolExecutor` from the caller is
    replaced by one of its kind.

    Raises:
        RunError: workers are lost repeatedly, or an executor broke and cannot be replaced.
        Any error of the function.
    """
    earlier_result = known if known is not None else _nothing
    report = finished if finished is not None else _nothing
    if executor is None:
        return _done_here(function, work, earlier_result, report)
    return _done_by(lambda: _Workers(function, executor, retries), work, earlier_result, report, ahead)


def _nothing(*_: object) -> None:
    return None


def _done_here(
    function: Callable[[P], R],
    work: Iterable[P],
    known: Callable[[int], R | None],
    finished: Callable[[int, R], None],
) -> Generator[R]:
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
) -> Generator[R]:
    crew = gather()
    ready: dict[int, R] = {}
    source = enumerate(work)
    place = 0
    exhausted = False
    try:
        while not exhausted or crew or ready:
            while not exhausted and len(crew) + len(ready) < max(ahead, crew.capacity):
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
    """An executor with its pending pieces, which are sent again when workers are lost."""

    def __init__(self, function: Callable[[P], R], executor: Executor | Callable[[], Executor], retries: int) -> None:
        self.function = function
        self.source = executor
        self.owned = not isinstance(executor, Executor)
        self.executor = executor if isinstance(executor, Executor) else executor()
        if not isinstance(self.executor, Executor):
            raise RunError(
                "expected an executor, or a function that creates one, not {name}", name=type(self.executor).__name__
            )
        self.retries = retries
        self.losses = 0
        self.pending: dict[Future[R], tuple[int, P]] = {}
        self.lost: list[tuple[int, P]] = []

    def __len__(self) -> int:
        return len(self.pending) + len(self.lost)

    @property
    def capacity(self) -> int:
        """Pieces that keep all workers busy: one in each and three more, since their lengths differ."""
        return 4 * (getattr(self.executor, "_max_workers", None) or 0)

    def send(self, number: int, piece: P) -> None:
        try:
            self.pending[self.executor.submit(self.function, piece)] = number, piece
        except BrokenExecutor:
            self.lost.append((number, piece))

    def collect(self) -> list[tuple[int, R]]:
        """Wait until a piece is finished; the results of all pieces that are finished then."""
        results = []
        done = wait(self.pending, return_when=FIRST_COMPLETED).done if self.pending else set()
        for future in done:
            number, piece = self.pending.pop(future)
            try:
                results.append((number, future.result()))
            except BrokenExecutor:
                self.lost.append((number, piece))
        if results:
            self.losses = 0
        if self.lost:
            self._renew()
        return sorted(results, key=lambda item: item[0])

    def _renew(self) -> None:
        """Replace a broken executor by a new one, and send the lost pieces again."""
        self.losses += 1
        self.lost += self.pending.values()
        self.pending.clear()
        if self.losses > self.retries:
            raise RunError(
                "workers were lost {losses} times in a row without finishing a piece of work; is there enough "
                "memory for so many of them?",
                losses=self.losses,
            )
        if self.owned:
            self.executor.shutdown(wait=True, cancel_futures=True)
        if callable(self.source):
            self.executor = self.source()
        elif isinstance(self.source, ProcessPoolExecutor):
            self.source = ProcessPools(getattr(self.source, "_max_workers", None) or os.cpu_count() or 1)
            self.executor, self.owned = self.source(), True
        else:
            raise RunError(
                "the {name} broke and cannot be replaced; pass a function that creates executors",
                name=type(self.source).__name__,
            )
        resent, self.lost = sorted(self.lost, key=lambda item: item[0]), []
        for number, piece in resent:
            self.send(number, piece)

    def dismiss(self) -> None:
        if isinstance(self.source, ProcessPools) and self.pending:
            self.source.stop()
        elif not self.owned:
            for future in self.pending:
                future.cancel()
        if self.owned:
            self.executor.shutdown(wait=True, cancel_futures=True)
        if isinstance(self.source, ProcessPools):
            self.source.stop()


class ProgressCounter:
    """Counts finished pieces and reports the progress of the run."""

    def __init__(self, report: Callable[[Progress], None] | None, expected: int | None = None) -> None:
        self._report = report
        self._expected = expected
        self._begun = monotonic()
        self._pieces = self._chains = self._fresh = 0

    def add(self, chains: int, *, fresh: bool) -> None:
        """One more piece with this number of chains, from this run or an earlier one."""
        self._pieces += 1
        self._chains += chains
        self._fresh += chains * fresh
        if self._report is not None:
            seconds = monotonic() - self._begun
            self._report(
                Progress(
                    pieces=self._pieces,
                    chains=self._chains,
                    fresh=self._fresh,
                    seconds=seconds,
                    expected=self._expected,
                )
            )
