"""Whether the drives of a mechanism fix its motion."""

from __future__ import annotations

from dataclasses import dataclass

from gruebler.base.notebook import explained
from gruebler.base.text import Message, joined, message
from gruebler.structure.chain.pairs import Alphabet, in_alphabets
from gruebler.structure.mechanism.model import Mechanism
from gruebler.structure.mobility import generic
from gruebler.structure.mobility.placement import LockedFreedom


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class DriveReport:
    """Whether the drives fix the motion of a mechanism, at almost all sizes."""

    mechanism: Mechanism
    mobility: int
    drives: int
    remaining: int
    """The mobility left when every drive is locked."""
    free_links: tuple[str, ...]
    """The links that still move then."""
    redundant_drives: tuple[int, ...]
    """The drives (by place) that work against others: without them the same motions are fixed."""

    @property
    def fixed(self) -> bool:
        """Whether the drives fix every link and none works against another."""
        return self.remaining == 0 and not self.redundant_drives

    def explain(self, lang: str = "en") -> str:
        """The report in one sentence or two, in English (``en``) or German (``de``)."""
        return self.message.in_language(lang)

    @property
    def message(self) -> Message:
        """The text of `explain` as a message, for any language."""
        if self.fixed and self.mobility == self.drives:
            if self.drives == 1:
                return message("Mobility 1 and one drive: the motion is determined.")
            return message("Mobility {drives} and {drives} drives: the motion is determined.", drives=self.drives)
        sentences = [message("Mobility {mobility}, drives: {drives}.", mobility=self.mobility, drives=self.drives)]
        if self.fixed:
            sentences.append(message("The drives fix the motion."))
        if self.remaining:
            text = message("Freedoms left with the drives locked: {freedoms}; still moving: {links}.")
            sentences.append(text.filled(freedoms=self.remaining, links=", ".join(self.free_links)))
        if self.redundant_drives:
            drives = in_alphabets(self._names_of_redundant)
            if len(self.redundant_drives) > 1:
                sentences.append(message("Drives that conflict: {drives}.", drives=drives))
            else:
                text = message("{drive} cannot be driven: at almost all sizes it does not move.")
                sentences.append(text.filled(drive=drives))
        return joined(sentences, " ")

    def _names_of_redundant(self, alphabet: Alphabet) -> str:
        names = self.mechanism.drive_names(alphabet)
        return ", ".join(names[k] for k in self.redundant_drives)


def check_drives(mechanism: Mechanism) -> DriveReport:
    """Lock the drives and compute the mobility that remains.

    A drive is redundant if locking it is a consequence of the chain and of the other drives: it takes part in a
    dependency of the constraints. Cost: two generic ranks.

    >>> check_drives(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); drive=R(0-1)")).remaining
    1
    """
    chain = mechanism.chain
    locks = [LockedFreedom(d.joint, d.direction, d.between) for d in mechanism.drives]
    free, locked = generic(chain), generic(chain, locks)
    first = len(locked.placement.rows) - len(locks)
    still = set(next(cluster for cluster in locked.clusters if mechanism.frame in cluster))
    moving = tuple(link for link in chain.links if link not in still)
    redundant = tuple(k for k in range(len(locks)) if locked.redundancy and locked.some_stresses[first + k].any())
    return DriveReport(
        mechanism=mechanism,
        mobility=free.mobility,
        drives=len(locks),
        remaining=locked.mobility,
        free_links=moving,
        redundant_drives=redundant,
    )
