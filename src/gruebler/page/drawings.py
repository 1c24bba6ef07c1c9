"""What the page says of a mechanism while it is drawn: its mobility with the reason, and what would mend it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from types import MappingProxyType
from typing import Any

from gruebler.base.errors import ChainError
from gruebler.base.text import Message, message
from gruebler.page.model import spaced
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism import DriveReport, Mechanism, check_drives
from gruebler.structure.mobility import MobilityReport, mobility_report

_MOST_OFFERS = 4
_MOST_LIKE = 2  # of one kind
_BINARY = 2  # links of a joint
_OFFERS = {
    "drive": message("Drive {joint}"),
    "undrive": message("Remove the drive at {joint}"),
    "ground": message("Ground at {joint}: F = {generic}"),
    "bar": message("Add a link between {one} and {two}: F = {generic}"),
    "remove": message("Remove link {one}: F = {generic}"),
}


def drawing_record(
    joints: str,
    frame: str,
    drives: list[int],
    lang: str,
    names: Sequence[str] = (),
    ends: Mapping[str, str] = MappingProxyType({}),
    cylinders: Sequence[int] = (),
) -> dict[str, Any]:
    """Mobility, reason and offers of a chain that is drawn, as plain data.

    Joints are given by their numbers in the text, and called by the names given; ends are the names of open ends by
    their links. Cylinders are joints that one drives before pins on the frame. An offer is a change after which as many
    drives as there are give a definite motion, or a step towards it. Each that changes the chain was tried: the drives
    move what it leads to, nothing more of it is rigid, and its generic mobility stands beside it.

    Raises `GrueblerError` for a text that is no chain.

    >>> record = drawing_record("R(0-1) R(1-2) R(2-3) R(3-0)", "0", [], "en")
    >>> record["generic"], [offer["text"] for offer in record["offers"]]
    (1, ['Drive R(0-1)', 'Drive R(3-0)'])
    """
    chain = Chain.parse(joints)
    report = mobility_report(chain, frame=frame)
    driven = _driven(chain, frame, drives)
    alphabet = Alphabet.of_language(lang)
    called = [*chain.joint_names(alphabet), *driven.mechanism.drive_names(alphabet)]
    numbers = [*range(len(chain.joints)), *drives]
    titles = {text: names[k] for text, k in zip(called, numbers, strict=True) if k < len(names)}
    title = re.compile("|".join(map(re.escape, sorted(titles, key=len, reverse=True))) or "(?!)")

    def named(text: str) -> str:
        return title.sub(lambda match: titles[match[0]], text)

    def worded(offer: dict[str, Any]) -> dict[str, Any]:
        links = [spaced(link) for link in offer.get("links", ())]
        joint = named(called[offer["joint"]]) if "joint" in offer else ends.get(offer["links"][0], "")
        gaps = {"joint": joint, "generic": offer["generic"], **dict(zip(("one", "two"), links, strict=False))}
        return offer | {"text": _OFFERS[offer["kind"]].filled(**gaps).in_language(lang)}

    return {
        "counted": report.counted,
        "generic": report.generic,
        "lines": named(report.explain(lang)).splitlines()[1:],
        "fixed": driven.fixed and report.generic > 0,
        "lacking": "note" if not driven.redundant_drives and len(drives) < report.generic else "",
        "reason": named(_reason(report, driven).in_language(lang)),
        "offers": [worded(offer) for offer in islice(_offers(report, driven, drives, ends, cylinders), _MOST_OFFERS)],
    }


def _reason(report: MobilityReport, driven: DriveReport) -> Message:
    """What the drives make of the motion; of a lack of them how many."""
    lacking = 0 if driven.redundant_drives else report.generic - driven.drives
    if not report.generic:
        return message("Mobility 0: nothing moves.")
    if lacking < 1:
        return driven.message
    if report.generic == 1:
        return message("One drive is needed: choose its joint.")
    text = message("Mobility {mobility}, drives: {drives}; still needed: {lacking}.")
    return text.filled(mobility=report.generic, drives=driven.drives, lacking=lacking)


def _driven(chain: Chain, frame: str, drives: Sequence[int]) -> DriveReport:
    """What the drives do; a joint of three links and more moves the first one beside the frame."""
    parts = [chain.text(), f"frame={frame}", *(f"drive={_drive_name(chain, frame, number)}" for number in drives)]
    return check_drives(Mechanism.parse("; ".join(parts)))


def _drive_name(chain: Chain, frame: str, number: int) -> str:
    links = chain.joints[number].links
    own = frame if frame in links else links[0]
    other = next(link for link in links if link != own)
    return chain.joint_names()[number] + (f":{own}-{other}" if len(links) > 2 else "")


def _offers(
    report: MobilityReport, driven: DriveReport, drives: list[int], ends: Iterable[str], cylinders: Sequence[int]
) -> Iterator[dict[str, Any]]:
    chain, frame, generic = report.chain, report.frame, report.generic
    if generic < 1:
        yield from _removals(report, drives)
        return
    if driven.redundant_drives and report.rigid_clusters:
        yield from islice(_removals(report, drives), _MOST_LIKE)
    if driven.redundant_drives or len(drives) > generic:
        for number in [drives[k] for k in driven.redundant_drives] or drives:
            yield {"kind": "undrive", "joint": number, "generic": generic}
        return
    if len(drives) == generic:
        return
    if generic > 1:
        yield from _grounds(report, drives, ends)
        yield from _bars(report, drives)
    grounded = [number for number, joint in enumerate(chain.joints) if frame in joint.links]
    for number in [*cylinders, *(k for k in grounded if k not in cylinders)]:
        movable = number not in drives and number not in report.immobile_joints
        if not (movable and len(chain.joints[number].links) == _BINARY):
            continue
        if not _driven(chain, frame, [*drives, number]).redundant_drives:
            yield {"kind": "drive", "joint": number, "generic": generic}


def _closed(report: MobilityReport, drives: list[int], joints: str) -> MobilityReport | None:
    """The chain with further joints, if its drives can move it and nothing more of it is rigid than was before."""
    chain = Chain.parse(f"{report.chain.text()} {joints}")
    after = mobility_report(chain, frame=report.frame)
    rigid = set(map(frozenset, after.rigid_clusters)) - set(map(frozenset, report.rigid_clusters))
    if rigid or len(drives) > after.generic or _driven(chain, report.frame, drives).redundant_drives:
        return None
    return after


def _grounds(report: MobilityReport, drives: list[int], ends: Iterable[str]) -> Iterator[dict[str, Any]]:
    """Open ends that close the chain where they are held by a joint on the frame."""
    frame = report.frame
    for link in ends:
        if link == frame or any({link, frame} <= set(joint.links) for joint in report.chain.joints):
            continue
        after = _closed(report, drives, f"R({link}-{frame})")
        if after is not None and 0 < after.generic < report.generic:
            yield {"kind": "ground", "links": [link], "generic": after.generic}


def _bars(report: MobilityReport, drives: list[int]) -> Iterator[dict[str, Any]]:
    """Two links between which a further one takes a freedom; first links with one joint, and the frame."""
    chain, frame = report.chain, report.frame
    joined: Mapping[str, int] = {link: sum(link in joint.links for joint in chain.joints) for link in chain.links}
    near = {frozenset((a, b)) for joint in chain.joints for a in joint.links for b in joint.links}
    new = next(str(k) for k in range(1, chain.n + 2) if str(k) not in chain.links)
    order = sorted((link for link in chain.links if link != frame), key=lambda link: joined[link])
    pairs = [(link, frame) for link in order] + [(a, b) for a in order for b in order if a < b]
    offered = 0
    for first, second in pairs:
        if frozenset((first, second)) in near or offered == _MOST_LIKE:
            continue
        after = _closed(report, drives, f"R({first}-{new}) R({new}-{second})")
        if after is not None and after.generic == report.generic - 1:
            offered += 1
            yield {"kind": "bar", "links": [first, second], "generic": after.generic}


def _removals(report: MobilityReport, drives: list[int]) -> Iterator[dict[str, Any]]:
    """Links without which the rest moves, by the drives that stay, and nothing is rigid; those of the drives last."""
    chain, frame = report.chain, report.frame
    moved = {link for number in drives for link in chain.joints[number].links}
    late_first = [link for link in chain.links[::-1] if link != frame]
    for link in [*(link for link in late_first if link not in moved), *(link for link in late_first if link in moved)]:
        kept = {k: tuple(other for other in joint.links if other != link) for k, joint in enumerate(chain.joints)}
        left = [k for k, links in kept.items() if len(links) > 1]
        try:
            mended = Chain(
                [Joint(chain.joints[k].pair, kept[k]) for k in left],
                links=[other for other in chain.links if other != link],
                space=chain.space,
            )
        except ChainError:
            continue  # what is left falls apart, or is no chain
        after = mobility_report(mended, frame=frame)
        stay = [left.index(k) for k in drives if k in left]
        if after.generic > 0 and not after.rigid_clusters and not _driven(mended, frame, stay).redundant_drives:
            yield {"kind": "remove", "links": [link], "generic": after.generic}
