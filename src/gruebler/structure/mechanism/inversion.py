"""Inversions: the mechanisms of one chain with another link as frame, or another joint driven.

Two choices of frame (or of frame and drives, or of frame, drives and output) give the same mechanism if an automorphism
of the chain takes one to the other. One representative of each orbit is returned, the one with the lowest numbers; the
orbits come from the generators of the automorphism group acting on the choices themselves, so they are exact for
multiple joints and joints of several freedoms too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import combinations

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import ChainError
from gruebler.base.text import LANGUAGES, Message, message
from gruebler.structure.chain import Chain
from gruebler.structure.chain.notation import link_text
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.isomorphism import Permutation, code, orbits, symmetry
from gruebler.structure.mechanism.drives import check_drives
from gruebler.structure.mechanism.model import Drive, Mechanism


@dataclass(frozen=True, slots=True)
class DrivenMechanism:
    """A driven mechanism, with its output link if an output was requested."""

    mechanism: Mechanism
    output: str | None = None

    @classmethod
    def parse(cls, text: str) -> DrivenMechanism:
        """The driven mechanism of a text, as `text` writes it; errors as for `Mechanism.parse`."""
        return cls(*Mechanism.parse_with_output(text))

    def text(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> str:
        """The mechanism's text, with a mark ``output=LINK`` if there is one; `parse` takes it back.

        >>> DrivenMechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1); output=3").text()
        'R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1); output=3'
        """
        mark = "" if self.output is None else f"; output={link_text(self.output)}"
        return self.mechanism.text(alphabet) + mark

    __str__ = text


@door_that_raises(ChainError)
def inversions(chain: Chain) -> list[Mechanism]:
    """The mechanisms of a chain, one for each orbit of links under its symmetry, without drives.

    Args:
        chain: any chain.

    Returns:
        A list of `Mechanism` without drives, as many as link orbits, in the order of their first links.

    Raises:
        GrueblerError: something else than a chain.

    Cost:
        That of the symmetry, some milliseconds for ten links.

    Example:
        >>> len(inversions(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)")))
        2

    See Also:
        `driven_mechanisms`, `symmetry`, `Mechanism`

    Theory:
        docs/theory/enumeration.md
    """
    return [Mechanism(chain, orbit[0]) for orbit in symmetry(chain).link_orbits]


@door_that_raises(ChainError)
def driven_mechanisms(
    chain: Chain, *, drives: int = 1, at_frame: bool = True, output: bool = False, fixed_only: bool = False
) -> Iterator[DrivenMechanism]:
    """One driven mechanism for each orbit of (frame, drives), or of (frame, drives, output link).

    Args:
        chain: any chain.
        drives: how many freedoms are driven.
        at_frame: whether every drive acts on the frame; otherwise a drive may be at any joint.
        output: whether to choose an output link too: any link but the frame and those that a drive moves directly
            against it.
        fixed_only: whether to leave out drives that do not fix the motion.

    Returns:
        An iterator of `DrivenMechanism`: ``mechanism`` and ``output``.

    Raises:
        GrueblerError: numbers of drives that the chain does not have.

    Cost:
        O(choices · generators); choices grow as links · joints ** drives.

    Example:
        >>> len(list(driven_mechanisms(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"))))
        4

    See Also:
        `inversions`, `decompose`, `realise`

    Theory:
        docs/theory/enumeration.md
    """
    if drives < 1:
        raise ChainError("a driven mechanism has at least one drive, not {drives}", drives=drives)
    freedoms = _freedoms(chain)
    drives = min(drives, len(freedoms) + 1)  # with more there is no choice either
    choices = [
        (frame, chosen, output_link)
        for frame in range(chain.n)
        for chosen in combinations([f for f in freedoms if not at_frame or frame in f[2]], drives)
        for output_link in (_outputs(chain, frame, chosen) if output else [-1])
    ]
    group = symmetry(chain).generators
    images = [{choice: _image(choice, g) for choice in choices} for g in group]
    for orbit in orbits(choices, images):
        frame, chosen, output_link = orbit[0]
        mechanism = Mechanism(chain, chain.links[frame], [_drive(chain, f) for f in chosen])
        if not fixed_only or check_drives(mechanism).fixed:
            yield DrivenMechanism(mechanism, chain.links[output_link] if output_link >= 0 else None)


Freedom = tuple[int, str, tuple[int, int]]
Choice = tuple[int, tuple[Freedom, ...], int]


def _freedoms(chain: Chain) -> list[Freedom]:
    """Every freedom of every joint between two of its links: joint, direction, links in ascending order."""
    return [
        (number, direction, pair)
        for number, joint in enumerate(chain.joints)
        for direction in joint.pair.freedoms[chain.space]
        for pair in combinations(sorted(chain.index(link) for link in joint.links), 2)
    ]


def _outputs(chain: Chain, frame: int, chosen: tuple[Freedom, ...]) -> list[int]:
    inputs = {link for _, _, links in chosen if frame in links for link in links}
    return [link for link in range(chain.n) if link != frame and link not in inputs]


def _image(choice: Choice, g: Permutation) -> Choice:
    frame, chosen, output_link = choice
    moved = sorted(
        (g.joints[number], direction, (min(g.links[a], g.links[b]), max(g.links[a], g.links[b])))
        for number, direction, (a, b) in chosen
    )
    return g.links[frame], tuple(moved), g.links[output_link] if output_link >= 0 else -1


def _drive(chain: Chain, freedom: Freedom) -> Drive:
    number, direction, (a, b) = freedom
    joint = chain.joints[number]
    first, other = sorted((chain.links[a], chain.links[b]), key=joint.links.index)
    return Drive(number, direction, (first, other))


# Name, mechanism. Sources: sections 2.4 and 2.6 of the teaching documents for the four-bar
# and the slider-crank chain; Watt and Stephenson as numbered by McCarthy and Soh, Geometric Design of Linkages, 2nd ed.
# 2011; the chains with two sliders as named in VDI 2145 and by Luck and Modler, Getriebetechnik, 1990. Guide and block
# of a slide have the same structure, and so have a block that turns and one that swings: dimensions distinguish them.
_FAMILIES = (
    (message("four-bar linkage"), "R(0-1) R(1-2) R(2-3) R(3-0); frame=0"),
    (message("slider-crank"), "R(0-1) R(1-2) R(2-3) P(3-0); frame=0"),
    (message("inverted slider-crank (turning or swinging block)"), "R(0-1) R(1-2) P(2-3) R(3-0); frame=0"),
    (message("Scotch yoke"), "R(0-1) R(1-2) P(2-3) P(3-0); frame=0"),
    (message("elliptic trammel (double slider)"), "P(0-1) R(1-2) R(2-3) P(3-0); frame=0"),
    (message("Oldham coupling (double slotted lever)"), "R(0-1) P(1-2) P(2-3) R(3-0); frame=0"),
    (message("Rapson slide"), "R(0-1) P(1-2) R(2-3) P(3-0); frame=0"),
    (message("Watt I"), "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); frame=0"),
    (message("Watt II"), "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); frame=2"),
    (message("Stephenson I"), "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2); frame=1"),
    (message("Stephenson II"), "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2); frame=4"),
    (message("Stephenson III"), "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2); frame=0"),
)


@cache
def _families() -> dict[str, Message]:
    known = {}
    for name, text in _FAMILIES:
        mechanism = Mechanism.parse(text)
        known[code(mechanism.chain, frame=mechanism.frame)] = name
    return known


def of_family(name: str) -> Mechanism | None:
    """The mechanism of a family by its name in any language, without drives; None if it is no such name.

    What stands in brackets may be left out, and the word linkage; capital letters do not matter.

    >>> of_family("watt II").frame, of_family("Kreuzschubkurbel") == of_family("scotch yoke")
    ('2', True)
    """
    wanted = name.casefold()
    for known, text in _FAMILIES:
        whole = [known.in_language(lang).casefold() for lang in LANGUAGES]
        short = [full.partition(" (")[0].removesuffix(" linkage").removesuffix("getriebe") for full in whole]
        if wanted in (*whole, *short):
            return Mechanism.parse(text)
    return None


def family(mechanism: Mechanism, lang: str = "en") -> str | None:
    """The name of the mechanism's family, if it has one; drives do not matter.

    >>> family(Mechanism.parse("R(a-b) R(b-c) R(c-d) P(d-a); frame=b"))
    'inverted slider-crank (turning or swinging block)'
    """
    name = _families().get(code(mechanism.chain, frame=mechanism.frame))
    return None if name is None else name.in_language(lang)
