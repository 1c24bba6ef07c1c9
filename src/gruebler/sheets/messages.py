"""The words of a sheet in both languages, and numbers as each of them writes them."""

from __future__ import annotations

import math
from collections.abc import Mapping

from gruebler.sheets.model import Sheet, StatedValue

__all__ = ["LocalNumber", "example_lines", "explanation_paragraphs", "messages", "value_lines", "with_subscripts"]

_WORDS: dict[str, dict[str, str]] = {
    "en": {
        "collection": "Collection of mechanisms",
        "sheet": "Sheet {id}",
        "scale": "To scale at φ = {pose}, coupler curve, tangent g, axis of symmetry",
        "scale_plain": "To scale at φ = {pose}, coupler curve, straight line g",
        "structure": "Structure, {drive}, output: {output}",
        "driven": "driven joint: arrow",
        "features": "Access features",
        "dimensions": "Dimensions (unit of length {unit})",
        "explanation": "Explanation",
        "values": "Values",
        "diagram": "Relative deviation from the line",
        "ratio": "Q_G = Δy/L for windows φ_G about φ = {centre}",
        "example": "Example: L = {length} {unit} within {tolerance} {unit}",
        "window": "crank from {start}° to {end}°",
        "printed": "the source has {text}",
        "literature": "Literature",
        "source": "Structure, lengths and values derived from the model; source {source}.",
    },
    "de": {
        "collection": "Getriebesammlung",
        "sheet": "Blatt {id}",
        "scale": "Maßstäblich bei φ = {pose}, Koppelkurve, Tangente g, Symmetrieachse",
        "scale_plain": "Maßstäblich bei φ = {pose}, Koppelkurve, Gerade g",
        "structure": "Strukturbild, {drive}, Abtrieb: {output}",
        "driven": "Antriebsgelenk: Pfeil",
        "features": "Zugriffsmerkmale",
        "dimensions": "Abmessungen (Längeneinheit {unit})",
        "explanation": "Erläuterung",
        "values": "Werte",
        "diagram": "Bezogene Geradführungsabweichung",
        "ratio": "Q_G = Δy/L für Kurbelwinkel φ_G beiderseits von φ = {centre}",
        "example": "Beispiel: L = {length} {unit} innerhalb von {tolerance} {unit}",
        "window": "Kurbel von {start}° bis {end}°",
        "printed": "in der Vorlage {text}",
        "literature": "Literatur",
        "source": "Struktur, Längen und Werte aus dem Modell abgeleitet; Vorlage {source}.",
    },
}

_INDICES = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_EQUALS = "\u00a0=\u00a0"  # without a break


def messages(lang: str) -> Mapping[str, str]:
    """The words of a language; formats take `LocalNumber`."""
    return _WORDS[lang]


def with_subscripts(name: str) -> str:
    """A name with its digits as indices.

    >>> with_subscripts("A0B0")
    'A₀B₀'
    """
    return name.translate(_INDICES)


class LocalNumber(float):
    """A number that is written with a decimal comma where the language has one.

    >>> f"{LocalNumber(2.5, 'de'):.2f} {LocalNumber(2.5, 'en')}"
    '2,50 2.5'
    """

    lang: str

    def __new__(cls, value: float, lang: str) -> LocalNumber:
        """The number in a language."""
        local_number = super().__new__(cls, value)
        local_number.lang = lang
        return local_number

    def __format__(self, form: str) -> str:
        """As a float, but for the comma and the minus sign."""
        said = format(float(self), form or "g").replace("-", "−")
        return said.replace(".", ",") if self.lang == "de" else said


class _ValueSlot:
    """A value in a text: exact without a form, else with so many digits."""

    def __init__(self, value: StatedValue, lang: str) -> None:
        self.exact, self.number = value.exact, LocalNumber(value.derived, lang)

    def __format__(self, form: str) -> str:
        return self.exact.typeset if not form and self.exact is not None else format(self.number, form)


def explanation_paragraphs(sheet: Sheet, lang: str) -> list[str]:
    """The paragraphs of the explanation, with derived values in their places."""
    values = {value.id: _ValueSlot(value, lang) for value in sheet.quantities}
    return [text.in_language(lang).format_map(values).replace(" = ", _EQUALS) for text in sheet.record.explanation]


def value_lines(sheet: Sheet, lang: str) -> list[str]:
    """Each value of the mechanism that the sheet tells: symbol, exact, decimal, and what the source has instead."""
    out = []
    for value, row in zip(sheet.quantities, sheet.record.quantities, strict=True):
        if row.rocker is not None:
            continue
        said = f"{LocalNumber(value.derived, lang):.6f}" + value.unit
        if value.exact is not None and value.exact.text.isdigit():
            said = f"{value.exact.text}: {value.name.in_language(lang)}" if value.name else value.exact.text
        elif value.exact is not None:
            said = f"{value.exact.typeset} = {said}"
        if not value.is_as_printed and value.printed is not None:
            said += f" ({messages(lang)['printed'].format(text=value.printed.typeset)})"
        out.append(f"{value.symbol} = {said}")
    return out


def example_lines(sheet: Sheet, lang: str) -> list[str]:
    """The sizing of the sheet's task, step by step."""
    found = sheet.example
    unit, scale = sheet.record.guide.unit, sheet.dimensions[0].symbol
    start, end = (LocalNumber(math.degrees(angle), lang) for angle in found.sizing.piece[:2])

    def n(value: float) -> LocalNumber:
        return LocalNumber(value, lang)

    return [
        f"Q_G = {n(found.tolerance):g}/{n(found.length):g} = {n(found.tolerance / found.length):g}",
        f"φ_G = {n(end - start):.4f}°, φ_A = {start:.4f}°, φ_E = {end:.4f}°",
        f"L/{scale} = {n(found.ratio):.6f}",
        f"{scale} = {n(found.length):g}/{n(found.ratio):.6f} = {n(found.scale):.4f} {unit}",
        ("; " if lang == "de" else ", ").join(f"{symbol}{_EQUALS}{n(value):.3f}" for symbol, value in found.lengths[1:])
        + f"\u00a0{unit}",
    ]
