"""The result of a search for dimensions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import degrees

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, joined, message, plural
from gruebler.design.realisation.layout_trial import range_path
from gruebler.mechanics.analysis.cycle_spans import CycleSpan
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism import Mechanism

_FULL = message("{drive} turns fully.")
_TURNING = {
    "range": message("{drive} turns from {low:n}° to {high:n}°."),
    "well conditioned": message("It is well conditioned from {low:.0f}° to {high:.0f}°."),
    "all at once": message("{drive} is well conditioned from {low:.0f}° to {high:.0f}°, all drives at once."),
}
_SLIDING = {
    "range": message("{drive} moves from {low:n} to {high:n} {unit}."),
    "well conditioned": message("It is well conditioned from {low:n} to {high:n} {unit}."),
    "all at once": message("{drive} is well conditioned from {low:n} to {high:n} {unit}, all drives at once."),
}


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class Realisation:
    """Dimensions of a mechanism and the ranges of its drives, or the reason why there are none."""

    mechanism: Mechanism
    linkage: Linkage | None
    """None if none was found."""
    ranges: tuple[tuple[float, float], ...]
    """The well-conditioned range of each drive: radians, or the linkage's unit; all drives at once within the
    ranges."""
    full: bool
    """Whether every drive turns fully; the range is then one turn."""
    quality: float
    """The smallest measure of conditioning in the range: 1 is best, 0 singular."""
    tries: int
    """The number of drawings tried."""
    seed: int
    reason: Message | None = None
    """The reason why there was no search; None if there was one."""

    @property
    def found(self) -> bool:
        """Whether there is a linkage."""
        return self.linkage is not None

    @cached_property
    def span(self) -> CycleSpan | None:
        """The range of a single drive between its limits, as in `measures`; None for several drives."""
        return drive_cycle(self.linkage).span if self.linkage is not None and len(self.ranges) == 1 else None

    def path(self, rows: int = 361) -> NDArray[np.float64]:
        """Drive values through the ranges, for `move`: (rows, drives); several drives move at different speeds."""
        if self.linkage is None:
            raise LinkageError("there is no motion: no dimensions were found")
        return range_path(self.ranges, full=self.full, rows=rows)

    def explain(self, lang: str = "en") -> str:
        """The result as text, in English (``en``) or German (``de``)."""
        if self.reason is not None:
            return self.reason.in_language(lang)
        if self.linkage is None:
            return plural(
                "No dimensions were found with which the drives move it: {count} layout tried (seed {seed}).",
                "No dimensions were found with which the drives move it: {count} layouts tried (seed {seed}).",
                self.tries,
                lang,
                seed=self.seed,
            )
        sentences = list(self._drive_ranges(lang))
        text = message("Smallest measure of conditioning {quality:.2f} (1 is best, 0 singular).")
        sentences.append(text.filled(quality=self.quality))
        tried = plural("Tried: {count} layout.", "Tried: {count} layouts.", self.tries, lang)
        return f"{joined(sentences, ' ').in_language(lang)} {tried}"

    def _drive_ranges(self, lang: str) -> Iterator[Message]:
        """How far each drive goes, and, where that is not the same, how far it is well conditioned."""
        names = self.mechanism.drive_names(Alphabet.of_language(lang))
        unit = "" if self.linkage is None else self.linkage.unit
        for name, drive, well_conditioned in zip(names, self.mechanism.drives, self.ranges, strict=False):
            texts = _TURNING if drive.turning else _SLIDING
            if self.full:
                ranges = [(_FULL, well_conditioned)]
            elif self.span is None:
                ranges = [(texts["all at once"], well_conditioned)]
            else:
                whole = _FULL if self.span.full else texts["range"]
                ranges = [(whole, (self.span.low, self.span.high)), (texts["well conditioned"], well_conditioned)]
            for text, ends in ranges:
                low, high = (degrees(value) if drive.turning else value for value in ends)
                yield text.filled(drive=name, low=low, high=high, unit=unit)
