"""Pictures of designs: the linkage in its first position, the path of its point, and the targets of the task."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, isnan, pi

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, joined, message, translate
from gruebler.design.synthesis.clearances import guided_link
from gruebler.design.synthesis.dead_centres import DeadCentreFamily, FamilyMember, dead_centre_family
from gruebler.design.synthesis.results import FITTED, Design, SynthesisResult
from gruebler.design.synthesis.specification import Clearance
from gruebler.design.synthesis.tasks import DeadCentreTask, DwellTask, FunctionTask, PathTask, PositionTask, Task
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.pictures.canvas import gallery_html
from gruebler.pictures.canvas.arrangement import captioned, pictures_in_one, stacked
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.designs.alt_construction import STRAIGHT, alt_steps
from gruebler.pictures.designs.plots import burmester_plot, function_plot
from gruebler.pictures.linkage.animation import animated_svg
from gruebler.pictures.linkage.bodies import CarriedLine
from gruebler.pictures.linkage.motion_plots import transfer_plot
from gruebler.pictures.linkage.picture import draw_linkage

_COLUMNS = 3
_MOST_MARKS = 12  # targets that get a name; of more every second, third, ... is shown


def _marked(task: Task, design: Design) -> Linkage:
    """The linkage with the targets as points of its frame, by their numbers; as P1, P2 ... if links have numbers.

    Of a function the pins of crank and output are marked at each pair, the output's with a prime.
    """
    linkage = design.linkage
    marks: dict[str, Complexes] = {}
    match task:
        case PositionTask():
            marks[""] = task.origins
        case PathTask():
            marks[""] = task.z
        case FunctionTask():
            marks = _pins_at_pairs(design)
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    letter = "P" if any(link.isdigit() for link in chain.links) else ""
    points = {}
    for prime, places in marks.items():
        for k in range(0, len(places), -(-len(places) // _MOST_MARKS)):
            if not np.isnan(places[k]):  # else its angles alone are given
                points[f"{letter}{k + 1}{prime}"] = (frame, places[k].real, places[k].imag)
    return linkage.with_points(points)


def _pins_at_pairs(design: Design) -> dict[str, Complexes]:
    """Where the pins of the driven link and of the output lie at each pair of a function; those away from the frame."""
    linkage = design.linkage
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    crank = next((link for link in linkage.mechanism.drives[0].between if link != frame), None)
    marks: dict[str, Complexes] = {}
    try:
        motion = move_quietly(linkage, design.drives)
    except LinkageError:
        return marks
    for prime, link in (("", crank), ("′", linkage.outputs[0] if linkage.outputs else None)):
        own = (n for n, joint in enumerate(chain.joints) if link in joint.links and frame not in joint.links)
        number = next(own, None)
        if number is not None and link is not None and motion.complete:
            pin = linkage.elements[number, link]
            marks[prime] = motion.complex_point(LinkPoint(link, pin.x, pin.y))
    return marks


def clearance_outlines(design: Design, clear: Sequence[Clearance]) -> tuple[CarriedLine, ...]:
    """What a body carries and what it keeps clear of, once each, as lines of the design's links."""
    link, frame = guided_link(design), design.linkage.mechanism.frame
    motion = move_quietly(design.linkage, design.drives[:1])
    turn = np.exp(-1j * motion.angle(link)[0])
    shift = motion.complex_point(LinkPoint(link, 0.0, 0.0))[0]
    bodies = dict.fromkeys(tuple(complex(z) for z in (each.outlines[0] - shift) * turn) for each in clear)
    obstacles = dict.fromkeys(tuple(complex(z) for z in each.outlines[1]) for each in clear)
    return (
        *(CarriedLine(frame, line, "given") for line in obstacles),
        *(CarriedLine(link, line, "new") for line in bodies),
    )


def design_figure(task: Task, design: Design, *, lang: str = "en", clear: Sequence[Clearance] = ()) -> Figure:
    """A design in its first position with the path of its point and the targets, and outlines it keeps clear of.

    >>> from gruebler.design.synthesis import synthesise_path
    >>> task = PathTask([(0, 0), (1, 0.6), (2, 0.8), (3, 0.6), (4, 0.1)], fixed_pivots=[(0, -3), (4, -2)])
    >>> "1" in design_figure(task, synthesise_path(task).designs[0]).svg()
    True
    """
    linkage = _marked(task, design)
    several = len(linkage.mechanism.drives) > 1
    drive = design.drive_rows[0] if several else design.drives[0] if design.drives else None
    outlines = clearance_outlines(design, clear) if clear and design.drives else ()
    return draw_linkage(linkage, at=drive, curves=_path_of(linkage), lang=lang, outlines=outlines)


def _path_of(linkage: Linkage) -> list[str]:
    """The point whose path is drawn; with several drives it has no path of its own."""
    return ["P"] if "P" in linkage.points and len(linkage.mechanism.drives) == 1 else []


def designs_figure(
    result: SynthesisResult, *, lang: str = "en", most: int = 6, clear: Sequence[Clearance] = ()
) -> Figure:
    """The best designs side by side with their captions, before them the plots of the task.

    >>> from gruebler.design.synthesis import DeadCentreTask, synthesise
    >>> figure = designs_figure(synthesise(DeadCentreTask(stroke=50, time_ratio=1.2), number=3), most=2)
    >>> figure.width > 500
    True
    """
    shown = (result.designs or result.rejected)[:most]
    plots = [figure for figure, _ in _plots(result, lang)]
    figures = [
        captioned(design_figure(result.task, design, lang=lang, clear=clear), f"{k}. {_caption(design, lang)}")
        for k, design in enumerate(shown, 1)
    ]
    title = translate("Designs", lang)
    page = pictures_in_one(figures, title, min(_COLUMNS, len(figures)))
    return stacked([*plots, page], title)


def _plots(result: SynthesisResult, lang: str) -> list[tuple[Figure, str]]:
    """What is plotted of a task, with its caption: Burmester's curves, or the function with its structural error."""
    best = next(iter(result.designs or result.rejected), None)
    task = result.task
    if isinstance(task, PositionTask) and len(task) == 4 and (best is None or best.form != FITTED):
        try:
            figure = burmester_plot(task, best, lang=lang)
        except SynthesisError:
            return []  # every point of the body can be a pivot, which the notes say
        return [(figure, figure.title)]
    if isinstance(task, DwellTask) and best is not None and best.verdict.turns_fully:
        return [(transfer_plot(best.linkage, "output", lang=lang), translate("Output over the crank angle", lang))]
    if isinstance(task, FunctionTask) and best is not None and best.drives:
        figure = function_plot(task, best, lang=lang)
        return [(figure, figure.title)]
    return []


def designs_page(result: SynthesisResult, *, lang: str = "en", most: int = 24, clear: Sequence[Clearance] = ()) -> str:
    """All accepted designs on one HTML page, moving, so many at most; rejected ones if there are no others.

    Before them stand the plots of the task: Burmester's curves of four positions, the structural error of a function;
    of dead centres the construction, step by step; of a rest the output over a turn.
    """
    shown, heading = (result.designs, message("Accepted")) if result.designs else (result.rejected, message("Rejected"))
    items = []
    for number, design in enumerate(shown[:most]):
        figure = design_figure(result.task, design, lang=lang, clear=clear)
        moving = _moving(result.task, design, lang, clear)
        items.append(Item(figure, f"{number + 1}. {_caption(design, lang)}", moving=moving))
    totals = {"accepted": len(result.designs), "rejected": len(result.rejected)}
    note = translate("Designs: {accepted} accepted, {rejected} rejected.", lang, **totals)
    plots = [Section(caption, (Item(figure, caption),), wide=True) for figure, caption in _plots(result, lang)]
    sections = [*_construction(result.task, lang), *plots, Section(heading.in_language(lang), tuple(items), wide=True)]
    return gallery_html(translate("Designs", lang), sections, lang=lang, note=note)


def _moving(task: Task, design: Design, lang: str, clear: Sequence[Clearance] = ()) -> str:
    """A design that moves through its range as SVG, or through its targets where it keeps clear; empty if stuck."""
    try:
        drives = design.drive_rows or None
        curves, ends = _path_of(design.linkage), None
        if clear and design.drives:
            ends = min(design.drives), max(design.drives)
        outlines = clearance_outlines(design, clear) if ends else ()
        shown = _marked(task, design)
        return animated_svg(shown, curves=curves, lang=lang, drives=drives, between=ends, outlines=outlines)
    except LinkageError:
        return ""


def _construction(task: Task, lang: str) -> list[Section]:
    """Alt's construction of the best linkage with given dead centres."""
    if not isinstance(task, DeadCentreTask):
        return []
    whole = alt_steps(task, _shown_member(dead_centre_family(task)))
    pictures = zip(whole.figures(lang, captions=False), whole.steps, strict=True)
    items = tuple(Item(figure, f"{k}. {step.text.in_language(lang)}") for k, (figure, step) in enumerate(pictures, 1))
    return [Section(translate("Alt's construction, step by step", lang), items, wide=True)]


def _shown_member(family: DeadCentreFamily) -> FamilyMember:
    """The best member; one of moderate size where the dead centres are half a turn apart: a longer one is better."""
    if abs(family.task.angle - pi) > STRAIGHT:
        return family.best
    return min(family.members, key=lambda member: abs(member.linkage.b - 6 * member.linkage.a))


def _caption(design: Design, lang: str) -> str:
    verdict, form = design.verdict, design.form_in_language(lang)
    if verdict.reasons:
        return f"{form}: {joined(verdict.reasons, '; ').in_language(lang)}"
    parts: list[Message | str] = [form]
    if verdict.turns_fully:
        parts.append(message("full turn"))
    if not isnan(verdict.transmission):
        parts.append(
            message("minimum transmission angle through the targets {angle:.1f}°", angle=degrees(verdict.transmission))
        )
    return joined(parts).in_language(lang)
