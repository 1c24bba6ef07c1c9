"""A progress bar on a terminal while kernels are compiled."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from gruebler._numeric.compiling import on_compiling, wanted_tier
from gruebler.base.errors import GrueblerError
from gruebler.base.text import translate

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID


def show_compiling(lang: str = "en") -> None:
    """Show on standard error what is compiled, if that is a terminal; else be silent.

    Raises:
        GrueblerError: GRUEBLER_KERNELS has a value that does not exist.
    """
    try:
        wanted_tier()
    except ValueError as error:
        raise GrueblerError("{reason}", reason=str(error)) from None
    words = translate("Compiling (once; kept for later runs)", lang)
    on_compiling(_ProgressBar(words).draw if sys.stderr.isatty() else None)


class _ProgressBar:
    """A bar while something is compiled in this process; workers are silent.

    It has no thread of its own, so that worker processes can be forked.
    """

    def __init__(self, words: str) -> None:
        self.words, self.process = words, os.getpid()
        self.bar: Progress | None = None
        self.task: TaskID | None = None

    def draw(self, kernel: str, done: int, of: int) -> None:
        if os.getpid() != self.process:
            return
        if not kernel:
            if self.bar is not None:
                self.bar.stop()
            self.bar = None
            return
        if self.bar is None:
            from rich.console import Console
            from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

            columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()
            self.bar = Progress(*columns, console=Console(stderr=True), transient=True, auto_refresh=False)
            self.task = self.bar.add_task(self.words, total=of, completed=done)
            self.bar.start()
        if self.task is not None:
            self.bar.update(self.task, completed=done, total=of, refresh=True)
