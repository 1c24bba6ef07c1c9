"""Work that takes long: refused beforehand without --yes, and counted on a terminal meanwhile."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import TYPE_CHECKING, TypeVar

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message, translate

if TYPE_CHECKING:
    from gruebler.structure.enumeration.worker_pool import Progress

T = TypeVar("T")

_LONG = 60.0
_UNITS = (
    (365 * 86400, message("{count:,.0f} years")),
    (86400, message("{count:,.0f} d")),
    (3600, message("{count:,.0f} h")),
    (60, message("{count:,.0f} min")),
)


def time_text(seconds: float) -> Message:
    """A time in its largest unit.

    >>> [str(time_text(seconds)) for seconds in (59, 200, 10**9)]
    ['59 s', '3 min', '32 years']
    """
    for size, unit in _UNITS:
        if seconds >= 2 * size:
            return unit.filled(count=seconds / size)
    return message("{count:.0f} s", count=seconds)


def ask_before(seconds: float, yes: bool) -> None:
    """Refuse what takes longer than a minute unless --yes was given."""
    if seconds > _LONG and not yes:
        raise GrueblerError(
            "this takes about {time} (estimated to a factor of three); add --yes to start anyway",
            time=time_text(seconds),
        )


def progress(items: Iterable[T], words: str) -> Iterator[T]:
    """The items, counted on a terminal with these words (``n``, ``seconds``); in silence without words."""
    if not words or not sys.stderr.isatty():
        yield from items
        return
    begun = last = monotonic()
    for count, item in enumerate(items, 1):
        yield item
        if (now := monotonic()) - last > 0.2:
            last = now
            print("\r\033[K" + words.format(n=count, seconds=now - begun), end="", file=sys.stderr, flush=True)
    if last > begun:
        print("\r\033[K", end="", file=sys.stderr, flush=True)


@contextmanager
def run_progress(lang: str) -> Iterator[Callable[[Progress], None] | None]:
    """Something that draws the progress on a terminal; None elsewhere."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.live import Live
    from rich.text import Text

    # Without a thread of its own, so that worker processes can be forked.
    with Live(console=Console(stderr=True), auto_refresh=False, transient=True) as live:
        shown = 0.0

        def draw(progress: Progress) -> None:
            nonlocal shown
            if progress.seconds - shown < 0.2:
                return
            shown = progress.seconds
            seconds = progress.seconds_left
            left = "" if seconds is None else message("about {time} left", time=time_text(seconds))
            line = translate(
                "parts: {parts}  chains: {chains:,}  {rate:,.0f}/s  {left}",
                lang,
                parts=progress.pieces,
                chains=progress.chains,
                rate=progress.rate,
                left=left,
            )
            live.update(Text(line), refresh=True)

        yield draw


def count_line(words: Message, lang: str) -> Callable[[int, int], None] | None:
    """A line on a terminal that counts what the words say, by ``done`` and ``count``; None elsewhere."""
    if not sys.stderr.isatty():
        return None

    def show(done: int, count: int) -> None:
        line = words.filled(done=done, count=count).in_language(lang)
        print(f"\r\033[K{line}", end="\n" if done >= count else "", file=sys.stderr, flush=True)

    return show
