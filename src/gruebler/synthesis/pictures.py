"""Pictures of designs: the linkage in its first position, the path of its point, and the targets of the task."""

from __future__ import annotations

from math import degrees, isnan

from gruebler.drawing.canvas import gallery_html
from gruebler.drawing.canvas.figure import Figure
from gruebler.drawing.canvas.gallery import Item, Section
from gruebler.drawing.linkage.picture import draw_linkage
from gruebler.linkages import Linkage
from gruebler.synthesis.results import Design, SynthesisResult
from gruebler.synthesis.tasks import PathTask, PositionTask, Task
from gruebler.text import Message, joined, message, translate

__all__ = ["design_figure", "designs_page"]

_MOST_MARKS = 12  # targets that get a name; of more every second, third, ... is shown


def _marked(task: Task, linkage: Linkage) -> Linkage:
    """The linkage with the targets as points of its frame, by their numbers."""
    match task:
        case PositionTask():
            places = task.origins
        case PathTask():
            places = task.z
        case _:
            return linkage
    step = -(-len(places) // _MOST_MARKS)
    frame = linkage.mechanism.frame
    numbered = {str(k + 1): (frame, float(z.real), float(z.imag)) for k, z in enumerate(places) if k % step == 0}
    return linkage.with_points(numbered)


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
    """All accepted designs on one HTML page, so many at most; rejected ones if there are no others."""
    shown, heading = (result.designs, message("Accepted")) if result.designs else (result.rejected, message("Rejected"))
    items = []
    for number, design in enumerate(shown[:most]):
        figure = design_figure(result.task, design, lang=lang)
        items.append(Item(figure, f"{number + 1} {_caption(design, lang)}"))
    totals = {"accepted": len(result.designs), "rejected": len(result.rejected)}
    note = translate("Designs: {accepted} accepted, {rejected} rejected.", lang, **totals)
    sections = [Section(heading.in_language(lang), tuple(items))]
    return gallery_html(translate("Designs", lang), sections, lang=lang, note=note)


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
