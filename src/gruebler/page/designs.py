"""What the synthesis view asks for and is answered: targets of four kinds, designs with the frames of their motions."""

from __future__ import annotations

import cmath
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import degrees, hypot, isfinite, radians
from typing import Any

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.text import LANGUAGES, Message, joined_by_and, message
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    Design,
    FunctionTask,
    PathTask,
    PositionTask,
    SynthesisResult,
    Task,
    synthesise,
)
from gruebler.design.synthesis.demands import FULL_TURN, LEAST_ANGLE
from gruebler.design.synthesis.start_families import MOST_PAIRS
from gruebler.design.synthesis.tasks import gives_lengths
from gruebler.files import linkage_to_json
from gruebler.mechanics.analysis.measuring import measures
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.page.design_words import SLENDER, is_curve, notes, words
from gruebler.page.model import bearing_turns, four_bar_type, link_names
from gruebler.page.search_progress import SearchProgress
from gruebler.pictures.linkage.bodies import CarriedLine, guide_corners
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, drive_rows, posed_linkage
from gruebler.pictures.linkage.slides import pins_of, slides

_MOST_DESIGNS = 24
_COLUMNS = 3  # of a position: x, y, angle
_NAMES = {"RR-RR": "four-bar", "RR-PR": "slider-crank", "RR-RP": "inverted-slider-crank"}
"""Forms that have a name of their own."""
_FOUR = 4
_ROUNDED = 1e-4  # of the size: an offset that comes of the digits of places only
_RING = 8.0  # pixels: the radius of the mark of a point
_ARM = 34.0  # pixels: the arrow of a position
_BLOCK = 12.0  # pixels: half the block of a slide, and what its guide is longer than its way
_CIRCLE = np.exp(2j * np.pi * np.arange(17) / 16)
_LIKE = 0.1
"""Of the size: designs of one form whose pivots and lengths differ by less are variants of one another."""
_FAR = 10
"""So many times the extent of places: longer links are left out where no limit is given and shorter ones do."""
_LONGEST = 100.0
"""Of designs of which only the ratios count: so long is the longest distance of joints on a link, in mm."""
_ROUNDING = 1e-9
"""Of the size: a target that is missed by less is met."""
_CURVES = 12
"""So many designs for a whole curve: a choice between near ones and small ones."""
_LOW = message("Not shown: {count} with a transmission angle below {angle:g}° in other positions.")
_LONG = message("Not shown: {count} with a link longer than {length:g} mm.")
_OWN_LIMIT = message("Another limit can be typed.")
_LESS = (0.9, 0.7, 0.4, 0.0)  # of a transmission angle that no design has
_NEAREST = 12  # designs that are shown of these
_NEARLY = message("No linkage was found that meets all demands; these meet all but {demands}.")
_LOOKING = message("Looking for four-bars")
_JUDGING = message("Judging the linkages found")
_NEARING = message("Looking for what nearly meets the demands")
_DRAWING = message("Drawing the designs")
_LOOKED, _NEARED = 60, 90  # percent of a search after which these are over
_FRAMES = 144  # of a motion, there and back if it does not turn fully


def task_of(
    kind: str,
    rows: Sequence[Sequence[float]],
    *,
    closed: bool = False,
    pivots: Sequence[Sequence[float]] = (),
    order: Sequence[int | None] = (),
) -> Task:
    """The task of the rows of the page: lengths as they are, angles in degrees, those of a function from free starts.

    >>> task_of("dead-centres", [[60, 1.2]]).swing
    1.047...
    >>> task_of("points", [[0, 0], [1, 1], [2, 0]], order=[2, 1, None]).order
    (2, 1, None)
    """
    columns = _COLUMNS if kind == "positions" else _COLUMNS - 1
    if any(len(row) != columns for row in rows) or any(len(pivot) != _COLUMNS - 1 for pivot in pivots):
        raise SynthesisError("{key}: expected {count} numbers in each row", key=kind, count=columns)
    if kind == "positions":
        places = tuple((x, y, radians(angle)) for x, y, angle in rows)
        return PositionTask(places, fixed_pivots=tuple((x, y) for x, y in pivots), order=tuple(order))
    if kind == "function":
        angles = [tuple(radians(row[k]) for row in rows) for k in (0, 1)]
        return FunctionTask(angles[0], outputs=angles[1], start_input=False, start_output=False)
    if kind == "dead-centres":
        swing, ratio = rows[0]
        return DeadCentreTask(swing=radians(swing), time_ratio=ratio)
    return PathTask(tuple((x, y) for x, y in rows), closed=closed, order=tuple(order))


def design_records(
    task: Task,
    crank: bool,
    transmission: float,
    lang: str,
    progress: Callable[[str], object],
    reach: float | None = None,
    longest: float | None = None,
) -> dict[str, Any]:
    """The accepted designs for a task, the best of them with pictures; transmission angles in degrees.

    Fixed pivots lie within a reach of the rectangle about places, if one is given, and no link is longer than what is
    given, by default than the diagonal of that space, nor much longer than another: the curve that comes nearest to a
    drawn one often belongs to a linkage many times as large. With neither given links ten times as long as the
    diagonal of that rectangle are left out if there are shorter ones.

    Of cranks that turn fully the angle over the whole turn is what is asked for, too, where a design has it; of
    positions it is what is sought. A design that is much like a better one is marked as its variant. Where none meets
    all demands, those that meet all but the angle, or a drive that turns fully, or both, are given as the nearest.

    >>> found = design_records(task_of("dead-centres", [[60, 1.2]]), True, 30.0, "en", print)
    Looking for four-bars: 0 %
    ...
    >>> found["total"] > 0, len(found["items"][0]["members"]), len(found["items"][0]["frames"][0])
    (True, 3, 4)
    """
    stages = SearchProgress(progress, lang)
    stages.stage(_LOOKING, _LOOKED)
    sort = ("range-transmission",) if crank and isinstance(task, PositionTask) else ()
    space = _region(task, reach)

    totals: list[int] = []

    def counted(done: int, total: int) -> None:
        totals.append(total)
        # what was found is counted anew
        stages.called(_LOOKING if done < total == totals[0] else _JUDGING)
        stages.count(done, total)

    in_places = isinstance(task, PathTask | PositionTask)
    demands = Demands(crank=crank, transmission=radians(transmission))
    if space is not None:
        demands = replace(demands, region=space, size_ratio=SLENDER)
    result = synthesise(
        task,
        demands=demands,
        sort=sort,
        number=_CURVES if is_curve(task) else None,
        progress=counted if in_places else None,
    )
    remarks: list[Message] = []
    hidden: list[Message] = []
    first, nearest = result, None
    if not result.designs:
        counts = stages if in_places else None
        nearest = _nearest_designs(task, demands, stages=counts, finite=bool(result.count.theorem))
    if nearest is not None:
        result, text = nearest
        remarks.append(text)
    designs = list(result.designs)
    if crank and nearest is None:  # those that have the angle in all positions, if there are any
        whole = [each for each in designs if degrees(each.transmission_over_range) >= transmission]
        if whole and whole != designs:
            hidden.append(_LOW.filled(angle=transmission, count=len(designs) - len(whole)))
            designs = whole
    near = space or _region(task, 0.0)
    if near is not None:
        limited = space is not None or longest is not None
        longest = (
            longest if longest is not None else (1 if space else _FAR) * hypot(near[2] - near[0], near[3] - near[1])
        )
        fitting, too_long = _short_enough(designs, longest)
        too_long += [_OWN_LIMIT] * (bool(too_long) and not limited)
        if fitting or limited:  # giants where there is nothing else
            # where the nearest ones do not fit either it is told why none does what was asked for
            designs, remarks, hidden, result = (
                (fitting, remarks, hidden + too_long, result) if fitting or nearest is None else ([], [], [], first)
            )
    relative = not gives_lengths(task)
    if relative:
        designs = [replace(each, linkage=each.linkage.scaled(_LONGEST / each.linkage.size)) for each in designs]
    items = []
    shown = designs[:_MOST_DESIGNS]
    for number, design in enumerate(shown):
        stages.stage(_DRAWING, 100, start=_NEARED + (100 - _NEARED) * number / len(shown))
        items.append(_record(design, task, lang))
    _mark_variants(items)
    texts = {
        "note": [*remarks, *notes(result, items, len(designs), others=bool(hidden)), *hidden],
        "words": words(result, items, relative, longest if space else None),
    }
    said = {key: "\n".join(text.in_language(lang) for text in some) for key, some in texts.items()}
    return {"total": len(designs), "relative": relative, "nearest": nearest is not None, "items": items} | said


def _nearest_designs(
    task: Task, demands: Demands, *, stages: SearchProgress | None = None, finite: bool = False
) -> tuple[SynthesisResult, Message] | None:
    """The designs that come nearest to a transmission angle that none has, or whose drive does not turn fully, or both.

    They meet all other demands, if any do; and what is said of them. Of a finite number all are found at once.

    >>> found, text = _nearest_designs(task_of("dead-centres", [[60, 1.2]]), Demands(transmission=radians(60)))
    >>> print(text, round(degrees(found.designs[0].verdict.transmission), 1))
    No linkage was found that meets all demands; these meet all but a transmission angle of 60°. 40.3
    """
    if is_curve(task):
        return None
    angle = LEAST_ANGLE.filled(angle=round(degrees(demands.transmission), 9))
    tries = [
        (turning, lower, part)
        for turning, lower in ((False, True), (True, False), (True, True))
        if (demands.crank or not turning) and (demands.transmission or not lower)
        for part in (((0.0,) if finite else _LESS) if lower else (1.0,))
    ]
    for k, (turning, lower, part) in enumerate(tries):
        if stages is not None:
            start, end = (_LOOKED + (_NEARED - _LOOKED) * place / len(tries) for place in (k, k + 1))
            stages.stage(_NEARING, end, start=start)
        crank, missed = demands.crank and not turning, [*[FULL_TURN] * turning, *[angle] * lower]
        less = replace(demands, crank=crank, transmission=part * demands.transmission)
        progress = None if stages is None else stages.count
        result = synthesise(task, demands=less, sort=("transmission",), progress=progress)
        if result.designs:
            nearest = replace(result, designs=result.designs[:_NEAREST])
            return nearest, _NEARLY.filled(demands=joined_by_and(missed))
    return None


def _region(task: Task, reach: float | None) -> tuple[float, float, float, float] | None:
    """The rectangle about places and given pivots, so much wider on every side.

    >>> _region(task_of("points", [[0, 0], [1, 5], [2, 0]]), 10)
    (-10.0, -10.0, 12.0, 15.0)
    """
    if reach is None or not isinstance(task, PathTask | PositionTask):
        return None
    places = task.z if isinstance(task, PathTask) else task.origins
    x, y = np.array([*((z.real, z.imag) for z in places), *task.fixed_pivots]).T
    return float(x.min()) - reach, float(y.min()) - reach, float(x.max()) + reach, float(y.max()) + reach


def _record(design: Design, task: Task, lang: str) -> dict[str, Any]:
    linkage, verdict = design.linkage, design.verdict
    posed = posed_linkage(linkage)
    angle = degrees(verdict.transmission)
    size = design.targets.size if design.targets else 1.0
    marks = _target_marks(task, linkage.mechanism.frame, posed.scale)
    return {
        "document": linkage_to_json(linkage),
        "picture": draw_linkage(linkage, curves=list(linkage.points), lang=lang, outlines=marks).svg(styled=False),
        "form": capitalised(replace(design, form=_NAMES.get(design.form, design.form)).form_in_language(lang)),
        "kind": kind.name(lang).split(" (")[0] if (kind := four_bar_type(linkage)) else None,
        "transmission": angle if isfinite(angle) else None,
        "range": degrees(over_range) if isfinite(over_range := design.transmission_over_range) else None,
        "shift": shift * size if isfinite(shift := design.relative_sensitivity) else None,
        "error": _size_of(verdict.error, size),
        "size": _longest(posed),
        **_frames(linkage, posed, _played(design, task, posed)),
        **_met_angles(design, task, posed),
        **_carried_arrow(design, task, posed),
        "backward": posed.repeats and _meets_backward(design, task),
    }


def _longest(posed: PosedLinkage) -> float:
    """The longest link: as far as its joints, its points and what slides along it lie apart; of the frame the pins.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> _longest(posed_linkage(FourBar(25, 70, 40, 70).linkage({"K": (200.0, 0.0)})))
    200.0
    """
    frame = posed.linkage.mechanism.frame
    places = {link: pins_of(posed.lower, link) for link in posed.linkage.mechanism.chain.links}
    more = [(point.link, complex(point.x, point.y)) for point in posed.linkage.points.values()]
    more += [(slide.guide, end) for slide in slides(posed) for end in (slide.low, slide.high)]
    for link, place in more:
        if link != frame and link in places:
            places[link].append(place)
    return max(abs(here - there) for own in places.values() for here in own for there in own)


def _short_enough(designs: list[Design], longest: float) -> tuple[list[Design], list[Message]]:
    """The designs none of whose links is longer, and how many are left out, if any.

    >>> from gruebler.design.synthesis import DesignVerdict
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> made = FourBar(25, 70, 40, 70).linkage({"K": (200.0, 0.0)})
    >>> design = Design(linkage=made, verdict=DesignVerdict(), form="four-bar")
    >>> [str(text) for length in (201.0, 199.0) for text in _short_enough([design], length)[1]]
    ['Not shown: 1 with a link longer than 199 mm.']
    """
    fitting = [each for each in designs if _longest(posed_linkage(each.linkage)) <= longest]
    more = len(designs) - len(fitting)
    return fitting, [_LONG.filled(length=float(f"{longest:.3g}"), count=more)] * bool(more)


def _size_of(error: float, size: float) -> float | None:
    """A deviation in the unit of the task, radians of a function; none of what is met but for rounding.

    >>> _size_of(0.01, 120.0), _size_of(1e-12, 120.0), _size_of(float("nan"), 1.0)
    (1.2, 0.0, None)
    """
    if not isfinite(error):
        return None
    return error * size if abs(error) >= _ROUNDING else 0.0


def capitalised(text: str) -> str:
    """As a title begins.

    >>> capitalised("four-bar")
    'Four-bar'
    """
    return text[:1].upper() + text[1:]


def _mark_variants(items: list[dict[str, Any]]) -> None:
    """Mark each design that is much like one before it of the same form."""
    kept: list[tuple[str, np.ndarray]] = []
    for item in items:
        measures = np.array(item.pop("measures")) / item["size"]
        like = [other for form, other in kept if form == item["form"] and other.shape == measures.shape]
        item["variant"] = any(np.abs(measures - other).max() < _LIKE for other in like)
        if not item["variant"]:
            kept.append((item["form"], measures))


def _target_marks(task: Task, frame: str, scale: float) -> list[CarriedLine]:
    """Where a design shall pass, on its frame: a disc at each place, the arrow of a position."""
    rows: list[tuple[complex, float | None]] = []
    if isinstance(task, PathTask):
        rows = [(complex(*point), None) for point in task.points if point is not None]
    elif isinstance(task, PositionTask):
        rows = [(complex(x, y), turn) for x, y, turn in task.positions]
    marks = []
    for at, turn in rows:
        if turn is not None:
            marks.append(CarriedLine(frame, (at, at + _ARM / scale * np.exp(1j * turn)), "target"))
        marks.append(CarriedLine(frame, tuple(at + _RING / scale * _CIRCLE), "target-head"))
    return marks


def _played(design: Design, task: Task, posed: PosedLinkage) -> Motion:
    """The rows of the motion, evenly in time; where a crank turns fully with the pairs of its task in the middle."""
    cycle = posed.cycle
    if cycle is None:
        return posed.path
    rows = drive_rows(cycle, count=_FRAMES)
    if posed.repeats and isinstance(task, FunctionTask):
        rows += (min(design.drives) + max(design.drives) - rows[0] - rows[-1]) / 2
    return cycle.at(rows, 0)


def _seen(linkage: Linkage, motion: Motion, more: Sequence[LinkPoint] = ()) -> Reals:
    """The places of joints, of points, then of others, in as many digits as are seen; (rows, places, 2)."""
    names = (*linkage.mechanism.chain.joint_names(), *linkage.points)
    digits = 5 - int(np.floor(np.log10(linkage.size)))
    others = [motion.complex_point(place).view(float).reshape(-1, 2) for place in more]
    places: Reals = np.stack([*(motion.point(name) for name in names), *others], axis=1)
    return places.round(digits)


def _slide_ends(posed: PosedLinkage) -> dict[int, list[LinkPoint]]:
    """By sliding joint the ends of its block, then those of its guide."""
    half, mechanism = _BLOCK / posed.scale, posed.linkage.mechanism
    by_joint = {}
    for slide in slides(posed):
        along = cmath.rect(half, posed.lower.elements[slide.joint, slide.block].direction)
        ends = slide.low - half * slide.along, slide.high + half * slide.along
        block = [LinkPoint(slide.block, z.real, z.imag) for z in (slide.middle - along, slide.middle + along)]
        guide = [LinkPoint(slide.guide, z.real, z.imag) for z in ends]
        if slide.block in mechanism.chain.links:  # not a pin in a slot
            by_joint[slide.joint] = [*block, *guide]
    return by_joint


def _there_and_back(rows: Reals, posed: PosedLinkage) -> list[Any]:
    both: list[Any] = (rows if posed.repeats else np.concatenate([rows, rows[-2:0:-1]])).tolist()
    return both


def _carried_arrow(design: Design, task: Task, posed: PosedLinkage) -> dict[str, Any]:
    """The angle of the arrow that the coupler carries through its positions, in degrees, of each row."""
    if not isinstance(task, PositionTask) or posed.cycle is None:
        return {}
    (point,) = design.linkage.points.values()
    first = posed.cycle.at(np.array(design.drives[:1]), 0).angle(point.link)
    turned = _played(design, task, posed).angle(point.link) - first + task.positions[0][2]
    return {"turns": _there_and_back(np.degrees(turned).round(2), posed)}


def _meets_backward(design: Design, task: Task) -> bool:
    """Whether places are met in their order while the drive turns clockwise."""
    return isinstance(task, PathTask | PositionTask) and bool(design.drives[0] > design.drives[-1])


def _met_angles(design: Design, task: Task, posed: PosedLinkage) -> dict[str, Any]:
    """How angles are met: crank and output in degrees, as the pairs count them, of each row; or both dead centres.

    Of more pairs than can be met exactly also by how much each is missed, as stems: cranks in radians, what is wanted
    less what is reached in degrees, from zero and back, and the ends of both.
    """
    linkage, cycle = design.linkage, posed.cycle
    if cycle is not None and isinstance(task, DeadCentreTask):
        ends = np.array([centre.drive for centre in measures(linkage).dead_centres])
        return {"ends": _seen(linkage, cycle.at(ends, 0)).tolist()}
    if cycle is None or not isinstance(task, FunctionTask):
        return {}
    played = _played(design, task, posed).drives[:, 0]
    path = cycle.at(np.append(played, design.drives), 0)
    mechanism = linkage.mechanism
    at_frame = {link for joint in mechanism.chain.joints if mechanism.frame in joint.links for link in joint.links}
    (output,) = at_frame - set(mechanism.drives[0].between)
    turned = np.stack([path.drives[:, 0], path.angle(output)], axis=1)
    pairs = turned[len(played) :]
    met: dict[str, Any] = {}
    begin = pairs[0].copy()
    if len(task) > MOST_PAIRS and design.targets is not None:
        missed = np.angle(design.targets.values[:, 1] * np.exp(-1j * pairs[:, 1]))
        begin[1] += missed[0]
        met = {"stems": _stems(task.inputs, np.degrees(missed).round(6).tolist())}
    angles = np.degrees(turned[: len(played)] - begin + (task.inputs[0], task.outputs[0]))
    far = np.abs(turned[len(played) - 1] - turned[0])
    round_ = np.array([posed.repeats, posed.repeats and far[1] > np.pi])
    pairs[:, round_] %= 2 * np.pi  # as the page counts what goes round
    curve, reached = _there_and_back(np.round(angles, 2), posed), np.degrees(pairs).round(6).tolist()
    return {"angles": curve, "pairs": reached} | met


def _stems(places: Sequence[float], values: Sequence[float]) -> list[Any]:
    """A line from zero to each value and back, with room at both sides: its places, its values, and the ends.

    >>> _stems([0.0, 1.0], [2.0, 3.0])[1]
    (0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0)
    """
    tips = sorted(zip(places, values, strict=True))
    first, last = tips[0][0], tips[-1][0]
    room = 0.04 * (last - first)
    line = [(first - room, 0), *((x, part * y) for x, y in tips for part in (0, 1, 0)), (last + room, 0)]
    return [*zip(*line, strict=True), tips]


def _frames(linkage: Linkage, posed: PosedLinkage, path: Motion) -> dict[str, Any]:
    """Places of joints, points and ends of slides, evenly in time; which of them links and guides have; lengths."""
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    points, sliding = linkage.points, _slide_ends(posed)
    moving = [link for link in chain.links if link != frame]
    corners = [LinkPoint(link, z.real, z.imag) for link, z in guide_corners(posed).items() if link in chain.links]
    rows = _seen(linkage, path, [*(end for ends in sliding.values() for end in ends), *corners])
    carried = [*(joint.links for joint in chain.joints), *((point.link,) for point in points.values())]
    members = [[k for k, links in enumerate(carried) if link in links and k not in sliding] for link in moving]
    joints = [[k for k, joint in enumerate(chain.joints) if link in joint.links] for link in chain.links]
    apart = [(k, m) for own in joints for k in own for m in own if k < m]
    measured = [*rows[0, joints[chain.links.index(frame)]].ravel(), *(_apart(rows[0], k, m) for k, m in apart)]
    pins = {
        link: [k for k in own if chain.joints[k].pair.is_turning] for link, own in zip(chain.links, joints, strict=True)
    }
    bars = [link for link in sorted(pins, key=frame.__ne__) if len(pins[link]) == 2]  # the frame comes first
    called = {lang: link_names(linkage, "", lang) for lang in LANGUAGES}
    shown = np.abs(rows[:, : len(carried)] - _seen(linkage, posed.pose)).sum(axis=(1, 2)).argmin()
    blocks = [[k, k + 1] for k in range(len(carried), rows.shape[1] - len(corners), 4)]
    for joint, block in zip(sliding, blocks, strict=True):
        rows[:, joint] = rows[:, block].mean(axis=1)
    rails = [[k + 2 for k in block] for block in blocks]
    lengths = [_apart(rows[0], *pins[link]) for link in bars]
    if len(blocks) == 1:
        (joint,) = sliding
        ends = [rows[0, pair] @ (1, 1j) for pair in (rails[0], [pins[link][0] for link in chain.joints[joint].links])]
        along, across = (start - end for start, end in ends)
        offset = abs((across / along).imag * along)
        lengths.append(float(offset) if offset > _ROUNDED * linkage.size else 0.0)
    for number, corner in enumerate(corners, rows.shape[1] - len(corners)):
        members[moving.index(corner.link)].append(number)
    one_loop = chain.n == len(chain.joints) == _FOUR
    return {
        "frames": _there_and_back(rows, posed),
        "first": int(shown),
        "members": [*members, *blocks],
        "rails": rails,
        "joints": len(chain.joints),
        "points": len(points),
        "drive": linkage.mechanism.drives[0].joint,
        "bearings": bearing_turns(posed),
        "measures": measured,
        "lengths": lengths if one_loop else [],
        "point": _point_of(linkage, rows[0], pins, rails) if one_loop else None,
        "names": {lang: [_parted(names[link]) for link in bars] for lang, names in called.items()},
    }


def _parted(name: str) -> str:
    r"""A name of a link with a soft hyphen where a long German one may be parted.

    >>> _parted("Antriebsschwinge").split("\u00ad")
    ['Antriebs', 'schwinge']
    """
    return re.sub(r"(?<=\w)schwinge$", "\u00adschwinge", name)


def _point_of(
    linkage: Linkage, places: Reals, pins: Mapping[str, list[int]], rails: Sequence[list[int]]
) -> list[float] | None:
    """How far the only point lies along its link, from the pin that is nearer to the drive, and to the left of that.

    Of a link with one pin along its guide, in the sense in which that lies.
    """
    if len(linkage.points) != 1:
        return None
    (point,) = linkage.points.values()
    mechanism = linkage.mechanism
    own, z = pins[point.link], places @ (1, 1j)
    if not own or mechanism.frame == point.link:
        return None
    drive = mechanism.drives[0].between
    first, *others = sorted(own, key=lambda k: not set(mechanism.chain.joints[k].links) & set(drive))
    if others:
        along = z[others[0]] - z[first]
    else:
        ((low, high),) = rails
        along = z[high] - z[low]
        along *= np.sign(np.real(np.conj(along) * (z[low] + z[high] - 2 * z[first])))
    at = (z[len(mechanism.chain.joints)] - z[first]) * abs(along) / along
    return [float(at.real), float(at.imag)]


def _apart(places: Reals, first: int, second: int) -> float:
    return float(np.hypot(*(places[first] - places[second])))
