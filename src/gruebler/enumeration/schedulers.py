"""Work on many machines: an executor that hands pieces of work to a Dask scheduler."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from typing import Any, ParamSpec, TypeVar

from gruebler.errors import GrueblerError, RunError

__all__ = ["DaskExecutor", "DaskScheduler"]

P = ParamSpec("P")
R = TypeVar("R")

_LOSSES = ("KilledWorker", "CommClosedError", "FutureCancelledError")
_PATIENCE = 30  # seconds to wait for a scheduler


class DaskScheduler:
    """Creates executors for the workers of a Dask scheduler, one after another: see `worker_pool.run_work`.

    Args:
        address: such as ``tcp://host:8786``.

    The workers need this library; what they write into a directory (an atlas, a checkpoint) must be on a disk that they
    share with this process.
    """

    def __init__(self, address: str) -> None:
        self.address = address

    def __call__(self) -> DaskExecutor:
        """A new connection; waits some seconds for a scheduler that is restarted.

        Raises:
            GrueblerError: distributed is not installed.
            RunError: no scheduler answers at the address.
        """
        try:
            import distributed
        except ImportError:
            raise GrueblerError("a scheduler needs Dask: pip install 'gruebler[cluster]'") from None
        try:
            connect: Any = distributed.Client
            client = connect(self.address, timeout=_PATIENCE, set_as_default=False)
        except (OSError, ValueError, TypeError):
            raise RunError("no Dask scheduler answers at {address}", address=self.address) from None
        return DaskExecutor(client)


class DaskExecutor(Executor):
    """The workers of a Dask client as an executor; the loss of a worker or of the scheduler breaks it."""

    def __init__(self, client: Any) -> None:
        self._client = client

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
            except Exception:  # the result was lost on its way
                result.set_exception(lost)

        sent.add_done_callback(arrived)
        return result

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:  # noqa: ARG002
        """Close the connection; the scheduler and its workers stay."""
        self._client.close()
