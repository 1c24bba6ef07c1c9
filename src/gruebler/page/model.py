"""A linkage as the page takes it: its document, the flattened solving plan, and a pose to start from.

The page executes the plan by the same kernels (core/src/motion, compiled to WebAssembly), so that dragging needs no
round trip. docs/theory/explorer.md says what may be changed there without a new plan.
"""

from __future__ import annotations

import re
from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from math import atan2, degrees, radians
from typing import Any

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError
from gruebler.base.text import LANGUAGES, Text, error_in_language, message, number, translate
from gruebler.files import linkage_to_json
from gruebler.files.load_reading import loads_of_document
from gruebler.files.load_writing import loads_to_json
from gruebler.mechanics.analysis.messages import undefined_transmission_message
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import NoTransmissionAngleError, force_path, in_line
from gruebler.mechanics.fourbar import LinkageType, grashof
from gruebler.mechanics.kinematics.branches import labelled_groups
from gruebler.mechanics.kinematics.plan import Dyad, Plan
from gruebler.mechanics.linkages import Linkage
from gruebler.page.known_loads import loads_at_hand, springs_of
from gruebler.pictures.canvas.shapes import CircleShape, Polylines
from gruebler.pictures.linkage.bodies import bearing_sides, ground_hatching
from gruebler.pictures.linkage.element_pictures import round_parts
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, posed_linkage
from gruebler.pictures.linkage.slides import outline_extent, slides
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Space
from gruebler.teaching.catalog import entries

_NUMBERED = re.compile(
    r"(frame|crank|driven crank|driving rocker|driven rocker|coupler|rocker|slider|block|wheel)(\d*)"
)
"""Names of the links of four-bars, and by roles."""
_ROCKERS = {"crank": message("driving rocker").text, "rocker": message("driven rocker").text}
_ENDS = {
    "double_crank": {"rocker": message("driven crank").text},
    "rocker_crank": {"crank": message("driving rocker").text, "rocker": message("driven crank").text},
    "triple_rocker": _ROCKERS,
    "grashof_double_rocker": _ROCKERS,
}
"""What crank and rocker of a four-bar are called by its type, where they are something else."""
_COUNTED = re.compile(r"(?<=[^\W\d_]{3})(\d+)\b")

_FOUR_BAR = ("crank", "coupler", "rocker", "frame")  # its links, in the order of their lengths
_SAME = 1e-12  # sizes: elements of the plan are copies of the linkage's, but for rounding of turned ones


def with_document(model: dict[str, Any], linkage: Linkage, document: Mapping[str, Any]) -> dict[str, Any]:
    """A model that keeps what the document of its linkage has besides: ``loads``, and ``page`` for the page alone.

    Of ``pairs`` in ``page``, rows of drive and output in degrees, the plot of the output has marks.
    """
    kept = {"page": document["page"]} if document.get("page") else {}
    pairs = (document.get("page") or {}).get("pairs")
    if pairs and model["outputs"]:
        model = model | {"outputs": [_marked(model["outputs"][0], pairs)]}
    if document.get("loads"):
        loads, speed = loads_of_document(document, linkage)
        kept["loads"] = loads_to_json(loads, linkage, speed)
        model = model | {"springs": springs_of(linkage, loads)}
    return model | {"document": model["document"] | kept}


def _marked(output: dict[str, Any], pairs: Any) -> dict[str, Any]:
    """An output with marks in its plot, drive in radians and output in degrees, and where they lie in its note."""
    try:
        rows = [(float(drive), float(value)) for drive, value in pairs]
    except (TypeError, ValueError) as error:
        raise LinkageError("{key}: expected {count} numbers in each row", key="pairs", count=2) from error

    def told(lang: str) -> str:
        said = ", ".join(" → ".join(f"{number(value, lang, '.4g')}°" for value in row) for row in rows)
        return translate("Ringed are the pairs asked for, drive → output: {pairs}.", lang, pairs=said)

    marks = [(radians(drive), value) for drive, value in rows]
    return output | {"marks": marks, "note": {lang: told(lang) for lang in LANGUAGES} | output["note"]}


def model_of(
    linkage: Linkage,
    *,
    name: str | Text = "",
    source: str = "",
    between: tuple[float, float] | None = None,
    stops: Sequence[tuple[float, float] | None] = (),
) -> dict[str, Any]:
    """Everything that the page needs to show a linkage and to move it by itself, as plain data for `json.dumps`.

    Args:
        linkage: a planar linkage whose drives fix its motion.
        name: what the page calls it.
        source: the word by which the command line finds it, such as ``lambda``; empty if there is none.
        between: drive values between which it is shown; all if None.
        stops: the least and the largest value of each drive, where they are known.

    Raises `LinkageError` if it cannot be moved or assembled. Cost: that of its drive cycle, 10 to 500 ms.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> made = model_of(FourBar(25, 70, 40, 70).linkage())
    >>> made["joints"][1]["name"], made["program"]["operations"][1][0], len(made["start"]["signs"])
    ('R(crank-coupler)', 2, 1)
    """
    posed = posed_linkage(linkage, between=between)
    plan, lower, pose = posed.pose.plan, posed.lower, posed.pose
    mechanism, chain = linkage.mechanism, linkage.mechanism.chain
    names = chain.joint_names()
    keys = sorted(linkage.elements)
    drives = np.concatenate([pose.drives[0], plan.held])
    sliding = _slide_records(posed)
    return {
        "version": 1,
        "name": name.en if isinstance(name, Text) else name,
        "names": {lang: name.in_language(lang) for lang in LANGUAGES} if isinstance(name, Text) else {},
        "source": source,
        "document": linkage_to_json(linkage),
        "links": list(lower.mechanism.chain.links),
        "linkNames": {lang: list(link_names(linkage, source, lang).values()) for lang in LANGUAGES},
        "pointNames": {lang: names_of_points(linkage, source, lang) for lang in LANGUAGES},
        "own": len(chain.links),
        "frame": lower.mechanism.chain.index(mechanism.frame),
        "unit": linkage.unit,
        "joints": [
            {"name": text, "pair": _pair_record(joint.pair), "links": [chain.index(link) for link in joint.links]}
            | sliding.get(frozenset(joint.links), {})
            for text, joint in zip(names, chain.joints, strict=True)
        ],
        "elements": [
            {"joint": number, "link": chain.index(link), "kind": e.form, "at": [e.x, e.y], "angle": e.direction}
            for number, link in keys
            for e in [linkage.elements[number, link]]
        ],
        "points": [
            {"name": text, "link": chain.index(point.link), "at": [point.x, point.y]}
            for text, point in linkage.points.items()
        ],
        "drives": [
            {"name": text, "turning": drive.turning, "joint": drive.joint}
            for text, drive in zip(mechanism.drive_names(), mechanism.drives, strict=True)
        ],
        "program": program_record(plan),
        "sources": [_source(plan, linkage, keys, number) for number in range(len(plan.keys))],
        "reference": _reference_records(plan),
        "groups": [
            {
                "dyad": isinstance(part, Dyad),
                "number": part.number,
                "form": plan.decomposition.groups[part.group].form(),
                "links": list(plan.decomposition.groups[part.group].links),
                "modes": part in labelled_groups(plan),
            }
            for part in plan.parts
        ],
        "shortest": [[number, value] for number, value in plan.shortest],
        "released": list(plan.released),
        "start": {
            "drives": drives.tolist(),
            "signs": np.where(pose.roots[0] < 0, -1, 1).tolist(),
            "unknowns": pose.unknowns[0].tolist(),
        },
        "span": _span(posed, between) | {"stops": list(stops)},
        "outputs": _output(linkage, plan),
        "shapes": list(_shapes(posed)),
        "bearings": bearing_turns(posed),
        "springs": springs_of(linkage, loads_at_hand({}, source, linkage)[0]),
    }


def spaced(name: str) -> str:
    """A name as it is read: in documents it has no spaces. The page does the same (explorer/src/language.ts).

    >>> [spaced(name) for name in ("upper_jaw", "coupler1", "R(frame-rocker2)", "P1")]
    ['upper jaw', 'coupler 1', 'R(frame-rocker 2)', 'P1']
    """
    return _COUNTED.sub(r" \1", name.replace("_", " "))


def link_names(linkage: Linkage, source: str, lang: str) -> dict[str, str]:
    """The names of the links in a language, of machines of the catalog and of four-bars; else their own.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> link_names(FourBar(25, 70, 40, 70).linkage(), "", "de")["rocker"]
    'Schwinge'
    >>> link_names(FourBar(86, 100, 90.6, 55.8).linkage(), "", "de")["rocker"]  # a double crank
    'Abtriebskurbel'
    >>> link_names(FourBar(70.56, 62.98, 55.91, 80).linkage(), "", "en")["crank"]  # nothing turns fully
    'driving rocker'
    """
    links = linkage.mechanism.chain.links
    record = entries().get(source)
    if record is not None and record.chain().links == links:
        return dict(zip(links, record.in_language(lang).chain().links, strict=True))
    kind = four_bar_type(linkage)
    ends = _ENDS.get(kind.key, {}) if kind else {}
    parts = {link: _NUMBERED.fullmatch(ends.get(link, link)) for link in links}
    return {link: translate(part[1], lang) + part[2] if part else link for link, part in parts.items()}


def four_bar_type(linkage: Linkage) -> LinkageType | None:
    """What a four-bar, by the names of its links, is called by Grashof's condition.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> four_bar_type(FourBar(25, 70, 40, 70).linkage()).key
    'crank_rocker'
    """
    chain, elements = linkage.mechanism.chain, linkage.elements
    ends = {link: [complex(e.x, e.y) for (_, own), e in elements.items() if own == link] for link in _FOUR_BAR}
    if set(chain.links) != set(_FOUR_BAR) or not all(joint.pair.is_turning for joint in chain.joints):
        return None
    if not all(len(own) == 2 for own in ends.values()):
        return None
    return grashof(*(abs(own[0] - own[1]) for own in ends.values())).type


def names_of_points(linkage: Linkage, source: str, lang: str) -> dict[str, str]:
    """The names of the points in a language, where they have others: words, of machines of the catalog.

    >>> from gruebler.teaching.catalog import entry
    >>> names_of_points(entry("filmclaw").linkage(), "filmclaw", "de")
    {'tip': 'Spitze'}
    """
    record = entries().get(source)
    if record is None or record.dimensions is None:
        return {}
    said = record.in_language(lang).dimensions
    pairs = zip(record.dimensions.points, said.points if said else (), strict=True)
    return {name: called for name, called in pairs if name in linkage.points and called != name}


def _pair_record(pair: Pair) -> dict[str, Any]:
    """What the page asks of a pair: what it is, and the freedoms that it leaves in the plane."""
    turn, along, across = (freedom in pair.freedoms[Space.PLANAR] for freedom in Space.PLANAR.directions)
    return {
        "turning": pair.is_turning,
        "sliding": pair.is_sliding,
        "contours": pair.has_contours,
        "free": {"turn": turn, "along": along, "across": across},
    }


def program_record(plan: Plan) -> dict[str, Any]:
    """The program of a plan as lists of numbers, complex ones as real and imaginary part in turn."""
    p = plan.program
    return {
        "operations": p.operations.tolist(),
        "links": p.links.tolist(),
        "points": _parts(p.points),
        "lines": _parts(p.lines),
        "conditions": p.conditions.tolist(),
        "kinds": p.kinds.tolist(),
        "sides": p.sides.tolist(),
        "owners": p.owners.tolist(),
        "bodies": p.bodies.tolist(),
        "roots": p.roots.tolist(),
        "most": p.most.tolist(),
        "size": p.size,
        "values": p.values.ravel().tolist(),
        "windings": p.windings.tolist(),
        "pieces": p.pieces.tolist(),
        "linkCount": len(plan.lower.mechanism.chain.links),
        "drives": len(plan.lower.mechanism.drives),
        "dyads": len(plan.dyads),
    }


def _parts(values: Complexes) -> list[float]:
    numbers: list[float] = np.stack([values.real, values.imag], axis=1).ravel().tolist()
    return numbers


def _source(plan: Plan, linkage: Linkage, keys: Sequence[tuple[int, str]], number: int) -> int:
    """The element of the linkage whose point is that of an element of the plan; -1 if it stays as it is."""
    lower, (joint, link) = plan.lower, plan.keys[number]
    if link not in linkage.mechanism.chain.links:
        return -1  # a block of a pin in a slot has its origin there
    element = lower.elements[joint, link]
    near = set(lower.mechanism.chain.joints[joint].links)
    near |= {other for block in near for other in _held_by(plan, block)}
    best, most = -1, -1
    for k, key in enumerate(keys):
        e = linkage.elements[key]
        if key[1] != link or e.is_round != element.is_round:
            continue
        if abs(complex(e.x - element.x, e.y - element.y)) > _SAME * lower.size:
            continue
        alike = 2 * len(near & set(linkage.mechanism.chain.joints[key[0]].links)) + (type(e) is type(element))
        if alike > most:
            best, most = k, alike
    return best


def _held_by(plan: Plan, block: str) -> set[str]:
    """The links that a block joins; of no other link any."""
    if block in plan.linkage.mechanism.chain.links:
        return set()
    joints = plan.lower.mechanism.chain.joints
    return {link for joint in joints if block in joint.links for link in joint.links}


def _reference_records(plan: Plan) -> dict[str, Any]:
    """What says where signs, unknowns and drive values of a pose come from."""
    index = plan.lower.mechanism.chain.index
    return {
        "drives": [[index(a), index(b), *_drive_elements(plan, k)] for k, (a, b) in enumerate(_references(plan))],
        "bodies": [[index(root), index(part.base)] for part in plan.higher_groups for root in part.roots],
        "windings": [[condition.kind, *condition.sides] for condition in plan.windings],
    }


def _references(plan: Plan) -> list[tuple[str, str]]:
    return [plan.lower.reference(k) for k in range(len(plan.lower.mechanism.drives))]


def _drive_elements(plan: Plan, k: int) -> tuple[int, int]:
    drive, (first, other) = plan.lower.mechanism.drives[k], plan.lower.reference(k)
    return plan.keys.index((drive.joint, first)), plan.keys.index((drive.joint, other))


def _span(posed: PosedLinkage, between: tuple[float, float] | None) -> dict[str, Any]:
    """The range that is shown, and after how many turns everything repeats; 0 if the drive does not go round."""
    if posed.cycle is None or not posed.pose.plan.linkage.mechanism.drives:
        return {"turns": 0, "between": None}
    return {
        "turns": posed.cycle.span.turns,
        "between": None if between is None else [float(posed.path.drives[k, 0]) for k in (0, -1)],
    }


def _output(linkage: Linkage, plan: Plan) -> list[dict[str, Any]]:
    """The output that is looked at, with the legs that drive it; or why it has no transmission angle.

    Of several drives the page moves one and holds the others; which leg pushes hangs on the one.
    """
    if not linkage.mechanism.drives:
        return []
    output = find_output(linkage)
    index = plan.lower.mechanism.chain.index
    record: dict[str, Any] = {"link": index(output.link), "joint": output.joint, "legs": [], "note": {}}
    if len(linkage.mechanism.drives) > 1:
        return [record]
    record["inLine"] = in_line(plan, output)
    try:
        path = force_path(plan, output)
    except NoTransmissionAngleError as error:
        notes = {lang: (said := error_in_language(error, lang))[0].upper() + said[1:] + "." for lang in LANGUAGES}
        return [record | {"note": notes}]

    def place(element: tuple[str, complex, complex]) -> list[float]:
        link, point, line = element
        return [index(link), point.real, point.imag, line.real, line.imag, _element_at(plan, element)]

    record["legs"] = [
        {
            "links": [index(link) for link in leg.links],
            "from": place(leg.slide or leg.outer),
            "across": leg.slide is not None,
            "cam": leg.cam,
            "pin": place(leg.pin),
            "pushed": index(leg.pushed),
            "guide": None if leg.guide is None else {"slides": leg.guide[0].is_sliding, "at": place(leg.guide[1])},
        }
        for leg in path.legs
    ]
    if path.undefined:
        undefined = undefined_transmission_message(path.undefined)
        record["note"] = {lang: undefined.in_language(lang) for lang in LANGUAGES}
    return [record]


def _element_at(plan: Plan, element: tuple[str, complex, complex]) -> int:
    """The number of an element of the plan, so that the page follows when it is dragged."""
    link, point, line = element
    for k, (joint, owner) in enumerate(plan.keys):
        e = plan.lower.elements[joint, owner]
        if owner == link and complex(e.x, e.y) == point and abs(rect(1, e.direction) - line) < _SAME:
            return k
    return -1


def _shapes(posed: PosedLinkage) -> Iterator[dict[str, Any]]:
    """Wheels, cams and the like as outlines on their links, in the linkage's unit."""
    index, scale = posed.lower.mechanism.chain.index, posed.scale
    for part in round_parts(posed):
        for shape in part.shapes:
            if isinstance(shape, CircleShape):
                circle = [_short(v / scale) for v in (shape.at.x, -shape.at.y, shape.radius)]
                yield {"link": index(part.link), "style": shape.style, "circle": circle}
            elif isinstance(shape, Polylines):
                yield _outline(posed, part.link, shape) | (
                    {} if part.between is None else {"between": [c for z in part.between for c in (z.real, z.imag)]}
                )
    for ticks in ground_hatching(posed):
        yield _outline(posed, posed.lower.mechanism.frame, ticks)


def _outline(posed: PosedLinkage, link: str, shape: Polylines) -> dict[str, Any]:
    lines = [[_short(c / posed.scale) for p in line for c in (p.x, -p.y)] for line in shape.parts]
    number = posed.lower.mechanism.chain.index(link)
    return {"link": number, "style": shape.style, "lines": lines, "closed": shape.closed}


def _slide_records(posed: PosedLinkage) -> dict[frozenset[str], dict[str, Any]]:
    """By the links of a sliding joint the guide, and half the length and half the width of a block with an outline."""
    index, scale = posed.lower.mechanism.chain.index, posed.scale
    records: dict[frozenset[str], dict[str, Any]] = {}
    for slide in slides(posed):
        extent = outline_extent(posed, slide)
        outlined = {"sliding": [_short(half / scale) for half in extent]} if extent else {}
        records[frozenset((slide.guide, slide.block))] = {"guide": index(slide.guide)} | outlined
    return records


def bearing_turns(posed: PosedLinkage) -> list[int]:
    """How far the bearings of joints are turned, clockwise from standing below, in degrees; 0 of joints without one.

    A rocker that hangs down has its bearing above:

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> [bearing_turns(posed_linkage(FourBar(25, 70, 40, 70).linkage(), branch=branch)) for branch in ("+", "-")]
    [[0, 0, 0, 0], [0, 0, 0, 180]]
    """
    elements, frame = posed.linkage.elements, posed.linkage.mechanism.frame
    sides = bearing_sides(posed)
    pins = (elements.get((number, frame)) for number in range(len(posed.linkage.mechanism.chain.joints)))
    turned = (None if pin is None else sides.get(complex(pin.x, pin.y)) for pin in pins)
    return [0 if side is None else round(degrees(atan2(-side.x, side.y))) % 360 for side in turned]


def _short(value: float) -> float:
    """Seven digits: outlines are for the eye."""
    return float(f"{value:.7g}")
