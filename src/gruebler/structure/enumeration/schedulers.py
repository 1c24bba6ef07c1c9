"""Work on many machines: an executor that hands pieces of work to a Dask scheduler."""

from __future__ import annotations

import logging
import os
import warnings
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from threading import Event, Thread
from time import monotonic
from typing import Any, ParamSpec, TypeVar

from gruebler.base.errors import GrueblerError, RunError
from gruebler.base.text import Message, message

P = ParamSpec("P")
R = TypeVar("R")

LOCAL = "local"
"""In place of an address: the workers are processes of this machine."""
_LOSSES = ("KilledWorker", "CommClosedError", "FutureCancelledError")
_PATIENCE = 30.0  # seconds to wait for a scheduler, and for a worker before the lack of one is reported
_INTERVAL = 5.0  # seconds from one look at the workers to the next


class DaskScheduler:
    """Creates executors for the workers of a Dask scheduler, one after another: see `worker_pool.run_work`.

    Args:
        address: such as ``tcp://host:8786``; ``local`` for a scheduler of its own with a worker for each processor of
            this machine, which end with the work.
        report: called with a text if the scheduler has no worker for half a minute, once for each connection; the run
            goes on waiting. By default a warning is issued.

    The workers need this library; what they write into a directory (an atlas, a checkpoint) must be on a disk that they
    share with this process.
    """

    def __init__(self, address: str, report: Callable[[Message], None] | None = None) -> None:
        self.address = address
        self.report = _warn if report is None else report

    def __call__(self) -> DaskExecutor:
        """A new connection; waits some seconds for a scheduler that is restarted.

        Raises:
            GrueblerError: distributed is not installed.
            RunError: no scheduler answers at the address; said at once where this has no port or an unknown host.
        """
        try:
            import distributed
            from distributed.comm.addressing import resolve_address
        except ImportError:
            raise GrueblerError("a scheduler needs Dask: pip install 'gruebler[cluster]'") from None
        try:
            connect: Any = distributed.Client
            where: dict[str, Any] = {"address": self.address}
            if self.address == LOCAL:
                own_workers = {"n_workers": os.cpu_count() or 1, "threads_per_worker": 1}
                where = {**own_workers, "dashboard_address": None, "silence_logs": logging.CRITICAL}
            else:  # a client of an address without a port would hang for a minute at the end of the process
                resolve_address(self.address)
            client = connect(**where, timeout=_PATIENCE, set_as_default=False)
        except (OSError, ValueError, TypeError):
            raise RunError("no Dask scheduler answers at {address}", address=self.address) from None
        # Dask logs the traceback of a lost connection; here it ends in a new one or in the error above.
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        return DaskExecutor(client, self.address, self.report)


def _warn(text: Message) -> None:
    warnings.warn(str(text), RuntimeWarning, stacklevel=2)


class DaskExecutor(Executor):
    """The workers of a Dask client as an executor; the loss of a worker or of the scheduler breaks it."""

    def __init__(self, client: Any, address: str, report: Callable[[Message], None]) -> None:
        self._client = client
        self._address = address
        self._report = report
        self._max_workers = 0  # as the executors of `concurrent.futures` have it: see `worker_pool.run_work`
        self._closed = Event()
        Thread(target=self._watch, daemon=True).start()

    def _watch(self) -> None:
        """Count the workers' threads from time to time; report if there are none."""
        since = monotonic()
        reported = False
        while not self._closed.is_set():
            try:
                self._max_workers = sum(self._client.nthreads().values())
            except Exception:
                # The connection is closed or lost, which Dask reports by errors of many kinds: OSError, RuntimeError,
                # AttributeError of a client without a scheduler. Who waits for a result is answered by the own call.
                self._max_workers = 0
            else:
                if self._max_workers:
                    since = monotonic()
                elif not reported and monotonic() - since >= _PATIENCE:
                    reported = True
                    self._report(
                        message(
                            "the Dask scheduler at {address} has no worker; waiting for one (Ctrl-C ends the run)",
                            address=self._address,
                        )
                    )
            self._closed.wait(_INTERVAL)

    def submit(self, function: Callable[P, R], /, *arguments: P.args, **settings: P.kwargs) -> Future[R]:
        """Send a call to a worker. Dask itself repeats it elsewhere where a worker is lost, some times."""
        if self._client.status != "running":
            raise BrokenExecutor("the scheduler is gone")
        result: Future[R] = Future()
        result.set_running_or_notify_cancel()
        sent = self._client.submit(function, *arguments, pure=False, **settings)

        def arrived(task: Any) -> None:
            if result.done():
                return
            lost = BrokenExecutor("a worker or the scheduler was lost")
            try:
                problem = task.exception() if task.status == "error" else None
                if task.status == "finished":
                    result.set_result(task.result())
                elif problem is None or type(problem).__name__ in _LOSSES:
                    result.set_exception(lost)
                else:
                    result.set_exception(problem)
            except Exception as error:
                # Whatever was lost on its way, somebody waits for this result: the run is repeated and names the cause.
                lost.__cause__ = error
                result.set_exception(lost)

        sent.add_done_callback(arrived)
        return result

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:  # noqa: ARG002
        """Close the connection; the scheduler and its workers stay."""
        self._closed.set()
        self._client.close()
