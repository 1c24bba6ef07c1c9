"""What a file has that the value does not have, or the other way round: said once the command has done its work."""

from __future__ import annotations

import sys
from collections.abc import Iterable

from gruebler.base.errors import shortened
from gruebler.base.text import Message, translate

_notes: list[str] = []


def say_left_out(notes: Iterable[Message], lang: str) -> None:
    """Keep what was left out for `print_left_out`: a command that refuses says why in one line, without these."""
    _notes.extend(shortened(translate("Left out: {what}", lang, what=note)) for note in notes)


def print_left_out(*, done: bool) -> None:
    """Print what was left out on standard error if the command has done its work; forget it in any case."""
    for note in _notes if done else ():
        print(note, file=sys.stderr)
    _notes.clear()
