"""The command `gruebler` from its first moment, outside the package so that nothing of it is loaded before this.

An interrupt while modules load ends the command with one word and status 130, not with a traceback. Once a command
works, `gruebler.cli` lets interrupts be raised again, so that what was begun is ended in order.
"""

import os
import signal
import sys
from types import FrameType


def _stop(number: int, frame: FrameType | None) -> None:
    """End at once: nothing has been begun. The catalogs of texts are not loaded yet."""
    del number, frame
    words = " ".join(["--lang", os.environ.get("GRUEBLER_LANG", ""), *sys.argv[1:]]).replace("--lang=", "--lang ")
    german = words.rpartition("--lang ")[2].split(" ")[0] == "de"
    os.write(2, b"\ngruebler: abgebrochen\n" if german else b"\ngruebler: stopped\n")
    os._exit(130)


if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # a shell lets jobs in the background ignore it
    signal.signal(signal.SIGINT, _stop)


def main() -> int:
    """Run the command of the words in `sys.argv`; returns the exit status."""
    from gruebler.cli import main as run

    return run()


if __name__ == "__main__":
    sys.exit(main())
