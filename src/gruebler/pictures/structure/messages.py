"""Titles and descriptions of pictures, as alternative text."""

from __future__ import annotations

from gruebler.base.text import arity, message, translate
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

# The names of chains in the literature; the first of a family of inversions identifies the chain.
_CHAINS = {
    "four-bar linkage": message("four-bar chain"),
    "Watt I": message("Watt's chain"),
    "Stephenson I": message("Stephenson's chain"),
}


def chain_name(chain: Chain, lang: str = "en") -> str:
    """The name of a chain, or an empty text.

    >>> chain_name(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "de")
    'Viergelenkkette'
    """
    from gruebler.structure.mechanism.inversion import family, inversions

    if chain.n > _LARGEST_NAMED:
        return ""
    families = {family(mechanism) for mechanism in inversions(chain)}
    return next((known.in_language(lang) for name, known in _CHAINS.items() if name in families), "")


_LARGEST_NAMED = 6


def title(structure: Chain | Mechanism, lang: str = "en", name: str = "") -> str:
    """The given name, or that of the chain or of the family of mechanisms, or its kind.

    In space that of a single loop has the letters of its joints.

    >>> title(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))
    'four-bar chain'
    >>> title(Mechanism.parse("spatial: R(body-crank) R(body-rocker) S(crank-rod) S(rod-rocker)"))
    'RSSR linkage'
    >>> title(Mechanism.parse("spatial: R(0-1) R(1-2) R(2-3) R(3-4) R(4-5) R(5-0)"), "de")
    '6D-Getriebe'
    """
    from gruebler.structure.mechanism.inversion import family

    if isinstance(structure, Chain):
        return name or chain_name(structure, lang) or translate("Kinematic chain", lang)
    return name or family(structure, lang) or _name_in_space(structure, lang) or translate("Mechanism", lang)


def _name_in_space(mechanism: Mechanism, lang: str) -> str:
    """By the letters around a loop, from the frame on, or by the number of links; empty in the plane."""
    chain = mechanism.chain
    if chain.space is Space.PLANAR:
        return ""
    count = chain.n
    if chain.space is Space.SPHERICAL:
        return translate("Spherical linkage with {count} links", lang, count=count)
    if chain.loops > 1 or any(len(joint.links) > 2 for joint in chain.joints):
        return translate("Linkage in space with {count} links", lang, count=count)
    letters, link, left = [], mechanism.frame, list(chain.joints)
    while (joint := next((each for each in left if link in each.links), None)) is not None:
        left.remove(joint)
        link = next(other for other in joint.links if other != link)
        letters.append(str(joint.pair.symbol(Alphabet.of_language(lang))))
    between = "" if all(len(letter) == 1 for letter in letters) else "-"
    alike = len(set(letters)) == 1
    shown = f"{len(letters)}{letters[0]}" if alike else between.join(letters)
    return translate("{letters} linkage", lang, letters=shown)


def describe(structure: Chain | Mechanism, lang: str = "en") -> str:
    """Links, joints, frame and drives in a few sentences.

    >>> describe(Chain.parse("R(0-1) R(1-2) R(2-0)"))
    'Links: 3 (binary: 3). Joints: 3. Independent loops: 1. R(0-1) R(1-2) R(2-0).'
    """
    chain = structure if isinstance(structure, Chain) else structure.chain
    alphabet = Alphabet.of_language(lang)
    kinds = ", ".join(f"{arity(k, lang)}: {n}" for k, n in chain.link_kinds.items())
    parts = [
        translate(
            "Links: {links} ({kinds}). Joints: {joints}. Independent loops: {loops}.",
            lang,
            links=chain.n,
            kinds=kinds,
            joints=chain.g,
            loops=chain.loops,
        )
    ]
    if isinstance(structure, Mechanism):
        parts.append(translate("Frame: {frame}.", lang, frame=structure.frame))
        if structure.drives:
            parts.append(translate("Drives: {drives}.", lang, drives=", ".join(structure.drive_names(alphabet))))
    return " ".join([*parts, f"{chain.text(alphabet)}."])
