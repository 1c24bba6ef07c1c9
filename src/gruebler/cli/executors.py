"""The options `--jobs` and `--scheduler`: who does the work."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from concurrent.futures import Executor

from gruebler.base.errors import GrueblerError


def executor_of(arguments: argparse.Namespace) -> Callable[[], Executor] | None:
    """What creates executors for `enumeration.worker_pool.run_work`; None for this process alone."""
    if arguments.scheduler is not None:
        from gruebler.structure.enumeration.schedulers import DaskScheduler

        if arguments.jobs != 1:
            raise GrueblerError("--jobs is for processes of this machine; with --scheduler its workers do the work")
        return DaskScheduler(
            arguments.scheduler,
            lambda text: print(f"gruebler: {text.in_language(arguments.lang)}", file=sys.stderr, flush=True),
        )
    if arguments.jobs == 1:
        return None
    from gruebler.structure.enumeration.worker_pool import ProcessPools

    return ProcessPools(min(arguments.jobs, 4 * (os.cpu_count() or 1)))
