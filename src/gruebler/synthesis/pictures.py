"""Pictures of designs: the linkage in its first position, the path of its point, and the targets of the task."""

from __future__ import annotations

from math import degrees, isnan, pi

from gruebler.drawing.canvas import gallery_html
from gruebler.drawing.canvas.figure import Figure
from gruebler.drawing.canvas.gallery import Item, Section
from gruebler.drawing.linkage.animation import animated_svg
from gruebler.drawing.linkage.picture import draw_linkage
from gruebler.errors import LinkageError
from gruebler.linkages import Linkage
from gruebler.synthesis.alt_construction import STRAIGHT, alt_steps
from gruebler.synthesis.dead_centres import DeadCentreFamily, FamilyMember, dead_centre_family
from gruebler.synthesis.results import Design, SynthesisResult
from gruebler.synthesis.tasks import DeadCentreTask, PathTask, PositionTask, Task
from gruebler.text import Message, joined, message, translate

__all__ = ["design_figure", "designs_page"]

_MOST_MARKS = 12  # targets that get a name; of more every second, third, ... is shown


def _marked(task: Task, linkage: Linkage) -> Linkage:
    """The linkage with the targets as points of its frame, by their numbers; as P1, P2 ... if links have numbers."""
    match task:
        case PositionTask():
            places = task.origins
        case PathTask():
            places = task.z
        case _:
            return linkage
    step = -(-len(places) // _MOST_MARKS)
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    letter = "P" if any(link.isdigit() for link in chain.links) else ""
    names = [f"{letter}{k + 1}" for k in range(len(places))]
    return linkage.with_points({names[k]: (frame, places[k].real, places[k].imag) for k in range(0, len(places), step)})


def design_figure(task: Task, design: Design, *, lang: str = "en") -> Figure:
    """A design in its first position with the path of its point and the targets.

    >>> from gruebler.synthesis import synthesise_path
    >>> task = PathTask([(0, 0), (1, 0.6), (2, 0.8), (3, 0.6), (4, 0.1)], fixed_pivots=[(0, -3), (4, -2)])
    >>> "1" in design_figure(task, synthesise_path(task).designs[0]).svg()
    True
    """
    linkage = _marked(task, design.linkage)
    curves = ["P"] if "P" in linkage.points else []
    drive = design.drives[0] if design.drives else None
    return draw_linkage(linkage, drive, curves=curves, lang=lang)


def designs_page(result: SynthesisResult, *, lang: str = "en", most: int = 24) -> str:
    """All accepted designs on one HTML page, moving, so many at most; rejected ones if there are no others.

    Of dead centres the construction stands before them, step by step.
    """
    shown, heading = (result.designs, message("Accepted")) if result.designs else (result.rejected, message("Rejected"))
    items = []
    for number, design in enumerate(shown[:most]):
        figure = design_figure(result.task, design, lang=lang)
        items.append(Item(figure, f"{number + 1} {_caption(design, lang)}", moving=_moving(result.task, design, lang)))
    totals = {"accepted": len(result.designs), "rejected": len(result.rejected)}
    note = translate("Designs: {accepted} accepted, {rejected} rejected.", lang, **totals)
    sections = [*_construction(result.task, lang), Section(heading.in_language(lang), tuple(items))]
    return gallery_html(translate("Designs", lang), sections, lang=lang, note=note)


def _moving(task: Task, design: Design, lang: str) -> str:
    """A design that moves through its whole range, as SVG; empty where it cannot be followed."""
    curves = ["P"] if "P" in design.linkage.points else []
    try:
        return animated_svg(_marked(task, design.linkage), curves=curves, lang=lang)
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
        parts.append(message("minimum transmission angle {angle:.1f}°", angle=degrees(verdict.transmission)))
    return joined(parts).in_language(lang)
