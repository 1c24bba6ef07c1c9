"""How far a search is that has several stages: a word for the stage, and a part of all that never falls back."""

from __future__ import annotations

from collections.abc import Callable

from gruebler.base.text import Message, message

_STAGE = message("{stage}: {part} %")


class SearchProgress:
    """What is told of a search while its stages count anew.

    >>> told = SearchProgress(print, "en")
    >>> told.stage(message("Looking"), 60)
    Looking: 0 %
    >>> for done in (1, 2):
    ...     told.count(done, 2)
    Looking: 15 %
    Looking: 30 %
    >>> told.count(1, 4)  # another count: half of what is left
    Looking: 33 %
    >>> told.stage(message("Drawing"), 100, start=60)
    Drawing: 60 %
    """

    def __init__(self, progress: Callable[[str], object], lang: str) -> None:
        self._progress = progress
        self._lang = lang
        self._text = message("")
        self._low = self._high = self._part = 0.0
        self._done, self._total = 0, 0

    def stage(self, text: Message, end: float, start: float = 0.0) -> None:
        """Another stage, which goes on from where the one before was, or from a start, to its end, in percent."""
        self._text = text
        self._part = self._low = max(self._part, start)
        self._high = max(end, self._low)
        self._done = self._total = 0
        self._say()

    def count(self, done: int, total: int) -> None:
        """So much of a stage is done; what is counted anew is half of what is left of it."""
        if total != self._total or done < self._done:
            self._low = self._part
        self._done, self._total = done, total
        self._part = max(self._part, self._low + (self._high - self._low) * done / (2 * total))
        self._say()

    def called(self, text: Message) -> None:
        """The same stage has another name."""
        if text is not self._text:
            self._text = text
            self._say()

    def _say(self) -> None:
        """Rounded down: all of it is done only when it is no longer told."""
        self._progress(_STAGE.filled(stage=self._text, part=int(self._part)).in_language(self._lang))
