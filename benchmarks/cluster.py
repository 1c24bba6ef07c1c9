"""What it costs to share work: processor seconds of all processes together, against this process alone.

Each run by others follows one by this process, so that both meet the same load of the machine. Scheduler and workers
are processes of this machine that are there already; what they use at rest counts as long as the run lasts.
"""

import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.run_request import run_count
from gruebler.structure.enumeration.schedulers import DaskScheduler
from gruebler.structure.enumeration.worker_pool import ProcessPools

REQUEST = Request(18)
WORKERS = 2
PAIRS = 3
QUIET = {  # what docs/cluster.md recommends
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "false",
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
    "DASK_DISTRIBUTED__ADMIN__SYSTEM_MONITOR__INTERVAL": "5s",
}


@contextmanager
def workers(settings: dict[str, str]) -> Iterator[tuple[str, Callable[[], float]]]:
    """A Dask scheduler with workers: its address, and what says how many processor seconds they have used."""
    import psutil

    address = "tcp://127.0.0.1:8799"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": os.environ | settings}
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "8799"]
    started = [subprocess.Popen([*command, "--no-dashboard"], **quiet)]
    time.sleep(3)
    command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard"]
    started += [subprocess.Popen(command, **quiet) for _ in range(WORKERS)]

    def processes() -> Iterator[psutil.Process]:
        for parent in map(psutil.Process, [process.pid for process in started]):
            yield parent
            yield from parent.children(recursive=True)

    def used() -> float:
        return sum(sum(process.cpu_times()[:2]) for process in processes())

    try:
        yield address, used
    finally:
        for process in list(processes())[::-1]:
            process.kill()
        for process in started:
            process.wait()


def measured(run: Callable[[], ChainCount], others: Callable[[], float]) -> tuple[ChainCount, float]:
    before = time.process_time() + others()
    count = run()
    return count, time.process_time() + others() - before


def compare(name: str, run: Callable[[], ChainCount], others: Callable[[], float]) -> None:
    run()
    pairs = []
    for _ in range(PAIRS):
        count, alone = measured(lambda: run_count(REQUEST, orbits=True), float)
        same, shared = measured(run, others)
        assert same == count
        pairs.append((alone, shared))
    more = statistics.median(shared / alone - 1 for alone, shared in pairs)
    alone, shared = (statistics.fmean(column) for column in zip(*pairs, strict=True))
    print(f"{name:32}{alone:10.2f}{shared:10.2f}{more:10.1%}", flush=True)


def children() -> float:
    times = os.times()
    return times.children_user + times.children_system


def main() -> None:
    print(f"{'':32}{'alone, s':>10}{'shared, s':>10}{'more':>10}")
    run_count(Request(14), orbits=True)
    compare(
        f"pool of {WORKERS} processes",
        partial(run_count, REQUEST, orbits=True, executor=ProcessPools(WORKERS)),
        children,
    )
    for name, settings in (("settings of docs/cluster.md", QUIET), ("its own settings", {})):
        with workers(settings) as (address, used):
            run = partial(run_count, REQUEST, orbits=True, executor=DaskScheduler(address))
            compare(f"Dask, {name}", run, used)
