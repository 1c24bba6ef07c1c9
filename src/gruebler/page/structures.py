"""What the structure view shows of a chain or mechanism: its picture, its mobility, and what it could be instead."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from gruebler.base.errors import LinkageError
from gruebler.base.text import arity, message
from gruebler.design.realisation.realising import with_drives
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.mobility_report import Freedoms, freedoms
from gruebler.page.model import spaced
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.labels import labels_with_names
from gruebler.pictures.canvas.shapes import Point, Shape, bounds, moved_shape
from gruebler.pictures.canvas.svg import svg_element
from gruebler.pictures.linkage.element_pictures import contact_shapes
from gruebler.pictures.structure import held_outlines, paint, place_joints
from gruebler.pictures.structure.messages import chain_name
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import PAIRS, Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.enumeration import chains, count_chains, fractionation
from gruebler.structure.isomorphism import code, symmetry
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.structure.mechanism.drives import check_drives
from gruebler.structure.mechanism.inversion import driven_mechanisms, family, inversions
from gruebler.structure.mobility import MobilityReport, generic, mobility_report
from gruebler.structure.mobility.report import verdict_word

_MOST_LINKS = 60  # more links are drawn and counted, but their inversions are not listed
_LONGEST_LABEL = 3  # letters of a name beside its link in a small picture
_MOST_NAMES = 8  # long ones in a picture; more are numbers in each language
_LARGER = 1.6  # numbers on cards, as explorer/src/styles/catalog.css has them
_AGAINST = message("{joint}: {link} against {other}")
_APART = {
    "link": message("fractionated: it falls apart when one link is cut"),
    "joint": message("fractionated: it falls apart when one joint is cut"),
}
_SPECIAL = message("These sizes are special: the mobility is {own}, not {generic} as at almost all sizes.")


def mechanism_of_text(text: str) -> Mechanism:
    """The mechanism of a text; of a chain alone the one whose frame is its first link, without drives.

    >>> mechanism_of_text("R(0-1) R(1-2) R(2-0)").frame
    '0'
    """
    return Mechanism.parse(text)


def as_read(text: str) -> str:
    """A text of the library with the names of links as one reads them: with spaces, without quotation marks.

    >>> as_read('R(crank-upper_rod-"lower rod")')
    'R(crank-upper rod-lower rod)'
    """
    return spaced(text).replace('"', "")


def listed_chains(links: int, mobility: int, assortment: Sequence[int] | None = None) -> Iterator[Chain]:
    """The chains among which one chooses, each once, their links from 1: fractionated ones at the end.

    All of them, or those with these numbers of binary, ternary, ... links.

    >>> [chain.text() for chain in listed_chains(4, 1)]
    ['R(1-2) R(2-3) R(3-4) R(4-1)']
    """
    numbers = {str(link): str(link + 1) for link in range(links)}
    named_from_0 = chains(links, mobility, fractionated="all", assortment=assortment)
    return (chain.renamed(numbers) for chain in named_from_0)


def listed_numbers(links: int, mobility: int) -> dict[tuple[int, ...], int]:
    """How many these are of each link assortment.

    >>> listed_numbers(8, 1)
    {(4, 4): 9, (5, 2, 1): 5, (6, 0, 2): 2}
    """
    return count_chains(links, mobility, fractionated="all").by_assortment


def listed_number(links: int, mobility: int) -> int:
    """How many these are together."""
    return sum(listed_numbers(links, mobility).values())


def kinds_in_words(numbers: Mapping[int, int], lang: str) -> str:
    r"""How many links have so many joints; a number stays with its word.

    >>> kinds_in_words({2: 6, 3: 0, 4: 2}, "de")
    '6\xa0binär, 2\xa0quaternär'
    """
    return ", ".join(f"{count}\u00a0{arity(joints, lang)}" for joints, count in numbers.items() if count)


def kinds_as_read(chain: Chain, lang: str) -> str:
    r"""How many joints its links have, and where it falls apart, if it does.

    >>> [kinds_as_read(chain, "en") for chain in listed_chains(7, 2)][-2:]
    ['5\xa0binary, 2\xa0ternary', '6\xa0binary, 1\xa0quaternary; fractionated: it falls apart when one link is cut']
    """
    apart = _APART.get(fractionation(chain))
    kinds = kinds_in_words(chain.link_kinds, lang)
    return f"{kinds}; {apart.in_language(lang)}" if apart else kinds


def drives_as_read(mechanism: Mechanism, lang: str) -> list[str]:
    """The names of the drives; at a joint of several links it is said which of them moves against which.

    >>> lever = Mechanism.parse("R(frame-upper_arm-rod) R(rod-frame); drive=R(frame-upper_arm-rod):frame-rod")
    >>> drives_as_read(lever, "en")
    ['R(frame-upper arm-rod): rod against frame']
    """
    alphabet = Alphabet.of_language(lang)
    joints = mechanism.chain.joint_names(alphabet)

    def named(drive: Drive, name: str) -> str:
        if mechanism.chain.joints[drive.joint].count == 1:
            return name
        other, link = sorted(drive.between, key=lambda each: each != mechanism.frame)
        return _AGAINST.filled(joint=joints[drive.joint], link=link, other=other).in_language(lang)

    return [as_read(named(*each)) for each in zip(mechanism.drives, mechanism.drive_names(alphabet), strict=True)]


def structure_record(
    text: str,
    lang: str,
    *,
    at_frame: bool = True,
    linkage: Linkage | SpatialLinkage | None = None,
    names: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Picture, mobility, inversions, driven mechanisms and other joint types of a text, as plain data.

    The driven mechanisms are those of the chosen frame, with as many drives as fix the motion: at the frame, or
    anywhere. A linkage of the same chain says what its higher pairs are: gears, cams, belts, ... have signs of their
    own in the pictures; and whether its sizes give another mobility than almost all do. What is said about the links
    calls them by ``names``, if there is one for each; the texts keep their own names.

    Raises `GrueblerError` for a text that is no chain; what it says names the place.

    >>> record = structure_record("R(0-1) R(1-2) R(2-3) R(3-0)", "en")
    >>> record["generic"], len(record["inversions"]), len(record["driven"])
    (1, 1, 1)
    """
    mechanism = mechanism_of_text(text)
    chain = mechanism.chain
    sized = linkage if linkage is not None and linkage.mechanism.chain == chain else None
    contacts = contact_shapes(sized) if isinstance(sized, Linkage) else {}
    report = mobility_report(chain, frame=mechanism.frame)
    few = chain.n <= _MOST_LINKS
    called = {link: names[link] for link in chain.links} if names and set(chain.links) <= set(names) else {}
    shown = mechanism.renamed(called)
    shown_report = mobility_report(shown.chain, frame=shown.frame)
    special = None if sized is None else _special(sized, called, shown_report)
    orbit = next(orbit for orbit in symmetry(chain).link_orbits if mechanism.frame in orbit)
    driven = list(listed_drives(chain, [orbit[0]], at_frame)) if few else []
    anywhere = at_frame and not all(at_frame_alone(each) for each in driven)
    if sized is not None and sized.mechanism.frame in orbit and few:
        driven = own_first(driven, sized.mechanism)
    bare_ones = sorted(inversions(chain), key=_frame_number) if few else []
    frames = {bare.frame: bare for bare in bare_ones}
    base = None if sized is None else Mechanism(chain, sized.mechanism.frame)
    cards = {frame: drawn_frame(bare, driven, contacts, called, lang, like=base) for frame, bare in frames.items()}
    like = like_driven(mechanism, {each.code(): each for each in driven})
    moved = mechanism
    if not mechanism.drives and like is not None:  # as the list drives it, at another link with the same role too
        moved = like if like.frame == mechanism.frame else with_drives(mechanism)
    drawn = drawn_frame(Mechanism(chain, mechanism.frame), [moved], contacts, called, lang, like=base)
    read = mechanism if ";" in text else chain
    return {
        "text": read.text(),
        "read": read.text(Alphabet.of_language(lang)),
        "code": code(chain),
        "size": chain.n,
        "name": chain_name(chain, lang),
        "kinds": kinds_as_read(chain, lang),
        "picture": drawn.with_drives(moved),
        "numbered": drawn.numbered,
        "joints": list(_joints(mechanism, shown, drawn, lang)),
        "links": list(_links(chain, drawn, report)),
        "frame": mechanism.frame,
        "chosen": as_read(called.get(orbit[0], orbit[0])),
        "driver": "" if like is None else like.text(),
        "counted": report.counted,
        "generic": report.generic,
        "own": None if special is None else special.mobility,
        "verdict": str(report.verdict),
        "lines": lines_as_read(shown_report, lang),
        "drives": as_read("\n".join(_said_of_drives(moved.renamed(called), special, lang))),
        "inversions": [_choice(bare, cards[frame], lang, called) for frame, bare in frames.items()],
        "anywhere": anywhere,
        "driven": [_choice(each, cards[each.frame], lang, called) for each in driven],
    }


def lines_as_read(report: MobilityReport, lang: str) -> list[str]:
    """What a report tells, the chain and the verdict first.

    >>> lines_as_read(mobility_report(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")), "en")[1]
    'Verdict: constrained. One drive moves every link in one definite way.'
    """
    text, *lines = as_read(report.explain(lang)).splitlines()
    verdict = f": {verdict_word(report.verdict, lang)}. "
    return [text, *sorted(lines, key=lambda line: verdict not in line)]


def _frame_number(bare: Mechanism) -> tuple[bool, int]:
    """By which frames with numbers are ordered; those with names stay in the order of the chain, behind them."""
    return (False, int(bare.frame)) if bare.frame.isdecimal() else (True, 0)


def _special(linkage: Linkage | SpatialLinkage, called: Mapping[str, str], report: MobilityReport) -> Freedoms | None:
    """The mobility of a linkage whose sizes give another one than almost all do; None of others.

    Its reasons call the links as the report of the renamed chain does.
    """
    with suppress(LinkageError):  # what does not close has none
        own = freedoms(linkage)
        if own.mobility != own.generic and own.finite.evidence not in ("blurred", "undecided"):
            reasons = (
                replace(each, links=tuple(called.get(link, link) for link in each.links)) for each in own.reasons
            )
            return replace(own, report=report, reasons=tuple(reasons))
    return None


def _said_of_drives(mechanism: Mechanism, special: Freedoms | None, lang: str) -> Iterator[str]:
    """What sizes of its own make of a mechanism, and whether its drives fix the motion."""
    if special is not None:
        yield _SPECIAL.filled(own=special.mobility, generic=special.generic).in_language(lang)
        yield from special.why(lang)
    if not mechanism.drives:
        return
    drives = check_drives(mechanism)
    if special is None:
        yield drives.explain(lang)
    elif special.instant.stands_with({drive.joint for drive in mechanism.drives}):
        fixed = replace(drives, mobility=special.mobility, remaining=0, free_links=(), redundant_drives=())
        yield fixed.explain(lang)


def listed_drives(chain: Chain, frames: Iterable[str], at_frame: bool = True, most: int = 60) -> Iterator[Mechanism]:
    """The mechanisms of these frames with as many drives as fix the motion, at most so many of each.

    Drives at the frame, if asked for; anywhere where those of a frame fix nothing, as a hexagon has three freedoms and
    two joints at each link. Of a chain with one freedom, or none, or in space, every joint is listed as one drive.

    >>> pentagon = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)").chain
    >>> [each.drive_names() for each in listed_drives(pentagon, ["0"])]
    [('R(0-1)', 'R(4-0)')]
    """
    number = generic(chain).mobility if chain.space is Space.PLANAR else 1

    def those(frame: str, at_frame: bool) -> list[Mechanism]:
        choices = driven_mechanisms(chain, drives=max(1, number), at_frame=at_frame)
        own = [each.mechanism for each in choices if each.mechanism.frame == frame]
        own.sort(key=lambda each: -sum(frame in drive.between for drive in each.drives))
        return list(islice((each for each in own if number < 2 or check_drives(each).fixed), most))

    for frame in frames:
        yield from those(frame, at_frame) or (those(frame, False) if number > 1 else ())


def at_frame_alone(mechanism: Mechanism) -> bool:
    """Whether all its drives are at the frame.

    >>> at_frame_alone(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(1-2)"))
    False
    """
    return all(mechanism.frame in drive.between for drive in mechanism.drives)


def own_first(listed: Sequence[Mechanism], own: Mechanism) -> list[Mechanism]:
    """Mechanisms of a list, before them the one that is like a machine's own, be it of the list or not.

    >>> own = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(1-2)")
    >>> [each.drive_names() for each in own_first(list(listed_drives(own.chain, ["0"])), own)]
    [('R(1-2)',), ('R(0-1)',)]
    """
    if not own.drives:
        return list(listed)
    known = own.code()
    first = next((each for each in listed if each.code() == known), None) or _standing_for(own)
    return [first, *(each for each in listed if each != first)]


def _standing_for(mechanism: Mechanism) -> Mechanism:
    """The one of all like it whose frame is the first of its orbit, as the lists have it."""
    chain, known = mechanism.chain, mechanism.code()
    (frame,) = (orbit[0] for orbit in symmetry(chain).link_orbits if mechanism.frame in orbit)
    if frame == mechanism.frame:
        return mechanism
    choices = driven_mechanisms(chain, drives=len(mechanism.drives), at_frame=False)
    of_frame = (each.mechanism for each in choices if each.mechanism.frame == frame)
    return next(each for each in of_frame if each.code() == known)


def like_driven(mechanism: Mechanism, listed: Mapping[str, Mechanism]) -> Mechanism | None:
    """The mechanism of a list, by its codes, that is like this one with its drives, or with those that it is given.

    None if there is none.

    >>> chain = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0)").chain
    >>> found = like_driven(Mechanism(chain, "2"), {each.code(): each for each in listed_drives(chain, ["0"])})
    >>> found.text()
    'R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)'
    """
    if not mechanism.drives and listed and mechanism.chain.space is Space.PLANAR:
        mechanism = with_drives(mechanism)
    return listed.get(mechanism.code()) if mechanism.drives else None


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnFrame:
    """A mechanism without drives as a picture, and drives as arrows to lay over it."""

    picture: str
    """With the names of the links, or numbers."""
    numbered: dict[str, str]
    """The names by their numbers, where these stand in the picture."""
    card: str
    """Without names that are too long for a small picture, and as much smaller."""
    shift: list[float]
    """How far the card lies from the picture."""
    at: list[list[float]]
    """The places of the joints of the chain, in its order."""
    outlines: dict[str, list[list[float]]]
    """The corners of each link, of a closed one the first again at the end."""
    arrows: dict[Mechanism, str]
    """The drives of each mechanism, as parts of an SVG."""

    def with_drives(self, mechanism: Mechanism) -> str:
        """The picture with the drives of a mechanism."""
        return self.picture.replace("</svg>", f"{self.arrows.get(mechanism, '')}</svg>")

    def card_with_drives(self, mechanism: Mechanism) -> str:
        """The card with them."""
        x, y = self.shift
        arrow = f'<g transform="translate({x},{y})">{self.arrows[mechanism]}</g>' if mechanism in self.arrows else ""
        return self.card.replace("</svg>", f"{arrow}</svg>")


def drawn_frame(
    bare: Mechanism,
    driven: Iterable[Mechanism],
    contacts: Mapping[tuple[int, str], str],
    called: Mapping[str, str],
    lang: str = "en",
    *,
    like: Mechanism | None = None,
) -> DrawnFrame:
    """The picture of a mechanism without drives, with those of other drives at the same frame.

    So all of them stand the same way up: a layout that takes account of a drive may be the mirrored one. All frames
    of a chain stand as the chain itself does, or as the mechanism ``like``.

    >>> bare = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> drawn = drawn_frame(bare, listed_drives(bare.chain, ["0"]), {}, {})
    >>> len(drawn.at), len(drawn.arrows), drawn.picture == drawn.card
    (4, 1, True)
    """
    chain = bare.chain
    placed = place_joints(bare, contacts, like=like or chain)
    bodies = paint(placed, lang)
    places = _places(chain, placed.chain)
    heads = {
        each: paint(
            replace(placed, drives=tuple((places[drive.joint], drive.direction) for drive in each.drives)), lang
        )[len(bodies) :]
        for each in driven
        if each.frame == bare.frame
    }
    held = held_outlines(placed)
    outlines = {link: held[link] for link in chain.links}
    around = {link: (*corners, *corners[: placed.closed[link]]) for link, corners in outlines.items()}
    names = {link: as_read(called.get(link, link)) for link in chain.links}
    over = [shape for head in heads.values() for shape in head]
    texts, numbered = labels_with_names(
        outlines, placed.closed, bodies, names, larger=_LARGER, heads=over, most=_MOST_NAMES
    )
    labelled = [*bodies, *texts]
    corner, picture = _picture(labelled, heads.values())
    if not numbered:
        brief = {link: outline for link, outline in outlines.items() if len(names[link]) <= _LONGEST_LABEL}
        numbers = labels_with_names(brief, placed.closed, [*bodies, *over], names, larger=_LARGER)
        most = len(brief) >= chain.n - 1  # of a drawing the frame alone has a name
        labelled = [*bodies, *(numbers[0] if most else ())]
    small, card = _picture(labelled, heads.values())
    back = Point(-corner.x, -corner.y)

    def spots(points: Iterable[Point]) -> list[list[float]]:
        return [[round(point.x - corner.x, 1), round(point.y - corner.y, 1)] for point in points]

    return DrawnFrame(
        picture=picture,
        numbered={number: name for name, number in numbered.items()},
        card=card,
        shift=[round(corner.x - small.x, 1), round(corner.y - small.y, 1)],
        at=spots(placed.joints[places[number]] for number in range(len(chain.joints))),
        outlines={link: spots(outline) for link, outline in around.items()},
        arrows={each: "".join(svg_element(moved_shape(shape, back)) for shape in head) for each, head in heads.items()},
    )


def _picture(shapes: Sequence[Shape], heads: Iterable[Sequence[Shape]]) -> tuple[Point, str]:
    """The corner of a picture with room for arrows, and the picture without them."""
    corner, size = bounds([*shapes, *(shape for head in heads for shape in head)], 10.0)
    moved = tuple(moved_shape(shape, Point(-corner.x, -corner.y)) for shape in shapes)
    return corner, Figure(moved, width=size.x, height=size.y, title="", description="").svg(styled=False)


def _places(chain: Chain, placed: Chain) -> list[int]:
    """The number in a placed chain of each joint; of joints of the same links in turn."""
    waiting = list(enumerate(joint.key for joint in placed.joints))
    places = []
    for joint in chain.joints:
        k = next(k for k, (_, key) in enumerate(waiting) if key == joint.key)
        places.append(waiting.pop(k)[0])
    return places


def drives_in_numbers(
    mechanism: Mechanism, numbered: Mapping[str, str], lang: str, called: Mapping[str, str]
) -> list[str]:
    """The names of the drives with the numbers that a picture has instead of names of links; none if it has names.

    >>> mechanism = Mechanism.parse("R(arm-rod) R(rod-lever) R(lever-arm); drive=R(arm-rod)")
    >>> drives_in_numbers(mechanism, {"1": "arm", "2": "the rod", "3": "lever"}, "en", {"rod": "the_rod"})
    ['R(1-2)']
    """
    numbers = {name: number for number, name in numbered.items()}
    read = {link: as_read(called.get(link, link)) for link in mechanism.chain.links}
    brief = mechanism.renamed({link: numbers.get(name, name) for link, name in read.items()}) if numbers else mechanism
    return drives_as_read(brief, lang) if numbers else []


def _choice(mechanism: Mechanism, drawn: DrawnFrame, lang: str, called: Mapping[str, str]) -> dict[str, Any]:
    shown = mechanism.renamed(called)
    return {
        "text": mechanism.text(),
        "frame": as_read(shown.frame),
        "drives": drives_as_read(shown, lang),
        "brief": drives_in_numbers(mechanism, drawn.numbered, lang, called),
        "family": family(mechanism, lang) or "",
        "picture": drawn.card_with_drives(mechanism),
    }


def _joints(mechanism: Mechanism, shown: Mechanism, drawn: DrawnFrame, lang: str) -> Iterator[dict[str, Any]]:
    """Each joint with its place in the picture and the types that it may have instead."""
    names = shown.chain.joint_names(Alphabet.of_language(lang))
    for number, (name, at) in enumerate(zip(names, drawn.at, strict=True)):
        yield {"name": as_read(name), "at": at, "types": list(_types(mechanism, number, lang))}


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
            "symbol": pair.symbols.get(alphabet, ""),
            "name": pair.plain_name(lang),
            "text": text,
            "chosen": pair is joint.pair,
        }


def _drivable(chain: Chain, drives: list[int]) -> bool:
    """Whether each of these joints has one freedom, so that its drive needs no direction."""
    return bool(drives) and all(len(chain.joints[k].pair.freedoms[chain.space]) == 1 for k in drives)


def _links(chain: Chain, drawn: DrawnFrame, report: MobilityReport) -> Iterator[dict[str, Any]]:
    """Each link with its outline, and whether it is overconstrained or part of a rigid cluster."""
    strained = {link for part in report.overconstrained for link in part.links}
    rigid = {link for cluster in report.rigid_clusters for link in cluster}
    for link in chain.links:
        yield {
            "name": link,
            "outline": drawn.outlines[link],
            "overconstrained": link in strained,
            "rigid": link in rigid,
        }
