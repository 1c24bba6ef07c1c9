"""Files that appear complete or not at all, and what killed processes leave behind."""

import ast
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import pytest

import gruebler
from gruebler.base import atomic_files
from gruebler.base.atomic_files import PARTIAL, atomic_file, remove_abandoned_files, temporary_directory
from gruebler.base.errors import RunError

PACKAGE = Path(gruebler.__file__).parent
locks = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no locks that end with their process")


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    path = tmp_path / "out"

    def interrupted():
        with atomic_file(path) as file:
            file.write(b"half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert list(tmp_path.iterdir()) == []
    with atomic_file(path) as file:
        file.write(b"whole")
        assert not path.exists()
    assert path.read_bytes() == b"whole"
    assert list(tmp_path.iterdir()) == [path]
    with pytest.raises(RunError, match="cannot be written"), atomic_file(tmp_path / "no" / "out"):
        pass


def test_an_error_names_the_file_it_is_about(tmp_path):
    """What fails inside may concern another file than the one written."""
    with pytest.raises(RunError, match=r"other cannot be used: No such file"), atomic_file(tmp_path / "out"):
        (tmp_path / "other").read_bytes()
    assert list(tmp_path.iterdir()) == []


@locks
def test_a_link_to_itself_is_no_place_to_write(tmp_path):
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    with pytest.raises(RunError, match="a symbolic link in it leads nowhere"), atomic_file(loop):
        pass
    assert loop.is_symlink()


def test_a_link_is_followed_and_the_mode_is_kept(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(b"old")
    target.chmod(0o640)
    link.symlink_to(target)
    with atomic_file(link) as file:
        file.write(b"new")
    assert link.is_symlink()
    assert (target.read_bytes(), target.stat().st_mode & 0o777) == (b"new", 0o640)


def test_a_long_name_is_written(tmp_path):
    path = tmp_path / ("ä" * 120 + ".txt")  # 244 bytes: a temporary name that repeated it whole would be too long
    with atomic_file(path) as file:
        file.write(b"content")
    assert [one.name for one in tmp_path.iterdir()] == [path.name]


def test_all_files_are_written_here():
    """No other module opens a file to write; only the null device of a closed output."""
    wrong = []
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            modes = [
                one.value for one in ast.walk(node) if isinstance(one, ast.Constant) and isinstance(one.value, str)
            ]
            opened = name == "open" and any(re.fullmatch(r"[rwaxbt+]*[wax+][rwaxbt+]*", mode) for mode in modes)
            null = "devnull" in ast.unparse(node)
            if name in ("write_text", "write_bytes", "mkstemp", "NamedTemporaryFile") or (opened and not null):
                wrong.append(f"{path.relative_to(PACKAGE)}:{node.lineno}")
    assert {one.partition(":")[0] for one in wrong} == {"base/atomic_files.py"}


WRITES = """
import sys, time
from pathlib import Path
from gruebler.base.atomic_files import atomic_file, temporary_directory
with atomic_file(Path(sys.argv[1])) as file, temporary_directory() as directory:
    file.write(b"half of it")
    file.flush()
    (directory / "piece").write_bytes(b"work")
    print(directory, flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def scratch(tmp_path, monkeypatch):
    """A temporary directory of the system for this test alone, here and in its child processes."""
    folder = tmp_path / "tmp"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    monkeypatch.setattr(tempfile, "tempdir", None)
    yield folder
    tempfile.tempdir = None


def writing(path):
    """A process that is in the middle of writing a file and has a temporary directory."""
    command = [sys.executable, "-c", WRITES, str(path)]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    return process, Path(process.stdout.readline().strip())


@locks
@pytest.mark.parametrize("name", ["SIGKILL", "SIGTERM"])
def test_what_a_killed_process_left_is_removed_by_the_next(tmp_path, scratch, name):
    path = tmp_path / "out"
    process, directory = writing(path)
    with process:
        partial = [one for one in tmp_path.iterdir() if one.name.endswith(PARTIAL)]
        assert len(partial) == 1
        assert directory.parent == scratch
        process.send_signal(getattr(signal, name))
    assert partial[0].exists()
    assert directory.exists()
    with atomic_file(path) as file, temporary_directory() as mine:
        assert [one for one in scratch.iterdir() if one != mine] == []
        file.write(b"whole")
    assert path.read_bytes() == b"whole"
    assert sorted(tmp_path.iterdir()) == [path, scratch]
    assert list(scratch.iterdir()) == []


@locks
def test_what_a_living_process_writes_is_left_alone(tmp_path, scratch):
    path = tmp_path / "out"
    process, directory = writing(path)
    with process:
        with atomic_file(path) as file, temporary_directory():
            file.write(b"mine")
        remove_abandoned_files(tmp_path)
        assert (directory / "piece").read_bytes() == b"work"
        process.stdin.close()
        assert process.wait() == 0
    assert path.read_bytes() == b"half of it"  # the other one finished last
    assert not directory.exists()
    assert sorted(tmp_path.iterdir()) == [path, scratch]


@locks
def test_only_abandoned_files_of_this_host_are_removed(tmp_path, monkeypatch):
    """Not those of other hosts, of other names or of nobody's pattern."""
    mine = atomic_files._host()
    kept = [f".out.00000000.1a2b3c4d{PARTIAL}", f"out.{mine}.1a2b3c4d{PARTIAL}", f".out.{mine}.1a2b3c4d"]
    gone = [f".out.{mine}.1a2b3c4d{PARTIAL}", f".out.{mine}.12345678{PARTIAL}"]
    other = f".other.{mine}.12345678{PARTIAL}"
    for name in (*kept, *gone, other):
        (tmp_path / name).write_bytes(b"")
    link = tmp_path / f".out.{mine}.aaaaaaaa{PARTIAL}"
    link.symlink_to(tmp_path / other)
    remove_abandoned_files(tmp_path, "out")
    assert sorted(one.name for one in tmp_path.iterdir()) == sorted([*kept, other, link.name])
    remove_abandoned_files(tmp_path)
    assert sorted(one.name for one in tmp_path.iterdir()) == sorted([*kept, link.name])


@locks
def test_without_locks_nothing_is_removed(tmp_path, monkeypatch):
    """A file system that has none, such as some network drives."""
    import fcntl

    def refuse(*_):
        raise OSError("no locks available")

    name = f".out.{atomic_files._host()}.1a2b3c4d{PARTIAL}"
    (tmp_path / name).write_bytes(b"")
    monkeypatch.setattr(fcntl, "flock", refuse)
    with atomic_file(tmp_path / "out") as file:
        file.write(b"whole")
    assert sorted(one.name for one in tmp_path.iterdir()) == [name, "out"]


ENUMERATES = ["-m", "gruebler", "enumerate", "--links", "14", "--format", "graph6", "--jobs", "2"]


@locks
@pytest.mark.parametrize("checkpoint", [True, False])
def test_a_killed_enumeration_leaves_nothing_after_the_next(tmp_path, scratch, checkpoint):
    out, store = tmp_path / "chains.g6", tmp_path / "kept"
    command = [sys.executable, *ENUMERATES, "-o", str(out), *(["--checkpoint", str(store)] if checkpoint else [])]
    with subprocess.Popen(command, start_new_session=True) as run:
        while run.poll() is None and not list((store if checkpoint else scratch).rglob("*.piece")):
            time.sleep(0.002)
        os.killpg(run.pid, signal.SIGKILL)  # workers too, so that all locks are free
    with suppress(ProcessLookupError):
        while True:
            os.killpg(run.pid, 0)  # until the last of them is gone
            time.sleep(0.01)
    assert any(one.name.endswith(PARTIAL) for one in tmp_path.iterdir())
    done = subprocess.run(command, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert out.read_bytes().count(b"\n") == 318162
    assert [one for one in tmp_path.rglob("*") if one.name.endswith(PARTIAL)] == []
    assert list(scratch.iterdir()) == []
