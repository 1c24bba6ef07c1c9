"""The layout of a collection sheet on its page."""

from __future__ import annotations

from collections.abc import Iterable

from gruebler.base.errors import CatalogError
from gruebler.base.text import translate
from gruebler.pictures.canvas import Figure
from gruebler.pictures.canvas.panels import ratio_diagram
from gruebler.pictures.canvas.shapes import wrapped_text
from gruebler.pictures.structure import draw_structure
from gruebler.teaching.sheets.messages import (
    example_lines,
    explanation_paragraphs,
    typeset_number,
    value_lines,
    with_subscripts,
)
from gruebler.teaching.sheets.model import Sheet, StatedValue
from gruebler.teaching.sheets.page import HEIGHT, WIDTH, HorizontalRule, Page, PlacedPicture, TextLine
from gruebler.teaching.sheets.picture import definition_picture, scale_picture

_LEFT, _RIGHT = 56.0, WIDTH - 56.0
_MIDDLE, _GAP = 372.0, 26.0
_BODY, _LEAD = 11.0, 15.0
_SMALLEST = 1e-5  # Q_G in the diagram
_FIELD = 250.0, 290.0  # of the diagram, pixels

Item = TextLine | HorizontalRule | PlacedPicture


def page(sheet: Sheet, lang: str = "en") -> Page:
    """The page of a sheet, ready to be printed; `CatalogError` if one of its values does not hold.

    >>> from gruebler.teaching.sheets import sheet
    >>> page(sheet("mzc")).title
    'Crank-rocker as a replacement for a Meyer zur Capellen linkage'
    """
    for wrong in sheet.wrong:
        raise CatalogError(
            "sheet {sheet}: {symbol} is {derived:.9g}, not what the record says of it",
            sheet=sheet.id,
            symbol=wrong.symbol,
            derived=wrong.derived,
        )
    items: list[Item] = [
        TextLine(x=_LEFT, y=50, text=translate("Collection of mechanisms", lang), size=10, role="faint"),
        TextLine(x=_RIGHT, y=50, text=translate("Sheet {id}", lang, id=sheet.id), size=10, role="faint", anchor="end"),
    ]
    items.append(HorizontalRule(_LEFT, 57, _RIGHT - _LEFT, 1.2))
    y = 82.0
    for line in wrapped_text(sheet.record.title.in_language(lang), _RIGHT - _LEFT, 18 * 1.06):
        items.append(TextLine(x=_LEFT, y=y, text=line, size=18, bold=True))
        y += 23
    for task in sheet.record.tasks:
        items.append(TextLine(x=_LEFT, y=y, text=f"–  {task.in_language(lang)}", size=_BODY))
        y += _LEAD
    y = _pictures(items, sheet, y, lang) + 22
    features_bottom = _features(items, sheet, y, lang)
    explained = translate("Explanation", lang)
    y = max(features_bottom, _paragraphs(items, explained, explanation_paragraphs(sheet, lang), _MIDDLE, y)) + 14
    _straightness(items, sheet, y, lang)
    _footer(items, sheet, lang)
    about = " ".join(f"{label}: {value}." for label, value in sheet.features.described(lang))
    return Page(tuple(items), sheet.record.title.in_language(lang), about, lang)


# --- sections ---------------------------------------------------------------------------------------


def _pictures(items: list[Item], sheet: Sheet, y: float, lang: str) -> float:
    """The linkage to scale and its structure, with captions; the y below them."""
    high = 288.0
    links = sheet.entry.link_names(lang).items()
    names = {link: name.partition(f" {translate('with', lang)} ")[0] for link, name in links}
    structure = draw_structure(
        sheet.linkage.mechanism, labels=True, symbols=True, outputs=sheet.entry.outputs, lang=lang, names=names
    )
    _fitted(items, scale_picture(sheet, lang), _LEFT, y, 400, high)
    right, middle = 470.0, y + 0.5 * high
    _fitted(items, structure, right, y, _RIGHT - right, 0.42 * high)
    pose = f"{typeset_number(sheet.record.picture.pose, lang)}°"
    to_scale = translate(
        "To scale at φ = {pose}, coupler curve, tangent g, axis of symmetry"
        if sheet.record.picture.axis_through
        else "To scale at φ = {pose}, coupler curve, straight line g",
        lang,
        pose=pose,
    )
    items.append(TextLine(x=_LEFT, y=y + high + 14, text=to_scale, size=10, role="faint"))
    output = ", ".join(names[link] for link in sheet.entry.outputs)
    caption = translate("Structure, output {output}: double arrow", lang, output=output)
    items.append(TextLine(x=_RIGHT, y=middle - 8, text=caption, size=10, role="faint", anchor="end"))
    definition, factor = definition_picture(sheet, lang)
    _fitted(items, definition, right, middle + 4, _RIGHT - right, y + high - middle - 4)
    caption = translate("For the definition of Q_G, enlarged {factor} times across g", lang, factor=f"{factor:.2g}")
    items.append(TextLine(x=_RIGHT, y=y + high + 14, text=caption, size=10, role="faint", anchor="end"))
    return y + high + 14


def _features(items: list[Item], sheet: Sheet, y: float, lang: str) -> float:
    """Access features and dimensions, in the left column; the y below them."""
    y = _heading(items, translate("Access features", lang), _LEFT, y, _MIDDLE - _GAP)
    for label, value in sheet.features.described(lang):
        items += [TextLine(x=_LEFT, y=y, text=label, size=_BODY), TextLine(x=_LEFT + 110, y=y, text=value, size=_BODY)]
        y += _LEAD
    heading = translate("Dimensions (unit of length {unit})", lang, unit=sheet.dimensions[0].symbol)
    y = _heading(items, heading, _LEFT, y + 10, _MIDDLE - _GAP)
    for length in sheet.dimensions:
        items += _dimension(length, y, lang)
        y += _LEAD
    return y


def _dimension(value: StatedValue, y: float, lang: str) -> Iterable[Item]:
    yield TextLine(x=_LEFT, y=y, text=value.symbol, size=_BODY)
    yield TextLine(x=_LEFT + 28, y=y, text=with_subscripts("".join(value.of)), size=_BODY, role="faint")
    if value.exact is not None:
        yield TextLine(x=_LEFT + 110, y=y, text=value.exact.typeset, size=_BODY)
    yield TextLine(x=_MIDDLE - _GAP, y=y, text=typeset_number(value.derived, lang, ".6f"), size=_BODY, anchor="end")


def _straightness(items: list[Item], sheet: Sheet, y: float, lang: str) -> None:
    """The diagram, and beside it the example and the values."""
    guide, example = sheet.record.guide, sheet.example
    left, right = _MIDDLE + 38, _MIDDLE + 38 - _GAP
    below = _heading(items, translate("Relative deviation from the line", lang), _LEFT, y, right)
    centre = f"{typeset_number(guide.centre, lang)}°"
    windows = translate("Q_G = Δy/L for φ_G about φ = {centre}, φ_A = {centre} - φ_G/2", lang, centre=centre)
    items.append(TextLine(x=_LEFT, y=below, text=windows, size=10, role="faint"))
    _fitted(items, _diagram(sheet, lang), _LEFT, below + 6, right - _LEFT, HEIGHT - 88 - below)
    heading = translate(
        "Example: L = {length:g} {unit} within {tolerance:g} {unit}",
        lang,
        length=example.length,
        tolerance=example.tolerance,
        unit=guide.unit,
    )
    y = _paragraphs(items, heading, example_lines(sheet, lang), left, y, apart=0)
    _paragraphs(items, translate("Values", lang), value_lines(sheet, lang), left, y + 14, apart=0)


def _diagram(sheet: Sheet, lang: str) -> Figure:
    curve, piece = sheet.curve, sheet.example.sizing.piece
    shown = (curve.ratios > _SMALLEST) & (curve.widths < 1.25 * (piece.end - piece.start))
    return ratio_diagram(
        curve.widths[shown],
        curve.ratios[shown],
        curve.lengths[shown],
        at=(piece.end - piece.start, piece.ratio, piece.length),
        begin=lambda width: float(sheet.window.ends(width)[0]),
        lang=lang,
        title=sheet.record.title.in_language(lang),
        size=_FIELD,
    )


def _footer(items: list[Item], sheet: Sheet, lang: str) -> None:
    lines = [f"[{k}] {text}" for k, text in enumerate(sheet.record.literature, 1)]
    lines.append(
        translate(
            "Structure, lengths and values derived from the model; source {source}.", lang, source=sheet.record.source
        )
    )
    y = HEIGHT - 42 - 12 * (len(lines) - 1)
    items.append(HorizontalRule(_LEFT, y - 13, _RIGHT - _LEFT))
    for line in lines:
        items.append(TextLine(x=_LEFT, y=y, text=line, size=8.5, role="faint"))
        y += 12


# --- setting ----------------------------------------------------------------------------------------


def _heading(items: list[Item], text: str, x: float, y: float, right: float) -> float:
    """A heading with a rule below; returns the base line of the following text."""
    items += [TextLine(x=x, y=y, text=text, size=_BODY + 0.5, bold=True), HorizontalRule(x, y + 5, right - x)]
    return y + 5 + _LEAD


def _paragraphs(items: list[Item], heading: str, texts: Iterable[str], x: float, y: float, apart: float = 5) -> float:
    """Wrapped texts under a heading, to the right margin; the y below them."""
    y = _heading(items, heading, x, y, _RIGHT)
    for text in texts:
        for line in wrapped_text(text, _RIGHT - x, _BODY):
            items.append(TextLine(x=x, y=y, text=line, size=_BODY))
            y += _LEAD
        y += apart
    return y


def _fitted(items: list[Item], figure: Figure, x: float, y: float, wide: float, high: float) -> None:
    """A picture in the middle of a box, reduced to fit it but not enlarged."""
    scale = min(wide / figure.width, high / figure.height, 1.0)
    left, top = x + (wide - scale * figure.width) / 2, y + (high - scale * figure.height) / 2
    items.append(PlacedPicture(left, top, scale, figure))
