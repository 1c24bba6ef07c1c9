"""Commands interrupted at random moments of their first second."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from tests.torture.processes import partial_files

_COMMANDS = (
    ("--help",),
    ("check", "crankrocker"),
    ("analyse", "lambda"),
    ("draw", "vcomp", "-o", "out.svg"),
    ("enumerate", "--links", "12", "--count"),
    ("gears", "sun:24 planet:18 ring:-60 on arm planets=3; hold ring; sun=1"),
    ("synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60"),
    ("atlas", "query", "select code from chains where links = 6"),
)
# Also below a job in the background, which ignores interrupts.
_DEFAULT = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
_START = f"{_DEFAULT}; import sys; from gruebler_command import main; sys.exit(main())"  # as the installed script


def interrupt_all(interrupts: int, seed: int, folder: Path) -> Counter[str]:
    """Interrupt so many times; what happened, by name. `AssertionError` at the first fault.

    A command that is interrupted says one line and ends with 130; before the first line of ours runs, Python ends as
    it likes: its own tracebacks, which name no file of ours, are counted apart.
    """
    told: Counter[str] = Counter()
    chance = random.Random(f"interrupts/{seed}")
    for number in range(interrupts):
        command = chance.choice(_COMMANDS)
        running = subprocess.Popen(
            [sys.executable, "-c", _START, *command],
            cwd=folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        time.sleep(chance.uniform(0, 1))
        running.send_signal(signal.SIGINT)
        said = running.communicate(timeout=120)[1]
        where = f"interrupt {number} of {command}: status {running.returncode}\n{said}"
        assert not partial_files(folder), where
        if "Traceback" in said:
            assert "gruebler" not in said.replace(_START, ""), where
            told["interrupted before our first line"] += 1
        elif running.returncode == 130:
            assert said.strip() == "gruebler: stopped", where
            told["stopped"] += 1
        elif running.returncode == 0:
            told["had ended"] += 1
        else:
            assert running.returncode == -signal.SIGINT, where
            told["interrupted before our first line"] += 1
    return told
