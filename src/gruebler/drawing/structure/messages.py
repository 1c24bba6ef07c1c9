"""What pictures say of themselves, for those who cannot see them."""

from __future__ import annotations

from gruebler.chain import Chain
from gruebler.mechanism import Mechanism

__all__ = ["chain_name", "describe", "title"]

_WORDS = {
    "en": {
        "chain": "Kinematic chain",
        "mechanism": "Mechanism",
        "size": "Links: {n} ({links}). Joints: {g}. Independent loops: {loops}.",
        "kind": "{kind}: {n}",
        "frame": "Frame: {frame}.",
        "drives": "Drives: {drives}.",
        "text": "{text}.",
    },
    "de": {
        "chain": "Kinematische Kette",
        "mechanism": "Getriebe",
        "size": "Glieder: {n} ({links}). Gelenke: {g}. Unabhängige Maschen: {loops}.",
        "kind": "{kind}: {n}",
        "frame": "Gestell: {frame}.",
        "drives": "Antriebe: {drives}.",
        "text": "{text}.",
    },
}


_KINDS = {
    "en": {1: "singular", 2: "binary", 3: "ternary", 4: "quaternary"},
    "de": {1: "singulär", 2: "binär", 3: "ternär", 4: "quaternär"},
}

# What the chains of the literature are called; the first of a family of inversions tells the chain.
_CHAINS = {
    "four-bar linkage": ("four-bar chain", "Viergelenkkette"),
    "Watt I": ("Watt's chain", "Wattsche Kette"),
    "Stephenson I": ("Stephenson's chain", "Stephensonsche Kette"),
}


def chain_name(chain: Chain, lang: str = "en") -> str:
    """The name of a chain that has one, or nothing.

    >>> chain_name(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "de")
    'Viergelenkkette'
    """
    from gruebler.mechanism.inversion import family, inversions

    if chain.n > _LARGEST_NAMED:
        return ""
    families = {family(mechanism) for mechanism in inversions(chain)}
    return next((both[lang == "de"] for name, both in _CHAINS.items() if name in families), "")


_LARGEST_NAMED = 6


def title(thing: Chain | Mechanism, lang: str = "en", name: str = "") -> str:
    """The name given, or that of the chain or of the family of mechanisms, or what kind of thing it is.

    >>> title(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))
    'four-bar chain'
    """
    from gruebler.mechanism.inversion import family

    if isinstance(thing, Chain):
        return name or chain_name(thing, lang) or str(_WORDS[lang]["chain"])
    return name or family(thing, lang) or str(_WORDS[lang]["mechanism"])


def describe(thing: Chain | Mechanism, lang: str = "en") -> str:
    """Links, joints, frame and drives in a few sentences.

    >>> describe(Chain.parse("R(0-1) R(1-2) R(2-0)"))
    'Links: 3 (binary: 3). Joints: 3. Independent loops: 1. R(0-1) R(1-2) R(2-0).'
    """
    words = _WORDS[lang]
    chain = thing if isinstance(thing, Chain) else thing.chain
    alphabet = "german" if lang == "de" else "international"
    kinds = _KINDS["de" if lang == "de" else "en"]
    links = ", ".join(words["kind"].format(n=n, kind=kinds.get(k, f"{k}")) for k, n in chain.link_kinds.items())
    parts = [words["size"].format(n=chain.n, links=links, g=chain.g, loops=chain.loops)]
    if isinstance(thing, Mechanism):
        parts.append(words["frame"].format(frame=thing.frame))
        if thing.drives:
            parts.append(words["drives"].format(drives=", ".join(thing.drive_names(alphabet))))
    return " ".join([*parts, words["text"].format(text=chain.text(alphabet))])
