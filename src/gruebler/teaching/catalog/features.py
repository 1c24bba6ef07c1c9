"""Access features: the criteria for sorting and searching mechanisms, derived from the structure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from gruebler.base.text import Message, Text, arity, message
from gruebler.structure.chain.pairs import Alphabet, Contact, Pair
from gruebler.structure.mechanism import Mechanism

_GUIDES, _TRANSMITS = message("guide mechanism"), message("transmits a motion")


@dataclass(frozen=True, slots=True, kw_only=True)
class AccessFeatures:
    """The numbers of drive joints, output links, and links and joints by kind; a joint of k links counts k - 1."""

    drive_joints: int
    drive_joints_at_frame: int
    """Those of them that drive a link against the frame."""
    output_links: int
    output_links_at_frame: int
    """Those of them that are jointed to the frame."""
    links: int
    links_by_joints: tuple[tuple[int, int], ...]
    """Number of joints on a link, number of such links; ascending."""
    joints: int
    joints_by_pair: tuple[tuple[Pair, int], ...]
    """Kind of joint, number; the most frequent first."""

    def by_symbol(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> tuple[tuple[str, int], ...]:
        """Symbols of the joints in one alphabet, with their numbers."""
        return tuple((kind.symbol(Alphabet(alphabet)), count) for kind, count in self.joints_by_pair)

    def described(self, lang: str = "en") -> tuple[tuple[str, str], ...]:
        """A label and a value for each of the four features."""
        alphabet = Alphabet.of_language(lang)
        links = ", ".join(f"{count} {arity(k, lang)}" for k, count in self.links_by_joints)
        joints = ", ".join(
            f"{count} {_name(kind, count, lang)} ({kind.symbol(alphabet)})" for kind, count in self.joints_by_pair
        )
        at_frame = message("{all}, {count} of them at the frame")
        of_these = message("{all}, of these {kinds}")
        rows = (
            (message("Drive joints"), at_frame.filled(all=self.drive_joints, count=self.drive_joints_at_frame)),
            (message("Output links"), at_frame.filled(all=self.output_links, count=self.output_links_at_frame)),
            (message("Links"), of_these.filled(all=self.links, kinds=links)),
            (message("Joints"), of_these.filled(all=self.joints, kinds=joints)),
        )
        return tuple((label.in_language(lang), value.in_language(lang)) for label, value in rows)


def _name(kind: Pair, count: int, lang: str) -> str:
    """The kind of joint, singular or plural."""
    return Text(en=kind.plain_name("en"), de=kind.german + "e" * (count > 1)).in_language(lang)


def access_features(mechanism: Mechanism, outputs: Iterable[str] = ()) -> AccessFeatures:
    """The access features of a mechanism with these output links.

    Raises `gruebler.ChainError` for an output that is no link of it.

    >>> four_bar = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)")
    >>> features = access_features(four_bar, ["2"])
    >>> features.drive_joints_at_frame, features.output_links_at_frame, features.links_by_joints
    (1, 0, ((2, 4),))
    >>> features.by_symbol("german")
    (('D', 4),)
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
        drive_joints=len(driven),
        drive_joints_at_frame=sum(driven.values()),
        output_links=len(chosen),
        output_links_at_frame=sum(link in near for link in chosen),
        links=chain.n,
        links_by_joints=tuple(chain.link_kinds.items()),
        joints=sum(counts.values()),
        joints_by_pair=tuple(sorted(counts.items(), key=lambda item: (-item[1], item[0].name))),
    )


def guided_links(mechanism: Mechanism, outputs: Iterable[str]) -> tuple[str, ...]:
    """Those of these output links that are guided: not jointed to the frame, and without a higher pair.

    >>> four_bar = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3)")
    >>> guided_links(four_bar, ["2", "3"])
    ('2',)
    """
    at_frame = {link for joint in mechanism.chain.joints_of(mechanism.frame) for link in joint.links}
    rolling = {link for j in mechanism.chain.joints if j.pair.contact is Contact.HIGHER for link in j.links}
    return tuple(link for link in outputs if link not in at_frame | rolling)


def purpose(mechanism: Mechanism, outputs: Iterable[str]) -> Message:
    """What a mechanism with these output links is for: it guides a link, or it transmits a motion.

    >>> print(purpose(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3)"), ["3"]))
    transmits a motion
    """
    return _GUIDES if guided_links(mechanism, outputs) else _TRANSMITS
