"""Long runs: workers that die, runs that are killed and gone on with, directories and files that stay whole."""

import os
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from pathlib import Path

import pytest

from gruebler.base.atomic_files import PARTIAL, atomic_file
from gruebler.base.errors import RunError
from gruebler.structure.enumeration.checkpoint import checkpoint_files
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.run_request import run_count, run_list
from gruebler.structure.enumeration.work_units import PieceCounter, add_tallies, work_units
from gruebler.structure.enumeration.worker_pool import ProcessPools, Progress, run_work

CHAINS_14 = 318162
kills = pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="Windows has no SIGKILL")


def square(number):
    return number * number


def dies_once(marks, number):
    """Kills its own process when it meets these numbers for the first time."""
    mark = Path(marks) / str(number)
    if number in (3, 7) and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def dies_always(number):
    if number == 5:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def fails(number):
    if number == 4:
        raise ZeroDivisionError("four")
    return number


@pytest.fixture
def processes():
    made = ProcessPools(2)
    yield made
    made.stop()


@pytest.fixture(scope="module")
def lasting_processes():
    """For tests that kill none of them: to start them takes longer than what they do."""
    made = ProcessPools(2)
    yield made
    made.stop()


@pytest.mark.parametrize("ahead", [1, 3, 100])
def test_results_come_in_order(lasting_processes, ahead):
    expected = [k * k for k in range(40)]
    told = {}
    assert list(run_work(square, range(40))) == expected
    assert list(run_work(square, range(40), lasting_processes, ahead=ahead, finished=told.__setitem__)) == expected
    assert told == dict(enumerate(expected))
    with ThreadPoolExecutor(3) as threads:
        assert list(run_work(square, range(40), threads, ahead=ahead)) == expected
        assert threads.submit(square, 3).result() == 9


def test_known_pieces_are_not_done_again(lasting_processes):
    for executor in (None, lasting_processes):
        told = {}
        found = list(run_work(square, range(9), executor, known={2: -2, 8: -8}.get, finished=told.__setitem__))
        assert found == [0, 1, -2, 9, 16, 25, 36, 49, -8]
        assert sorted(told) == [0, 1, 3, 4, 5, 6, 7]


@kills
def test_a_lost_worker_changes_nothing(processes, tmp_path):
    told = []
    found = list(run_work(partial(dies_once, tmp_path), range(20), processes, finished=lambda k, _: told.append(k)))
    assert found == [k * k for k in range(20)]
    assert sorted(told) == list(range(20))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["3", "7"]


class DiesWriting:
    """Writes pieces; the first worker is killed in the middle of one."""

    def __init__(self, files):
        self.files = files

    def __call__(self, number):
        mark = self.files.directory.with_name("dead")
        if number == 2 and not mark.exists():
            mark.touch()
            with atomic_file(self.files._path(number)) as file:
                file.write(b"half")
                file.flush()
                os.kill(os.getpid(), signal.SIGKILL)
        self.files.save(number, {"square": number * number})
        return number * number


@kills
def test_what_a_lost_worker_was_writing_goes_with_the_run(processes, tmp_path):
    store = checkpoint_files(tmp_path / "kept", {}, "1")
    assert list(run_work(DiesWriting(store), range(5), processes)) == [0, 1, 4, 9, 16]
    assert [path for path in store.directory.iterdir() if path.name.endswith(PARTIAL)]
    store.tidy()
    assert [path for path in store.directory.iterdir() if path.name.endswith(PARTIAL)] == []
    assert store.head(2) == {"square": 4}


@kills
def test_a_broken_executor_that_was_given_is_replaced(tmp_path):
    with ProcessPoolExecutor(2) as pool:
        found = list(run_work(partial(dies_once, tmp_path), range(12), pool))
    assert found == [k * k for k in range(12)]


@kills
def test_a_piece_that_kills_every_worker_ends_the_run(processes):
    with pytest.raises(RunError, match="lost 3 times in a row"):
        list(run_work(dies_always, range(8), processes, retries=2))


def test_an_executor_that_cannot_be_made_anew():
    class Broken(Executor):
        def submit(self, *_, **__):
            raise BrokenProcessPool("gone")

    with pytest.raises(RunError, match="Broken broke"):
        list(run_work(square, range(3), Broken()))


def test_what_a_piece_raises_is_raised(lasting_processes):
    for executor in (None, lasting_processes):
        with pytest.raises(ZeroDivisionError, match="four"):
            list(run_work(fails, range(9), executor))


class OneDeath:
    """Counts a piece; the first worker to begin the third piece is killed."""

    def __init__(self, mark, counter, victim):
        self.mark, self.counter, self.victim = mark, counter, victim

    def __call__(self, work):
        if repr(work) == self.victim and not self.mark.exists():
            self.mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return self.counter(work)


@kills
def test_a_lost_worker_changes_no_count(processes, tmp_path):
    request = Request(12)
    work = list(work_units(request, size=10_000))
    assert len(work) > 10
    counter = OneDeath(tmp_path / "dead", PieceCounter(request, True), repr(work[2]))
    found = add_tallies(request, True, run_work(counter, work, processes))
    assert (tmp_path / "dead").exists()
    assert found == run_count(request, orbits=True)
    assert found.chains == 6856


@pytest.mark.parametrize(
    "request_",
    [Request(12), Request(9, mobility=2, fractionated="all"), Request(8, multiple_joints="any"), Request(4)],
    ids=str,
)
def test_any_number_of_jobs_gives_the_same(request_, lasting_processes):
    alone = run_count(request_, orbits=True)
    assert run_count(request_, orbits=True, executor=lasting_processes) == alone
    for form in ("text", "json"):
        assert list(run_list(request_, form, executor=lasting_processes)) == list(run_list(request_, form))
    with ThreadPoolExecutor(2) as threads:
        assert run_count(request_, orbits=True, executor=threads) == alone


KILLED = """
import os, signal, sys
from pathlib import Path
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.run_request import run_list
pieces = [0]
def tell(progress):
    pieces[0] += progress.fresh > 0
    if pieces[0] == 2:
        os.kill(os.getpid(), signal.SIGKILL)
number = sum(l.chains for l in run_list(Request(14), "graph6", checkpoint=Path(sys.argv[1]), progress=tell))
print(number)
"""


@kills
def test_a_killed_run_goes_on_with_the_same_result(tmp_path):
    """Killed whenever two more pieces are finished, until nothing is left to do."""
    store = tmp_path / "kept"
    command = [sys.executable, "-c", KILLED, str(store)]
    deaths = 0
    while (done := subprocess.run(command, capture_output=True, text=True, check=False)).returncode:
        assert done.returncode == -signal.SIGKILL, done.stderr
        deaths += 1
        assert deaths < 20
    assert deaths >= 3
    assert int(done.stdout) == CHAINS_14
    progress = []
    resumed = list(run_list(Request(14), "graph6", checkpoint=store, progress=progress.append))
    assert progress[-1].fresh == 0
    assert progress[-1].chains == CHAINS_14
    assert resumed == list(run_list(Request(14), "graph6"))


def test_damaged_and_torn_pieces_are_done_again(tmp_path):
    request = Request(9, mobility=2, fractionated="all")
    expected = run_count(request, checkpoint=tmp_path)
    first, *_ = sorted(tmp_path.glob("*.piece"))
    whole = first.read_bytes()
    for damage in (b"", b"{", whole[:-1] + b"x", whole + b"x"):
        first.write_bytes(damage)
        assert run_count(request, checkpoint=tmp_path) == expected
        assert first.read_bytes() == whole
    (tmp_path / f".0000001.piece.1{PARTIAL}").write_bytes(b"torn")
    assert run_count(request, checkpoint=tmp_path) == expected


def test_a_directory_of_another_task_is_refused(tmp_path):
    run_count(Request(8), checkpoint=tmp_path / "a")
    for other in (
        partial(run_count, Request(10)),
        partial(run_count, Request(8), orbits=True),
        lambda checkpoint: list(run_list(Request(8), "text", checkpoint=checkpoint)),
    ):
        with pytest.raises(RunError, match="another task") as caught:
            other(checkpoint=tmp_path / "a")
        assert "\n" not in str(caught.value)
    checkpoint_files(tmp_path / "b", {"n": 1}, "0")
    with pytest.raises(RunError, match="version 0 of gruebler, this is version 1"):
        checkpoint_files(tmp_path / "b", {"n": 1}, "1")
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "letter.txt").write_text("dear")
    with pytest.raises(RunError, match="holds other files"):
        run_count(Request(8), checkpoint=tmp_path / "c")
    with pytest.raises(RunError, match="cannot hold the finished parts"):
        run_count(Request(8), checkpoint=tmp_path / "c" / "letter.txt")


MANIFESTS = ["", "{", "[]", "null", '"text"', "[" * 100_000, "1" * 10_000, '{"task": ' + "[" * 900 + "]" * 900 + "}"]


@pytest.mark.parametrize("content", MANIFESTS, ids=range(len(MANIFESTS)))
def test_a_broken_manifest_is_one_sentence(tmp_path, content):
    run_count(Request(8), checkpoint=tmp_path)
    (tmp_path / "manifest.json").write_text(content)
    with pytest.raises(RunError, match=r"manifest\.json cannot be read; remove|holds parts of another task") as caught:
        run_count(Request(8), checkpoint=tmp_path)
    assert len(str(caught.value)) < 1500


BROKEN = [
    b"[]\n",
    b"null\n",
    b"[" * 100_000,
    b"1" * 10_000,
    b'{"tallies": []}\n',
    b'{"bytes": 0, "sha256": "x"}\n',
    b"1\n",
]


@pytest.mark.parametrize("content", BROKEN, ids=range(len(BROKEN)))
def test_a_broken_piece_is_done_again(tmp_path, content):
    request = Request(9, mobility=2, fractionated="all")
    expected = run_count(request, checkpoint=tmp_path / "count")
    listed = list(run_list(request, "text", checkpoint=tmp_path / "list"))
    for kept, again in (
        ("count", lambda store: run_count(request, checkpoint=store) == expected),
        ("list", lambda store: list(run_list(request, "text", checkpoint=store)) == listed),
    ):
        first, *_ = sorted((tmp_path / kept).glob("*.piece"))
        whole = first.read_bytes()
        first.write_bytes(content)
        assert again(tmp_path / kept)
        assert first.read_bytes() == whole


def test_a_sealed_piece_without_its_key_is_done_again(tmp_path):
    request = Request(8)
    expected = run_count(request, checkpoint=tmp_path)
    from gruebler import __version__

    store = checkpoint_files(tmp_path, request.to_json() | {"count": True, "orbits": False}, __version__)
    for head in ({}, {"tallies": 3}, {"tallies": [3]}, {"tallies": [["none"]]}):
        store.save(0, head)
        assert store.head(0) == head
        assert run_count(request, checkpoint=tmp_path) == expected


def test_a_piece_under_another_number_is_done_again(tmp_path):
    """Copied or exchanged pieces: the seal covers the number."""
    request = Request(14)
    listed = list(run_list(request, "graph6"))
    store = tmp_path / "kept"
    with ThreadPoolExecutor(1) as threads:
        assert list(run_list(request, "graph6", executor=threads, checkpoint=store)) == listed
    first, second, *_ = sorted(store.glob("*.piece"))
    one, two = first.read_bytes(), second.read_bytes()
    assert one != two
    for contents in ((one, one), (two, two), (two, one)):
        first.write_bytes(contents[0])
        second.write_bytes(contents[1])
        assert list(run_list(request, "graph6", checkpoint=store)) == listed
        assert (first.read_bytes(), second.read_bytes()) == (one, two)


def test_a_piece_of_another_request_is_done_again(tmp_path):
    expected = run_count(Request(8), checkpoint=tmp_path / "eight")
    run_count(Request(10), checkpoint=tmp_path / "ten")
    for piece in (tmp_path / "ten").glob("*.piece"):
        piece.replace(tmp_path / "eight" / piece.name)
    assert run_count(Request(8), checkpoint=tmp_path / "eight") == expected


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_a_piece_that_cannot_be_read_is_named(tmp_path):
    run_count(Request(8), checkpoint=tmp_path)
    first = min(tmp_path.glob("*.piece"))
    first.unlink()
    first.symlink_to(first)
    with pytest.raises(RunError, match=rf"{first.name} cannot be read"), atomic_file(tmp_path / "out"):
        run_count(Request(8), checkpoint=tmp_path)
    first.unlink()
    first.mkdir()
    with pytest.raises(RunError, match=rf"{first.name} cannot be read: Is a directory"), atomic_file(tmp_path / "out"):
        run_count(Request(8), checkpoint=tmp_path)


def test_progress_counts_pieces_and_chains(tmp_path):
    steps = []
    run_count(Request(12), progress=steps.append, expected=6856, checkpoint=tmp_path)
    assert steps[-1].chains == steps[-1].fresh == 6856
    assert [step.pieces for step in steps] == list(range(1, len(steps) + 1))
    assert steps[-1].seconds_left == 0
    run_count(Request(12), progress=steps.append, expected=6856, checkpoint=tmp_path)
    assert (steps[-1].chains, steps[-1].fresh, steps[-1].seconds_left) == (6856, 0, None)
    assert Progress(pieces=1, chains=5, fresh=5, seconds=1.0).seconds_left is None


def test_at_least_one_process():
    with pytest.raises(RunError, match="at least one process"):
        ProcessPools(0)


ENDLESS = """
import os, signal, sys, time
from gruebler.structure.enumeration.worker_pool import ProcessPools, run_work
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell lets background jobs ignore it
def work(number):
    os.write(1, b"%d\\n" % os.getpid())  # in one go, so that lines do not mix
    time.sleep(600)
list(run_work(work, range(4), ProcessPools(2)))
"""


def alive(pid):
    """Whether a process runs; one that has ended and waits for its parent (/proc tells, if there is one) does not."""
    try:
        os.kill(pid, 0)
        status = Path(f"/proc/{pid}/stat")
        return not status.exists() or "Z" not in status.read_text().rsplit(")", 1)[1].split()[0]
    except (ProcessLookupError, FileNotFoundError):
        return False


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL and no interrupt for a single process")
@pytest.mark.parametrize("name", ["SIGKILL", "SIGINT"])
def test_no_worker_outlives_the_run(name):
    sent = getattr(signal, name)
    with subprocess.Popen(
        [sys.executable, "-c", ENDLESS], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as run:
        try:
            workers = [int(run.stdout.readline()) for _ in range(2)]
            assert all(alive(pid) for pid in workers)
            run.send_signal(sent)
            run.wait(timeout=60)
        finally:
            run.kill()
    for _ in range(600):
        if not any(alive(pid) for pid in workers):
            break
        time.sleep(0.1)
    assert not any(alive(pid) for pid in workers)


@pytest.mark.slow
def test_sixteen_links_killed_three_times(tmp_path):
    """Written as graph6 by the command line, killed at random moments, and gone on with."""
    out, store = tmp_path / "chains.g6", tmp_path / "kept"
    command = [sys.executable, "-m", "gruebler", "enumerate", "--links", "16", "--format", "graph6", "-o", str(out)]
    command += ["--jobs", "2", "--checkpoint", str(store)]
    chance = random.Random(16)
    for _ in range(3):
        kept = len(list(store.rglob("*")))
        wanted = kept + chance.randint(3, 6)
        with subprocess.Popen(command) as run:
            while run.poll() is None and len(list(store.rglob("*"))) < wanted:
                time.sleep(0.01)
            run.kill()
        assert not out.exists()
    assert subprocess.run(command, check=False).returncode == 0
    with out.open("rb") as file:
        assert sum(chunk.count(b"\n") for chunk in iter(lambda: file.read(1 << 24), b"")) == 19_819_281
    counted = run_count(Request(16), executor=ProcessPools(2), checkpoint=tmp_path / "count")
    assert counted.chains == 19_819_281


def test_a_changed_piece_is_done_again(tmp_path):
    """A piece whose numbers were altered after it was written does not enter the sum."""
    store = tmp_path / "kept"
    assert run_count(Request(12), checkpoint=store).chains == 6856
    for piece in store.glob("*.piece"):
        piece.write_bytes(piece.read_bytes().replace(b"1", b"2", 1))
    assert run_count(Request(12), checkpoint=store).chains == 6856
