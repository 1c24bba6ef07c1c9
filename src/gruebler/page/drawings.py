"""What the page says of a mechanism while it is drawn: its mobility with the reason, and what would mend it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gruebler.base.errors import ChainError
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.mechanism import Mechanism, check_drives
from gruebler.structure.mobility import MobilityReport, mobility_report

_MOST_OFFERS = 4
_MOST_BARS = 2


def drawing_record(
    joints: str, frame: str, drives: list[int], lang: str, names: Sequence[str] = (), ends: Sequence[str] = ()
) -> dict[str, Any]:
    """Mobility, reason and offers of a chain that is drawn, as plain data.

    Joints are given by their numbers in the text, and called by the names given; ends are links with an open end. An
    offer is a change after which as many drives as there are give a definite motion, or a step towards it. Each that
    changes the chain was tried: its generic mobility stands beside it.

    Raises `GrueblerError` for a text that is no chain.

    >>> record = drawing_record("R(0-1) R(1-2) R(2-3) R(3-0)", "0", [], "en")
    >>> record["generic"], [offer["joint"] for offer in record["offers"]]
    (1, [0, 3])
    """
    chain = Chain.parse(joints)
    report = mobility_report(chain, frame=frame)
    parts = [joints, f"frame={frame}", *(f"drive={_drive_name(chain, frame, number)}" for number in drives)]
    titles = {
        chain.joint_title(number).in_language(lang): name for number, name in enumerate(names[: len(chain.joints)])
    }
    title = re.compile("|".join(map(re.escape, sorted(titles, key=len, reverse=True))) or "(?!)")

    def named(text: str) -> str:
        return title.sub(lambda match: titles[match[0]], text)

    driven = check_drives(Mechanism.parse("; ".join(parts)))
    return {
        "counted": report.counted,
        "generic": report.generic,
        "lines": named(report.explain(lang)).splitlines()[1:],
        "immobile": list(report.immobile_joints),
        "fixed": driven.fixed and report.generic > 0,
        "reason": "" if driven.fixed or len(drives) < report.generic else named(driven.message.in_language(lang)),
        "offers": list(_offers(chain, frame, drives, report, ends))[:_MOST_OFFERS],
    }


def _drive_name(chain: Chain, frame: str, number: int) -> str:
    """A driven joint; of three links and more it moves the first one beside the frame."""
    links = chain.joints[number].links
    own = frame if frame in links else links[0]
    other = next(link for link in links if link != own)
    return chain.joint_names()[number] + (f":{own}-{other}" if len(links) > 2 else "")


def _offers(
    chain: Chain, frame: str, drives: list[int], report: MobilityReport, ends: Sequence[str]
) -> Iterator[dict[str, Any]]:
    generic = report.generic
    if generic < 1:
        yield from _removals(chain, frame)
        return
    stuck = [number for number in drives if number in report.immobile_joints]
    if stuck or len(drives) > generic:
        for number in stuck or drives:
            yield {"kind": "undrive", "joint": number, "generic": generic}
        return
    if len(drives) == generic:
        return
    if generic > 1:
        yield from _grounds(chain, frame, generic, ends)
        yield from _bars(chain, frame, generic)
    for number, joint in enumerate(chain.joints):
        movable = number not in drives and number not in report.immobile_joints
        if movable and frame in joint.links and len(joint.links) == 2:
            yield {"kind": "drive", "joint": number, "generic": generic}


def _grounds(chain: Chain, frame: str, generic: int, ends: Sequence[str]) -> Iterator[dict[str, Any]]:
    """Open ends that close the chain where they are held by a joint on the frame."""
    for link in ends:
        if link == frame or any({link, frame} <= set(joint.links) for joint in chain.joints):
            continue
        after = mobility_report(Chain.parse(f"{chain.text()} R({link}-{frame})")).generic
        if 0 < after < generic:
            yield {"kind": "ground", "links": [link], "generic": after}


def _bars(chain: Chain, frame: str, generic: int) -> Iterator[dict[str, Any]]:
    """Two links between which a further one takes a freedom; first links with one joint, and the frame."""
    joined: Mapping[str, int] = {link: sum(link in joint.links for joint in chain.joints) for link in chain.links}
    near = {frozenset((a, b)) for joint in chain.joints for a in joint.links for b in joint.links}
    new = next(str(k) for k in range(1, chain.n + 2) if str(k) not in chain.links)
    order = sorted((link for link in chain.links if link != frame), key=lambda link: joined[link])
    pairs = [(link, frame) for link in order] + [(a, b) for a in order for b in order if a < b]
    offered = 0
    for first, second in pairs:
        if frozenset((first, second)) in near or offered == _MOST_BARS:
            continue
        mended = Chain.parse(f"{chain.text()} R({first}-{new}) R({new}-{second})")
        if (after := mobility_report(mended).generic) == generic - 1:
            offered += 1
            yield {"kind": "bar", "links": [first, second], "generic": after}


def _removals(chain: Chain, frame: str) -> Iterator[dict[str, Any]]:
    """Links without which the rest moves."""
    for link in chain.links:
        if link == frame:
            continue
        rest = [
            Joint(joint.pair, kept)
            for joint in chain.joints
            for kept in [tuple(other for other in joint.links if other != link)]
            if len(kept) > 1
        ]
        try:
            mended = Chain(rest, links=[other for other in chain.links if other != link], space=chain.space)
        except ChainError:
            continue  # what is left falls apart, or is no chain
        if (after := mobility_report(mended).generic) > 0:
            yield {"kind": "remove", "links": [link], "generic": after}
