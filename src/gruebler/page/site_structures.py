"""What the structure view of the static site shows of a chain: every frame and every drive at it, drawn beforehand.

A frame has one picture; its drives are arrows that the page lays over it. docs/theory/explorer.md has the files.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.labels import labels_or_numbers
from gruebler.pictures.canvas.shapes import Point, Shape, bounds, moved_shape
from gruebler.pictures.canvas.svg import svg_element
from gruebler.pictures.structure import paint, place_joints
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.isomorphism import symmetry
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.drives import check_drives
from gruebler.structure.mechanism.inversion import driven_mechanisms, family, inversions
from gruebler.structure.mobility import mobility_report

_MOST_DRIVEN = 60
_LONGEST_LABEL = 3  # letters of a name that stands in a small picture


def structure_pack(
    mechanism: Mechanism,
    langs: Sequence[str],
    *,
    contacts: Mapping[tuple[int, str], str] | None = None,
    called: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Mobility, frames and drives of a chain as plain data, with what is said in these languages.

    The frame and the drives of the mechanism itself are among them, beside one of each kind. ``contacts`` and
    ``called`` are those of `gruebler.page.structures.structure_record`, which says the same of one mechanism.

    >>> pack = structure_pack(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), ["en", "de"])
    >>> len(pack["frames"]), [(text, frame) for text, frame, *_ in pack["driven"]]
    (1, [('R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)', 0)])
    """
    chain, named = mechanism.chain, dict(called or {})
    fixed = {inversion.frame: inversion for inversion in inversions(chain)}
    if mechanism.drives:
        fixed.setdefault(mechanism.frame, Mechanism(chain, mechanism.frame))
    driven = [row.mechanism for row in _listed_drives(chain)]
    own = [mechanism] if mechanism.drives and mechanism not in driven else []
    orbits = symmetry(chain).link_orbits
    report = mobility_report(chain, frame=mechanism.frame)
    strained = sorted({link for part in report.overconstrained for link in part.links})
    rigid = sorted({link for cluster in report.rigid_clusters for link in cluster})
    frames, rows = [], []
    for number, (frame, bare) in enumerate(fixed.items()):
        here = [each for each in (*driven, *own) if each.frame == frame]
        record, arrows = _drawn(bare, here, contacts or {}, named, [*strained, *rigid])
        like = next(orbit[0] for orbit in orbits if frame in orbit)
        names = {"frame": named.get(frame, frame), "like": named.get(like, like), "listed": like == frame}
        frames.append(record | names | {"family": {lang: family(bare, lang) or "" for lang in langs}})
        rows += [
            [each.text(), number, arrow, _facts_of_drives(each.renamed(named), langs), each not in own]
            for each, arrow in zip(here, arrows, strict=True)
        ]
    shown = mobility_report(chain.renamed(named) if named else chain, frame=named.get(mechanism.frame, mechanism.frame))
    return {
        "text": chain.text(),
        "names": {lang: chain.renamed(named).joint_names(Alphabet.of_language(lang)) for lang in langs},
        "counted": report.counted,
        "generic": report.generic,
        "verdict": str(report.verdict),
        "lines": {lang: shown.explain(lang).splitlines() for lang in langs},
        "overconstrained": strained,
        "rigid": rigid,
        "frames": frames,
        "driven": rows,
    }


def _listed_drives(chain: Chain) -> list[Any]:
    if chain.space is not Space.PLANAR:
        return []
    return list(islice(driven_mechanisms(chain, drives=1, at_frame=True), _MOST_DRIVEN))


def _facts_of_drives(mechanism: Mechanism, langs: Sequence[str]) -> dict[str, Any]:
    """Names of the drives, family, and whether they fix the motion, in each language."""
    check = check_drives(mechanism)
    return {
        lang: [
            ", ".join(mechanism.drive_names(Alphabet.of_language(lang))),
            family(mechanism, lang) or "",
            check.explain(lang),
        ]
        for lang in langs
    }


def _drawn(
    bare: Mechanism,
    driven: Sequence[Mechanism],
    contacts: Mapping[tuple[int, str], str],
    called: Mapping[str, str],
    marked: Sequence[str],
) -> tuple[dict[str, Any], list[str]]:
    """A mechanism without drives as a picture with the places of its joints; the arrows of drives over it."""
    chain = bare.chain
    placed = place_joints(bare, contacts)
    bodies = paint(placed)
    places = _places(chain, placed.chain)
    arrows = [
        paint(replace(placed, drives=tuple((places[drive.joint], drive.direction) for drive in each.drives)))
        for each in driven
    ]
    heads = [shapes[len(bodies) :] for shapes in arrows]
    outlines = {link: placed.outlines[link] for link in chain.links}
    labelled = labels_or_numbers(outlines, placed.closed, bodies, called)
    corner, size = bounds([*labelled, *(shape for head in heads for shape in head)], 10.0)
    back = Point(-corner.x, -corner.y)

    def picture(shapes: Sequence[Shape]) -> str:
        moved = tuple(moved_shape(shape, back) for shape in shapes)
        return Figure(moved, width=size.x, height=size.y, title="", description="").svg(styled=False)

    def spots(points: Sequence[Point]) -> list[list[float]]:
        return [[round(point.x - corner.x, 1), round(point.y - corner.y, 1)] for point in points]

    record: dict[str, Any] = {
        "text": bare.text(),
        "picture": picture(labelled),
        "at": spots([placed.joints[places[number]] for number in range(len(chain.joints))]),
        "outlines": {link: spots(outlines[link]) for link in marked},
    }
    if max(map(len, chain.links)) > _LONGEST_LABEL:  # in the size of a card names cannot be read
        record["card"] = picture(bodies)
    return record, ["".join(svg_element(moved_shape(shape, back)) for shape in head) for head in heads]


def _places(chain: Chain, placed: Chain) -> list[int]:
    """The number in a placed chain of each joint; of joints of the same links in turn."""
    waiting = list(enumerate(joint.key for joint in placed.joints))
    places = []
    for joint in chain.joints:
        k = next(k for k, (_, key) in enumerate(waiting) if key == joint.key)
        places.append(waiting.pop(k)[0])
    return places
