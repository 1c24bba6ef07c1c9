"""What the structure view shows of a chain or mechanism: its picture, its mobility, and what it could be instead."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.figure import figure_of
from gruebler.pictures.canvas.labels import labels_or_numbers
from gruebler.pictures.canvas.shapes import Point, bounds
from gruebler.pictures.linkage.element_pictures import contact_shapes
from gruebler.pictures.structure import PlacedChain, draw_structure, paint, place_joints
from gruebler.pictures.structure.messages import chain_name
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import PAIRS, Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.isomorphism import symmetry
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.drives import check_drives
from gruebler.structure.mechanism.inversion import driven_mechanisms, family, inversions
from gruebler.structure.mobility import MobilityReport, mobility_report

_MOST_LINKS = 60  # more links are drawn and counted, but their inversions are not listed
_MOST_DRIVEN = 60
_LONGEST_LABEL = 3  # letters of a name beside its link in a small picture


def mechanism_of_text(text: str) -> Mechanism:
    """The mechanism of a text; of a chain alone the one whose frame is its first link, without drives.

    >>> mechanism_of_text("R(0-1) R(1-2) R(2-0)").frame
    '0'
    """
    return Mechanism.parse(text)


def structure_record(
    text: str,
    lang: str,
    *,
    at_frame: bool = True,
    linkage: Linkage | None = None,
    names: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Picture, mobility, inversions, driven mechanisms and other joint types of a text, as plain data.

    The driven mechanisms are those with a drive at the frame, or all with one drive. A linkage of the same chain says
    what its higher pairs are: gears, cams, belts, ... have signs of their own in the pictures. What is said about the
    links calls them by ``names``, if there is one for each; the texts keep their own names.

    Raises `GrueblerError` for a text that is no chain; what it says names the place.

    >>> record = structure_record("R(0-1) R(1-2) R(2-3) R(3-0)", "en")
    >>> record["generic"], len(record["inversions"]), len(record["driven"])
    (1, 1, 1)
    """
    mechanism = mechanism_of_text(text)
    chain = mechanism.chain
    contacts = contact_shapes(linkage) if linkage is not None and linkage.mechanism.chain == chain else {}
    placed = place_joints(mechanism, contacts)
    report = mobility_report(chain, frame=mechanism.frame)
    few = chain.n <= _MOST_LINKS
    called = {link: names[link] for link in chain.links} if names and set(chain.links) <= set(names) else {}
    shown = mechanism.renamed(called)
    shapes = labels_or_numbers(
        {link: placed.outlines[link] for link in chain.links}, placed.closed, paint(placed, lang), called
    )
    corner, _ = bounds(shapes, 10.0)
    return {
        "text": mechanism.text() if ";" in text else chain.text(),
        "name": chain_name(chain, lang),
        "picture": figure_of(shapes, chain.text(Alphabet.of_language(lang)), "").svg(styled=False),
        "joints": list(_joints(mechanism, shown, placed, corner, lang)),
        "links": list(_links(chain, placed, corner, report)),
        "frame": mechanism.frame,
        "chosen": next(orbit[0] for orbit in symmetry(shown.chain).link_orbits if shown.frame in orbit)
        if ";" in text
        else "",
        "counted": report.counted,
        "generic": report.generic,
        "verdict": str(report.verdict),
        "lines": mobility_report(shown.chain, frame=shown.frame).explain(lang).splitlines(),
        "drives": check_drives(shown).explain(lang) if mechanism.drives else "",
        "inversions": [_choice(inversion, lang, contacts, called) for inversion in inversions(chain)] if few else [],
        "driven": [_choice(driven.mechanism, lang, contacts, called) for driven in _driven(chain, at_frame)]
        if few and chain.space is Space.PLANAR
        else [],
    }


def _driven(chain: Chain, at_frame: bool) -> list[Any]:
    """The mechanisms with one drive, as far as a page can show them."""
    rows = []
    for driven in driven_mechanisms(chain, drives=1, at_frame=at_frame):
        rows.append(driven)
        if len(rows) == _MOST_DRIVEN:
            break
    return rows


def _choice(
    mechanism: Mechanism, lang: str, contacts: Mapping[tuple[int, str], str], called: Mapping[str, str]
) -> dict[str, Any]:
    shown = mechanism.renamed(called)
    few = max(map(len, mechanism.chain.links)) <= _LONGEST_LABEL
    return {
        "text": mechanism.text(),
        "frame": shown.frame,
        "drives": list(shown.drive_names(Alphabet.of_language(lang))),
        "family": family(mechanism, lang) or "",
        "picture": draw_structure(mechanism, labels=few, lang=lang, contacts=contacts).svg(styled=False),
    }


def _joints(
    mechanism: Mechanism, shown: Mechanism, placed: PlacedChain, corner: Point, lang: str
) -> Iterator[dict[str, Any]]:
    """Each joint with its place in the picture and the types that it may have instead."""
    chain = mechanism.chain
    names = shown.chain.joint_names(Alphabet.of_language(lang))
    waiting = [(joint.key, at) for joint, at in zip(placed.chain.joints, placed.joints, strict=True)]
    for number, joint in enumerate(chain.joints):
        k = next(k for k, (key, _) in enumerate(waiting) if key == joint.key)
        at = waiting.pop(k)[1]
        yield {
            "name": names[number],
            "at": [at.x - corner.x, at.y - corner.y],
            "types": list(_types(mechanism, number, lang)),
        }


def _types(mechanism: Mechanism, number: int, lang: str) -> Iterator[dict[str, Any]]:
    chain = mechanism.chain
    joint = chain.joints[number]
    alphabet = Alphabet.of_language(lang)
    for pair in PAIRS:
        if chain.space not in pair.freedoms or (len(joint.links) > 2 and not pair.is_group):
            continue
        if chain.space is not Space.PLANAR and pair.freedoms[chain.space] is None:
            continue
        joints = [Joint(pair, joint.links) if k == number else first for k, first in enumerate(chain.joints)]
        second = Chain(joints, links=chain.links, space=chain.space)
        drives = [drive.joint for drive in mechanism.drives]
        text = Mechanism(second, mechanism.frame, drives).text() if _drivable(second, drives) else second.text()
        yield {
            "symbol": pair.symbols.get(alphabet, pair.name),
            "name": pair.plain_name(lang),
            "text": text,
            "chosen": pair is joint.pair,
        }


def _drivable(chain: Chain, drives: list[int]) -> bool:
    """Whether each of these joints has one freedom, so that its drive needs no direction."""
    return bool(drives) and all(len(chain.joints[k].pair.freedoms[chain.space]) == 1 for k in drives)


def _links(chain: Chain, placed: PlacedChain, corner: Point, report: MobilityReport) -> Iterator[dict[str, Any]]:
    """Each link with the middle of its outline, and whether it is overconstrained or part of a rigid cluster."""
    strained = {link for part in report.overconstrained for link in part.links}
    rigid = {link for cluster in report.rigid_clusters for link in cluster}
    for link in chain.links:
        outline = placed.outlines[link] or (corner,)
        x, y = sum(p.x for p in outline) / len(outline), sum(p.y for p in outline) / len(outline)
        yield {
            "name": link,
            "at": [x - corner.x, y - corner.y],
            "outline": [[p.x - corner.x, p.y - corner.y] for p in outline],
            "overconstrained": link in strained,
            "rigid": link in rigid,
        }
