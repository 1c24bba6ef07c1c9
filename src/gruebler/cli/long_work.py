"""Work that takes long: refused before it is begun unless it is wanted, and counted on a terminal meanwhile."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from time import monotonic
from typing import TypeVar

from gruebler.errors import GrueblerError

__all__ = ["ask_before", "progress", "time_text"]

T = TypeVar("T")

_LONG = 60.0


def time_text(seconds: float) -> str:
    """A time in its largest unit.

    >>> time_text(59), time_text(200), time_text(10**9)
    ('59 s', '3 min', '32 years')
    """
    for size, unit in ((365 * 86400, "years"), (86400, "d"), (3600, "h"), (60, "min")):
        if seconds >= 2 * size:
            return f"{seconds / size:,.0f} {unit}"
    return f"{seconds:.0f} s"


def ask_before(seconds: float, yes: bool) -> None:
    """Refuse what takes longer than a minute unless the caller said --yes."""
    if seconds > _LONG and not yes:
        raise GrueblerError(
            "this takes about {time} (estimated to a factor of three); say --yes to begin it nevertheless",
            time=time_text(seconds),
        )


def progress(found: Iterable[T], words: str) -> Iterator[T]:
    """What is found, counted on a terminal with these words (``n``, ``seconds``); in silence without words."""
    if not words or not sys.stderr.isatty():
        yield from found
        return
    begun = last = monotonic()
    for number, one in enumerate(found, 1):
        yield one
        if (now := monotonic()) - last > 0.2:
            last = now
            print("\r\033[K" + words.format(n=number, seconds=now - begun), end="", file=sys.stderr, flush=True)
    if last > begun:
        print("\r\033[K", end="", file=sys.stderr, flush=True)
