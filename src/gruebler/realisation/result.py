"""What a search for dimensions brings."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import degrees

import numpy as np
from numpy.typing import NDArray

from gruebler.analysis.drive_cycle import CycleSpan, drive_cycle
from gruebler.errors import LinkageError
from gruebler.linkages import Linkage
from gruebler.mechanism import Mechanism
from gruebler.notebook import Brief
from gruebler.realisation.layout_trial import range_path

__all__ = ["Realisation"]

_TEXT = {
    "en": {
        "full": "{drive} turns fully.",
        "turning": "{drive} turns from {low:.7g}° to {high:.7g}°.",
        "sliding": "{drive} moves from {low:.7g} to {high:.7g} {unit}.",
        "turning part": "Well conditioned it turns from {low:.0f}° to {high:.0f}°.",
        "sliding part": "Well conditioned it moves from {low:.6g} to {high:.6g} {unit}.",
        "turning at once": "{drive} turns well conditioned from {low:.0f}° to {high:.0f}°, all drives at once.",
        "sliding at once": "{drive} moves well conditioned from {low:.6g} to {high:.6g} {unit}, all drives at once.",
        "quality": "Smallest measure of conditioning {quality:.2f} (1 is best, 0 singular).",
        "tries": "Tried: {tries} drawings (seed {seed}).",
        "none": "No dimensions were found with which the drives move it: {tries} drawings tried (seed {seed}).",
    },
    "de": {
        "full": "{drive} läuft um.",
        "turning": "{drive} schwingt von {low:.7g}° bis {high:.7g}°.",
        "sliding": "{drive} schiebt von {low:.7g} bis {high:.7g} {unit}.",
        "turning part": "Mit guter Kondition schwingt er von {low:.0f}° bis {high:.0f}°.",
        "sliding part": "Mit guter Kondition schiebt er von {low:.6g} bis {high:.6g} {unit}.",
        "turning at once": "{drive} schwingt mit guter Kondition von {low:.0f}° bis {high:.0f}°, "
        "alle Antriebe zugleich.",
        "sliding at once": "{drive} schiebt mit guter Kondition von {low:.6g} bis {high:.6g} {unit}, "
        "alle Antriebe zugleich.",
        "quality": "Kleinste Gütezahl {quality:.2f} (1 ist das Beste, 0 singulär).",
        "tries": "Versucht: {tries} Zeichnungen (Startwert {seed}).",
        "none": "Keine Abmessungen gefunden, mit denen die Antriebe es bewegen: {tries} Zeichnungen versucht "
        "(Startwert {seed}).",
    },
}


@dataclass(frozen=True, repr=False)
class Realisation(Brief):
    """Dimensions of a mechanism and how its drives move it, or why there are none."""

    mechanism: Mechanism
    linkage: Linkage | None
    """None if none was found."""
    ranges: tuple[tuple[float, float], ...]
    """From where to where each drive moves well conditioned: radians, or the linkage's unit; all drives at once within
    the ranges."""
    full: bool
    """Whether every drive turns fully; the range is then one turn."""
    quality: float
    """The smallest measure of conditioning in the range: 1 is best, 0 singular."""
    tries: int
    """How many drawings were tried."""
    seed: int
    reasons: tuple[str, str] = ("", "")
    """Why nothing was sought, in English and German; empty if it was."""

    @property
    def found(self) -> bool:
        """Whether there is a linkage."""
        return self.linkage is not None

    @cached_property
    def span(self) -> CycleSpan | None:
        """From where to where a single drive moves at all, between its limits, as `measures` has it; else None."""
        return drive_cycle(self.linkage).span if self.linkage is not None and len(self.ranges) == 1 else None

    def path(self, rows: int = 361) -> NDArray[np.float64]:
        """Drive values through the ranges, for `move`: (rows, drives); several drives wind at different speeds."""
        if self.linkage is None:
            raise LinkageError("there is no motion: no dimensions were found")
        return range_path(self.ranges, full=self.full, rows=rows)

    def message(self, lang: str = "en") -> str:
        """What was found, in English (``en``) or German (``de``)."""
        text = _TEXT["de" if lang == "de" else "en"]
        if any(self.reasons):
            return self.reasons[lang == "de"]
        if self.linkage is None:
            return text["none"].format(tries=self.tries, seed=self.seed)
        said = []
        names = self.mechanism.drive_names()
        for name, drive, well in zip(names, self.mechanism.drives, self.ranges, strict=True):
            kind = "turning" if drive.turning else "sliding"
            if self.full:
                ranges = {"full": well}
            elif self.span is None:
                ranges = {f"{kind} at once": well}
            else:
                ranges = {"full" if self.span.full else kind: self.span[:2], f"{kind} part": well}
            for key, ends in ranges.items():
                low, high = (degrees(v) if kind == "turning" else v for v in ends)
                said.append(text[key].format(drive=name, low=low, high=high, unit=self.linkage.unit))
        said.append(text["quality"].format(quality=self.quality))
        said.append(text["tries"].format(tries=self.tries, seed=self.seed))
        return " ".join(said)
