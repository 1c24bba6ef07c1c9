"""Work sent to a Dask scheduler: the same numbers and files, workers killed meanwhile."""

import os
import signal
import threading

import pytest

from gruebler.cli import main
from gruebler.enumeration.request import Request
from gruebler.enumeration.run_request import run_count
from gruebler.enumeration.schedulers import DaskScheduler
from gruebler.errors import RunError

distributed = pytest.importorskip("distributed")


def test_no_scheduler_there(monkeypatch, capsys):
    monkeypatch.setattr("gruebler.enumeration.schedulers._PATIENCE", 0.5)
    with pytest.raises(RunError, match=r"no Dask scheduler answers at tcp://127\.0\.0\.1:1"):
        DaskScheduler("tcp://127.0.0.1:1")()
    with pytest.raises(RunError, match="no Dask scheduler answers at nowhere"):
        DaskScheduler("nowhere://x")()
    assert main(["enumerate", "--links", "6", "--count", "--jobs", "2", "--scheduler", "tcp://127.0.0.1:1"]) == 2
    assert "--jobs is for processes of this machine" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no signals")
def test_lost_workers_lose_nothing(tmp_path, capsys):
    from gruebler.atlas import AtlasTask, build

    task = AtlasTask("4-12")
    build(task, tmp_path / "here")
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster:
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
    assert "chains: 6856" in capsys.readouterr().out
    files = {
        str(p.relative_to(tmp_path / "here")): p.read_bytes() for p in (tmp_path / "here").rglob("*") if p.is_file()
    }
    for name, content in files.items():
        assert (tmp_path / "there" / name).read_bytes() == content
