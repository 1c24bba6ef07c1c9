"""The texts of a sheet, and its numbers in print."""

from __future__ import annotations

import math

from gruebler.base.text import number, number_separator, translate
from gruebler.teaching.sheets.model import Sheet, StatedValue

_INDICES = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_EQUALS = "\u00a0=\u00a0"  # without a break


def with_subscripts(name: str) -> str:
    """A name with its digits as indices.

    >>> with_subscripts("A0B0")
    'A₀B₀'
    """
    return name.translate(_INDICES)


def typeset_number(value: float, lang: str, form: str = "g") -> str:
    """A number in print: the decimal sign of the language and a minus sign.

    >>> typeset_number(-2.5, "de", ".2f"), typeset_number(2.5, "en")
    ('−2,50', '2.5')
    """
    return number(value, lang, form).replace("-", "−")


class _ValueSlot:
    """A value in a text: exact without a format, else with its number of digits."""

    def __init__(self, value: StatedValue, lang: str) -> None:
        self.exact, self.derived, self.lang = value.exact, value.derived, lang

    def __format__(self, form: str) -> str:
        if not form and self.exact is not None:
            return self.exact.typeset
        return typeset_number(self.derived, self.lang, form or "g")


def explanation_paragraphs(sheet: Sheet, lang: str) -> list[str]:
    """The paragraphs of the explanation, with derived values in their places."""
    values = {value.id: _ValueSlot(value, lang) for value in sheet.quantities}
    return [text.in_language(lang).format_map(values).replace(" = ", _EQUALS) for text in sheet.record.explanation]


def value_lines(sheet: Sheet, lang: str) -> list[str]:
    """Each value of the mechanism: symbol, exact, decimal, and the source's value if it differs."""
    lines = []
    for value, row in zip(sheet.quantities, sheet.record.quantities, strict=True):
        if row.rocker is not None:
            continue
        shown = typeset_number(value.derived, lang, ".6f") + value.unit
        if value.exact is not None and value.exact.text.isdigit():
            shown = f"{value.exact.text}: {value.name.in_language(lang)}" if value.name else value.exact.text
        elif value.exact is not None:
            shown = f"{value.exact.typeset} = {shown}"
        if not value.is_as_printed and value.printed is not None:
            note = translate("the source has {printed}", lang, printed=value.printed.typeset)
            shown += f" ({note})"
        lines.append(f"{value.symbol} = {shown}")
    return lines


def example_lines(sheet: Sheet, lang: str) -> list[str]:
    """The sizing of the sheet's task, step by step."""
    example, unit, scale = sheet.example, sheet.record.guide.unit, sheet.dimensions[0].symbol
    start, end = (math.degrees(angle) for angle in (example.sizing.piece.start, example.sizing.piece.end))

    def shown(value: float, form: str = "g") -> str:
        return typeset_number(value, lang, form)

    lengths = [f"{symbol}{_EQUALS}{shown(value, '.3f')}" for symbol, value in example.lengths[1:]]
    return [
        f"Q_G = {shown(example.tolerance)}/{shown(example.length)} = {shown(example.tolerance / example.length)}",
        f"φ_G = {shown(end - start, '.4f')}°, φ_A = {shown(start, '.4f')}°, φ_E = {shown(end, '.4f')}°",
        f"L/{scale} = {shown(example.ratio, '.6f')}",
        f"{scale} = {shown(example.length)}/{shown(example.ratio, '.6f')} = {shown(example.scale, '.4f')} {unit}",
        f"{number_separator(lang).join(lengths)}\u00a0{unit}",
    ]
