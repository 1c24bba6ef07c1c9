"""Access features: by what a collection of mechanisms is ordered and searched, derived from the structure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from gruebler.chain.pairs import Alphabet, Pair
from gruebler.mechanism import Mechanism

__all__ = ["AccessFeatures", "access_features"]


@dataclass(frozen=True, slots=True)
class AccessFeatures:
    """How many drive joints, output links, links and joints of which kind; a joint of k links counts k - 1."""

    drive_joints: int
    drive_joints_at_frame: int
    """Those of them that drive a link against the frame."""
    output_links: int
    output_links_at_frame: int
    """Those of them that are jointed to the frame."""
    links: int
    links_by_joints: tuple[tuple[int, int], ...]
    """Number of joints on a link, how many such links; ascending."""
    joints: int
    joints_by_pair: tuple[tuple[Pair, int], ...]
    """Kind of joint, how many; the most frequent first."""

    def by_symbol(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> tuple[tuple[str, int], ...]:
        """Symbols of the joints in one alphabet, how many."""
        return tuple((kind.symbol(Alphabet(alphabet)), count) for kind, count in self.joints_by_pair)

    def described(self, lang: str = "en") -> tuple[tuple[str, str], ...]:
        """A label and a value for each of the four features."""
        words, german = _WORDS[lang], lang == "de"
        alphabet = Alphabet.GERMAN if german else Alphabet.INTERNATIONAL
        links = ", ".join(
            f"{count} {_ARITY[lang].get(k, words['arity'].format(k=k))}" for k, count in self.links_by_joints
        )
        joints = ", ".join(
            f"{count} {_name(kind, german, count)} ({kind.symbol(alphabet)})" for kind, count in self.joints_by_pair
        )
        frame = words["frame"]
        return (
            (words["drives"], f"{self.drive_joints}, {frame.format(count=self.drive_joints_at_frame)}"),
            (words["outputs"], f"{self.output_links}, {frame.format(count=self.output_links_at_frame)}"),
            (words["links"], f"{self.links}, {words['of_them']}{links}"),
            (words["joints"], f"{self.joints}, {words['of_them']}{joints}"),
        )


_WORDS = {
    "en": {
        "drives": "Drive joints",
        "outputs": "Output links",
        "links": "Links",
        "joints": "Joints",
        "frame": "{count} of them at the frame",
        "of_them": "of these ",
        "arity": "with {k} joints",
    },
    "de": {
        "drives": "Antriebsgelenke",
        "outputs": "Abtriebsglieder",
        "links": "Glieder",
        "joints": "Gelenke",
        "frame": "davon {count} am Gestell",
        "of_them": "davon ",
        "arity": "mit {k} Gelenken",
    },
}
_ARITY = {
    "en": {1: "singular", 2: "binary", 3: "ternary", 4: "quaternary"},
    "de": {1: "singulär", 2: "binär", 3: "ternär", 4: "quaternär"},
}


def _name(kind: Pair, german: bool, count: int) -> str:
    return kind.german + "e" * (count > 1) if german else kind.name.replace("_", "-")


def access_features(mechanism: Mechanism, outputs: Iterable[str] = ()) -> AccessFeatures:
    """The access features of a mechanism with these output links.

    Raises `gruebler.ChainError` for an output that is no link of it.

    >>> four_bar = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    >>> found = access_features(four_bar, ["2"])
    >>> found.drive_joints_at_frame, found.output_links_at_frame, found.links_by_joints, found.by_symbol("german")
    (1, 0, ((2, 4),), (('D', 4),))
    """
    chain, frame = mechanism.chain, mechanism.frame
    chosen = tuple(dict.fromkeys(outputs))
    near = {link for joint in chain.joints_of(frame) for link in joint.links}
    for link in chosen:
        chain.index(link)
    counts: Counter[Pair] = Counter()
    for joint in chain.joints:
        counts[joint.pair] += len(joint.links) - 1
    driven = {drive.joint: frame in drive.between for drive in mechanism.drives}
    return AccessFeatures(
        len(driven),
        sum(driven.values()),
        len(chosen),
        sum(link in near for link in chosen),
        chain.n,
        tuple(chain.link_kinds.items()),
        sum(counts.values()),
        tuple(sorted(counts.items(), key=lambda one: (-one[1], one[0].name))),
    )
