"""The command line in a process of its own, with limits of time and memory."""

from __future__ import annotations

import json
import os
import re
import resource
import signal
import sys
import traceback
from contextlib import redirect_stderr, redirect_stdout, suppress
from dataclasses import dataclass
from pathlib import Path

from gruebler.base.atomic_files import PARTIAL
from gruebler.base.errors import LONGEST
from gruebler.cli import main

SECONDS = 10  # of the processor, for one input
MEMORY = 10**9  # bytes that one input may take beyond what the loaded program has
_CRASHED = 70  # exit status of a process that ended with a traceback
_MESSAGE = LONGEST + 200  # the command's name and a hint stand around the message itself
_STEERING = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")  # not \t and \n
_TOO_LITTLE = "needs more memory than there is"


@dataclass(frozen=True)
class Outcome:
    """How one run ended."""

    status: int
    out: bytes
    err: str
    seconds: float
    """Of the processor."""
    memory: int
    """Bytes beyond what the loaded program had."""

    def fault(self, arguments: list[str]) -> str | None:
        """What is wrong with it, or None."""
        lines = self.err.strip().splitlines() or [""]
        refused = self.status == 2
        faults = {
            f"traceback: {lines[-1][:200]}": "Traceback (most recent call last)" in self.err,
            f"more than {SECONDS} s": self.status == -signal.SIGXCPU or self.seconds > SECONDS,
            f"more than {MEMORY / 1e9:g} GB": _TOO_LITTLE in self.err or self.memory > MEMORY,
            f"ended with status {self.status}": self.status not in (0, 1, 2),
            f"{len(lines)} lines of message: {self.err[:200]!r}": refused and len(lines) != 1,
            f"a message of {len(self.err):,} characters": refused and not 0 < len(self.err) <= _MESSAGE,
            f"a warning: {self.err[:200]!r}": "Warning" in self.err,
            f"control characters: {self.err[-200:]!r}": _STEERING.search(self.err) is not None,
            f"not JSON: {self.out[:200]!r}": not refused and "--json" in arguments and not _is_json(self.out),
        }
        return next((what for what, wrong in faults.items() if wrong), None)


def _is_json(content: bytes) -> bool:
    def refuse(word: str) -> None:
        raise ValueError(word)

    try:
        json.loads(content.decode("utf-8"), parse_constant=refuse)
    except ValueError:
        return False
    return True


def warm(arguments: list[str], folder: Path) -> int:
    """Run once in this process, so that what it imports is loaded for all processes made afterwards."""
    with (folder / "out").open("w") as file, redirect_stdout(file), redirect_stderr(file):
        return _called(arguments)


def _called(arguments: list[str]) -> int:
    try:
        return main(arguments)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 2


def run(arguments: list[str], folder: Path, *, seconds: int = SECONDS) -> Outcome:
    """Run in a forked process in a folder; it is ended when it takes too much."""
    out, err = folder / ".out", folder / ".err"
    child = os.fork()
    if child == 0:
        _become(arguments, folder, out, err, seconds)
    _, ended, used = os.wait4(child, 0)
    grown = used.ru_maxrss * (1 if sys.platform == "darwin" else 1024) - _resident()
    outcome = Outcome(
        os.waitstatus_to_exitcode(ended),
        out.read_bytes(),
        err.read_text(encoding="utf-8", errors="replace"),
        used.ru_utime + used.ru_stime,
        max(grown, 0),
    )
    out.unlink()
    err.unlink()
    return outcome


def _become(arguments: list[str], folder: Path, out: Path, err: Path, seconds: int) -> None:
    """What the forked process does; it never returns."""
    status = _CRASHED
    try:
        os.chdir(folder)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        for number, path in ((1, out), (2, err)):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        sys.stdin = os.fdopen(0, encoding="utf-8")
        sys.stdout, sys.stderr = os.fdopen(1, "w", encoding="utf-8"), os.fdopen(2, "w", encoding="utf-8")
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(60 * seconds)  # for a process that waits for something; the processor's time is the measure
        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if (size := _virtual()) is not None:
                resource.setrlimit(resource.RLIMIT_AS, (size + 2 * MEMORY, -1))
        status = _called(arguments)
    except BaseException:
        traceback.print_exc()
    finally:
        with suppress(Exception):
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(status)


def _statm(column: int) -> int | None:
    try:
        return int(Path("/proc/self/statm").read_text().split()[column]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return None


def _virtual() -> int | None:
    """Bytes of address space of this process; None where the system does not say."""
    return _statm(0)


def _resident() -> int:
    """Bytes of memory of this process; 0 where the system does not say."""
    return _statm(1) or 0


def partial_files(folder: Path) -> list[Path]:
    """Files that were left incomplete."""
    return [path for path in folder.rglob("*") if path.name.endswith(PARTIAL)]
