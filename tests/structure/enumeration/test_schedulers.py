"""Work sent to a Dask scheduler: the same numbers and files, workers killed meanwhile."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

from gruebler.base.errors import RunError
from gruebler.cli import main
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.run_request import run_count
from gruebler.structure.enumeration.schedulers import DaskScheduler
from gruebler.structure.enumeration.work_units import work_units
from gruebler.structure.enumeration.worker_pool import run_work

distributed = pytest.importorskip("distributed")
QUIET = {"dashboard_address": ":0", "silence_logs": 50}


def test_no_scheduler_there(monkeypatch, capsys):
    monkeypatch.setattr("gruebler.structure.enumeration.schedulers._PATIENCE", 0.5)
    with pytest.raises(RunError, match=r"no Dask scheduler answers at tcp://127\.0\.0\.1:1"):
        DaskScheduler("tcp://127.0.0.1:1")()
    with pytest.raises(RunError, match="no Dask scheduler answers at nowhere"):
        DaskScheduler("nowhere://x")()
    assert main(["enumerate", "--links", "6", "--count", "--jobs", "2", "--scheduler", "tcp://127.0.0.1:1"]) == 2
    assert "--jobs is for processes of this machine" in capsys.readouterr().err


@pytest.mark.parametrize("address", ["nonsense", "nowhere.invalid:8786"])
def test_what_is_no_address_of_a_host_is_refused_before_anything_connects(monkeypatch, address):
    connected = []
    monkeypatch.setattr(distributed, "Client", lambda **where: connected.append(where))
    with pytest.raises(RunError, match=f"no Dask scheduler answers at {address}"):
        DaskScheduler(address)()
    assert connected == []


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="Windows has no SIGKILL")
def test_lost_workers_lose_nothing(tmp_path, capsys):
    from gruebler.structure.atlas import AtlasTask, build

    task = AtlasTask(links="4-12")
    build(task, tmp_path / "here")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, **QUIET) as cluster:
        scheduler = DaskScheduler(cluster.scheduler_address)
        expected = run_count(Request(14), orbits=True)
        stop = threading.Event()

        def kill_workers():
            while not stop.wait(8):
                for worker in list(cluster.workers.values())[:1]:
                    os.kill(worker.pid, signal.SIGKILL)

        killer = threading.Thread(target=kill_workers)
        killer.start()
        try:
            for _ in range(3):
                assert run_count(Request(14), orbits=True, executor=scheduler) == expected
            build(task, tmp_path / "there", executor=scheduler)
        finally:
            stop.set()
            killer.join()
        assert main(["enumerate", "--links", "12", "--count", "--scheduler", cluster.scheduler_address]) == 0
    assert "chains: 6,856" in capsys.readouterr().out
    files = {
        str(p.relative_to(tmp_path / "here")): p.read_bytes() for p in (tmp_path / "here").rglob("*") if p.is_file()
    }
    for name, content in files.items():
        assert (tmp_path / "there" / name).read_bytes() == content


@pytest.fixture
def cluster():
    with distributed.LocalCluster(n_workers=0, processes=False, protocol="tcp://", **QUIET) as made:
        yield made


def test_a_scheduler_without_workers_is_reported_once(monkeypatch, cluster):
    monkeypatch.setattr("gruebler.structure.enumeration.schedulers._PATIENCE", 0.2)
    monkeypatch.setattr("gruebler.structure.enumeration.schedulers._INTERVAL", 0.1)
    reports = []

    def worker_comes(text):
        reports.append(str(text))
        threading.Timer(0.5, cluster.scale, (1,)).start()

    scheduler = DaskScheduler(cluster.scheduler_address, worker_comes)
    expected = run_count(Request(10))
    assert run_count(Request(10), executor=scheduler) == expected
    text = f"the Dask scheduler at {cluster.scheduler_address} has no worker; waiting for one (Ctrl-C ends the run)"
    assert reports == [text]


def test_many_workers_get_many_pieces(cluster):
    """More pieces than `ahead` are sent where there are more threads."""
    cluster.scale(1)
    address = cluster.scheduler_address
    with distributed.Client(address, set_as_default=False) as client:
        client.wait_for_workers(1)
        threads = sum(client.nthreads().values())
    executor = DaskScheduler(address)()
    while not executor._max_workers:
        time.sleep(0.01)
    taken = []

    def numbers():
        for number in range(100):
            taken.append(number)
            yield number

    results = run_work(abs, numbers(), executor, ahead=1)
    assert next(results) == 0
    assert len(taken) >= 4 * threads > 1
    assert list(results) == list(range(1, 100))
    executor.shutdown()


# The worker counts one piece and waits at all others, so that the run cannot end before the scheduler is killed.
CLUSTER = """
import itertools, sys, threading, distributed
from gruebler.structure.enumeration.work_units import PieceCounter

count, calls = PieceCounter.__call__, itertools.count()

def count_once(counter, piece):
    if next(calls):
        threading.Event().wait()
    return count(counter, piece)

PieceCounter.__call__ = count_once
cluster = distributed.LocalCluster(n_workers=1, processes=False, protocol="tcp://", dashboard_address=":0")
print(cluster.scheduler_address, flush=True)
sys.stdin.read()
"""


def test_a_killed_scheduler_ends_the_run_with_one_error(monkeypatch, tmp_path, capfd):
    """What is finished is kept: a run without a scheduler does only what is left."""
    monkeypatch.setattr("gruebler.structure.enumeration.schedulers._PATIENCE", 0.5)
    monkeypatch.setattr("gruebler.structure.enumeration.run_request._COUNTED", {10: 100_000})
    command = [sys.executable, "-c", CLUSTER]
    finished = []

    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as running:

        def kill(progress):
            finished.append(progress.pieces)
            running.kill()

        try:
            address = running.stdout.readline().strip()
            with pytest.raises(RunError, match=f"no Dask scheduler answers at {address}"):
                run_count(
                    Request(13, mobility=2),
                    executor=DaskScheduler(address),
                    checkpoint=tmp_path / "kept",
                    progress=kill,
                )
        finally:
            running.kill()
    assert "Traceback" not in capfd.readouterr().err
    kept = {path: path.stat().st_mtime_ns for path in (tmp_path / "kept").glob("*.piece")}
    assert len(kept) == len(finished) == 1
    assert len(list(work_units(Request(13, mobility=2), size=100_000))) > 1
    count = run_count(Request(13, mobility=2), checkpoint=tmp_path / "kept")
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert count == run_count(Request(13, mobility=2))
