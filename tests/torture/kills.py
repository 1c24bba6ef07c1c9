"""Enumerations killed at random moments and continued, their checkpoints damaged in between."""

from __future__ import annotations

import os
import random
import signal
import time
from collections import Counter
from pathlib import Path

from tests.torture.processes import partial_files, run, warm

_LIST = ("enumerate", "--links", "14", "--format", "graph6", "--jobs", "2", "-o", "chains.g6", "--checkpoint", "kept")
_COUNT = (
    "enumerate",
    "--links",
    "16",
    "--count",
    "--orbits",
    "--jobs",
    "2",
    "-o",
    "count.json",
    "--checkpoint",
    "kept",
)
_KINDS = (_LIST, _COUNT)
VICTIMS = ("the run", "a worker", "all")


def kill_all(kills: int, seed: int, folder: Path) -> Counter[str]:
    """Kill so many times; what happened, by name. `AssertionError` at the first fault."""
    told: Counter[str] = Counter()
    scratch = folder / "tmp"
    scratch.mkdir()
    os.environ["TMPDIR"] = str(scratch)
    work = folder / "work"
    work.mkdir()
    chance = random.Random(seed)
    for small in (["--format", "graph6"], ["--count"]):  # load the kernels once, not in every process
        warm(["enumerate", "--links", "10", *small], work)
    (work / "out").unlink()
    expected, seconds = {}, {}
    for arguments in _KINDS:
        begun = time.monotonic()
        outcome = run([word for word in arguments if word not in ("--checkpoint", "kept")], work, seconds=600)
        seconds[arguments] = time.monotonic() - begun
        assert outcome.status == 0, outcome.err
        out = work / arguments[arguments.index("-o") + 1]
        expected[arguments] = out.read_bytes()
        out.unlink()
    arguments = chance.choice(_KINDS)
    while told["kills"] < kills or told["unfinished"]:
        child = _begin(arguments, work)
        out = work / arguments[arguments.index("-o") + 1]
        victim = chance.choice(VICTIMS) if told["kills"] < kills else None
        if victim is not None:
            time.sleep(chance.uniform(0, 0.8 * seconds[arguments]))
            told[f"killed: {victim}"] += (hit := _kill(child, victim, chance))
            told["kills"] += hit
        _, ended = os.waitpid(child, 0)
        _no_process_of(child)
        status = os.waitstatus_to_exitcode(ended)
        if status == 0:
            assert out.read_bytes() == expected[arguments], f"another result after {told['kills']} kills"
            left = [*partial_files(work), *scratch.iterdir()]
            assert not left, f"left behind: {left}"
            told["finished runs, same bytes"] += 1
            told["unfinished"] = 0
            for path in [out, *(work / "kept").iterdir()]:
                path.unlink()
            (work / "kept").rmdir()
            arguments = chance.choice(_KINDS)
            continue
        assert status == -signal.SIGKILL, (work / ".err").read_text()
        assert not out.exists(), "a file that is not complete"
        told["unfinished"] = 1
        told["temporary files after a kill"] += len([*partial_files(work), *scratch.iterdir()])
        if chance.random() < 0.3:
            told["damaged pieces"] += _damage(work / "kept", chance)
    del told["unfinished"]
    return told


def _begin(arguments: tuple[str, ...], work: Path) -> int:
    """A process group of its own that runs the command."""
    child = os.fork()
    if child == 0:
        try:
            os.setpgid(0, 0)
            os.chdir(work)
            log = os.open(".err", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(log, 1)
            os.dup2(log, 2)
            os._exit(warm(list(arguments), work))
        finally:
            os._exit(70)
    return child


def _kill(child: int, victim: str, chance: random.Random) -> int:
    """Kill the run, one of its workers, or all; 1 if there was one to kill."""
    members = _group(child)
    workers = [pid for pid in members if pid != child]
    if victim == "a worker" and not workers:
        return 0
    if child not in members:
        return 0  # it had finished
    if victim == "all":
        os.killpg(child, signal.SIGKILL)
    else:
        os.kill(chance.choice(workers) if victim == "a worker" else child, signal.SIGKILL)
    return 1


def _group(leader: int) -> list[int]:
    """The living processes of a group."""
    found = []
    for path in Path("/proc").iterdir():
        if path.name.isdigit():
            try:
                state, _, group = (path / "stat").read_text().rsplit(")", 1)[1].split()[:3]
            except OSError:
                continue
            if int(group) == leader and state not in "ZX":
                found.append(int(path.name))
    return found


def _no_process_of(leader: int) -> None:
    """Wait until a group has ended; its workers must end by themselves."""
    end = time.monotonic() + 60
    while _group(leader):
        assert time.monotonic() < end, "workers outlive their run"
        time.sleep(0.01)


def _damage(kept: Path, chance: random.Random) -> int:
    """Flip a bit of a piece, cut it off, copy another one over it, or exchange two; how many pieces were damaged."""
    pieces = sorted(kept.glob("*.piece")) if kept.exists() else []
    if not pieces:
        return 0
    one, other = chance.choice(pieces), chance.choice(pieces)
    content, copied = one.read_bytes(), other.read_bytes()
    at = chance.randrange(len(content))
    kind = chance.randrange(4)
    if kind == 0:
        one.write_bytes(content[:at] + bytes([content[at] ^ 1 << chance.randrange(8)]) + content[at + 1 :])
    elif kind == 1:
        one.write_bytes(content[:at])
    else:
        one.write_bytes(copied)
        if kind == 3:
            other.write_bytes(content)
    return 1
