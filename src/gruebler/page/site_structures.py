"""What the structure view of the static site shows of a chain: every frame and every drive at it, drawn beforehand.

A frame has one picture; its drives are arrows that the page lays over it. docs/theory/explorer.md has the files.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gruebler.page.structures import (
    as_read,
    drawn_frame,
    drives_as_read,
    drives_in_numbers,
    kinds_as_read,
    like_driven,
    lines_as_read,
    listed_drives,
    own_first,
)
from gruebler.pictures.structure.messages import chain_name
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.isomorphism import code, symmetry
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.drives import check_drives
from gruebler.structure.mechanism.inversion import family, inversions
from gruebler.structure.mobility import mobility_report

_MOST_DRIVEN = 12  # of a frame


def structure_pack(
    mechanism: Mechanism,
    langs: Sequence[str],
    *,
    contacts: Mapping[tuple[int, str], str] | None = None,
    called: Mapping[str, str] | None = None,
    base: Mechanism | None = None,
) -> dict[str, Any]:
    """Mobility, frames and drives of a chain as plain data, with what is said in these languages.

    The frame and the drives of the mechanism itself are among them, these first, beside one of each kind. ``contacts``
    and ``called`` are those of `gruebler.page.structures.structure_record`, which says the same of one mechanism,
    ``base`` is the ``like`` of `gruebler.page.structures.drawn_frame`.

    >>> pack = structure_pack(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), ["en", "de"])
    >>> len(pack["frames"]), [(text, frame) for text, frame, *_ in pack["driven"]]
    (1, [('R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)', 0)])
    """
    chain, named = mechanism.chain, dict(called or {})
    fixed = {inversion.frame: inversion for inversion in inversions(chain)}
    if mechanism.drives:
        fixed.setdefault(mechanism.frame, Mechanism(chain, mechanism.frame))
    listed = own_first(list(listed_drives(chain, fixed, most=_MOST_DRIVEN)), mechanism)
    codes = {each.code(): each for each in listed}
    own = [mechanism] if mechanism.drives and mechanism not in listed else []
    orbits = symmetry(chain).link_orbits
    report = mobility_report(chain, frame=mechanism.frame)
    strained = sorted({link for part in report.overconstrained for link in part.links})
    rigid = sorted({link for cluster in report.rigid_clusters for link in cluster})

    def driver(each: Mechanism) -> str:
        like = like_driven(each, codes)
        return "" if like is None else like.text()

    frames, rows = [], []
    for number, (frame, bare) in enumerate(fixed.items()):
        drawn = drawn_frame(bare, [*listed, *own], contacts or {}, named, like=base)
        like = next(orbit[0] for orbit in orbits if frame in orbit)
        record: dict[str, Any] = {
            "text": bare.text(),
            "picture": drawn.picture,
            "numbered": drawn.numbered,
            "at": drawn.at,
            "outlines": {link: drawn.outlines[link] for link in [*strained, *rigid]},
            "frame": as_read(named.get(frame, frame)),
            "like": as_read(named.get(like, like)),
            "listed": like == frame,
            "driver": driver(bare),
            "family": {lang: family(bare, lang) or "" for lang in langs},
        }
        frames.append(record if drawn.card == drawn.picture else record | {"card": drawn.card, "shift": drawn.shift})
        rows += [
            [
                each.text(),
                number,
                arrow,
                _facts_of_drives(each, named, drawn.numbered, langs),
                driver(each) if each in own else each.text(),
            ]
            for each, arrow in drawn.arrows.items()
        ]
    shown = mobility_report(chain.renamed(named) if named else chain, frame=named.get(mechanism.frame, mechanism.frame))
    return {
        "text": chain.text(),
        "code": code(chain),
        "size": chain.n,
        "name": {lang: chain_name(chain, lang) for lang in langs},
        "kinds": {lang: kinds_as_read(chain, lang) for lang in langs},
        "names": {
            lang: [as_read(name) for name in chain.renamed(named).joint_names(Alphabet.of_language(lang))]
            for lang in langs
        },
        "counted": report.counted,
        "generic": report.generic,
        "verdict": str(report.verdict),
        "lines": {lang: lines_as_read(shown, lang) for lang in langs},
        "overconstrained": strained,
        "rigid": rigid,
        "frames": frames,
        "driven": rows,
    }


def _facts_of_drives(
    mechanism: Mechanism, called: Mapping[str, str], numbered: Mapping[str, str], langs: Sequence[str]
) -> dict[str, Any]:
    """Names of the drives, family, whether they fix the motion, and the names in numbers, in each language."""
    shown = mechanism.renamed(called)
    check = check_drives(shown)
    return {
        lang: [
            drives_as_read(shown, lang),
            family(shown, lang) or "",
            as_read(check.explain(lang)),
            drives_in_numbers(mechanism, numbered, lang, called),
        ]
        for lang in langs
    }
