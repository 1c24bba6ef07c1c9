"""Texts, numbers and lists in the reader's language.

The code carries English only. Every other language is one gettext catalog, `locale/LANGUAGE/LC_MESSAGES/gruebler.po`,
which a translator edits without knowing Python; `make messages` brings it up to date with the code and compiles it.
A text with gaps is a format string: `{name}`, `{angle:.3f}`. Numbers take the decimal sign of the language by
themselves, and messages and errors inside a message are translated with it.
"""

from __future__ import annotations

import errno
import gettext
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cache
from numbers import Number, Real
from pathlib import Path
from string import Formatter
from typing import Any, Protocol, runtime_checkable

import msgspec

from gruebler.base.errors import GrueblerError, Suggestion, shortened

LANGUAGES = ("en", "de")
"""The languages there are: that of the code, then one for each folder in `locale`."""

LOCALE = Path(__file__).parent / "locale"
"""Where the catalogs of the other languages stand."""
_DECIMAL_COMMA = str.maketrans(".,", ",.")
_COMMA_LANGUAGES = frozenset({"de"})


@cache
def _catalog(lang: str) -> gettext.NullTranslations:
    if lang == LANGUAGES[0]:
        return gettext.NullTranslations()
    if lang not in LANGUAGES:
        raise GrueblerError(
            "expected a language ({known}), but found {found!r}", known=", ".join(LANGUAGES), found=lang
        )
    return gettext.translation("gruebler", LOCALE, [lang])


def number(value: Any, lang: str = "en", form: str = ".6g") -> str:
    """A number in a language: decimal sign and separator of thousands.

    The form `n` is for readers, in texts and tables of commands: four digits, or all that stand before the decimal
    sign; a value that six digits give exactly stays as it is.

    >>> number(1234.5), number(1234.5, "de"), number(19819281, "de", ",")
    ('1234.5', '1234,5', '19.819.281')
    >>> number(77.71634, "de", "n"), number(12345.67, form="n"), number(15.001, form="n")
    ('77,72', '12346', '15.001')
    >>> number(2.7e-17, form=".1e"), number(2.7e-17, "de", ".1e")
    ('2.7×10⁻¹⁷', '2,7·10⁻¹⁷')
    """
    written = _written(value, form)
    return _in_comma_language(written) if lang in _COMMA_LANGUAGES else written


def _in_comma_language(written: str) -> str:
    """A number with decimal comma, and with the dot that stands for times there."""
    return written.translate(_DECIMAL_COMMA).replace("×", "·")


def _written(value: Any, form: str) -> str:
    """A number in a form of Python's, or the form `n`; with `e` as a person writes powers of ten."""
    if form == "n":
        return _short(float(value)) if isinstance(value, Real) else format(value)
    written = format(value, form)
    if not form.endswith("e") or not math.isfinite(value):
        return written
    if value == 0 or 1e-3 <= abs(float(written)) < 1e4:
        return f"{float(written):g}"
    digits, power = written.split("e")
    return ("" if digits == "1" else f"{digits}×") + f"10{raised(int(power))}"


def raised(power: int) -> str:
    """A power as it stands beside the base.

    >>> "10" + raised(-17)
    '10⁻¹⁷'
    """
    return str(power).translate(_SUPERSCRIPTS)


_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _short(value: float) -> str:
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "∞" if value > 0 else "-∞"
    exact = f"{value:.6g}"
    if value == 0 or (math.isclose(float(exact), value, rel_tol=1e-12) and "e" not in exact):
        return f"{value + 0.0:.6g}"
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e9 else f"{value:.4g}"


def numbers(values: Iterable[Any], lang: str = "en", form: str = ".6g") -> str:
    """Numbers as a list: with semicolons between them where the comma is the decimal sign.

    >>> numbers([1.5, 2]), numbers([1.5, 2], "de")
    ('1.5, 2', '1,5; 2')
    """
    return number_separator(lang).join(number(value, lang, form) for value in values)


@runtime_checkable
class Readable(Protocol):
    """What is read in a language: messages, texts of data files, names of types and roles."""

    def in_language(self, lang: str) -> str:
        """The text in a language."""


class _LocalFormatter(Formatter):
    """`str.format` with numbers and messages in a language."""

    def __init__(self, lang: str) -> None:
        self.lang = lang

    def get_value(self, key: int | str, args: Any, kwargs: Mapping[str, Any]) -> Any:
        value = super().get_value(key, args, kwargs)
        if isinstance(value, GrueblerError):
            return error_in_language(value, self.lang)
        if isinstance(value, Suggestion):
            return translate(" (did you mean {word!r}?)", self.lang, word=value.word)
        return value.in_language(self.lang) if isinstance(value, Readable) else value

    def convert_field(self, value: Any, conversion: str | None) -> Any:
        if conversion == "r" and isinstance(value, float):
            # Still a number for `format_field`: NumPy's have their type in their repr, and -40.0 was given as -40.
            return int(value) if value.is_integer() and abs(value) < 2**53 else float(value)
        return super().convert_field(value, conversion)

    def format_field(self, value: Any, form: str) -> str:
        counts = isinstance(value, Number | Decimal) and not isinstance(value, bool)
        written = _written(value, form) if counts else format(value, form)
        local = counts and self.lang in _COMMA_LANGUAGES
        return _in_comma_language(written) if local else written


def _filled(text: str, lang: str, values: Mapping[str, Any]) -> str:
    return _LocalFormatter(lang).vformat(text, (), values) if values else text


def translate(text: str, lang: str = "en", /, **values: Any) -> str:
    """A text in a language, its gaps filled.

    Args:
        text: The English text as it stands in the catalog.
        lang: One of `LANGUAGES`; any other raises `GrueblerError`.
        values: What fills the gaps; numbers are written in the language, messages translated.

    >>> translate("{count} links", "en", count=4)
    '4 links'
    """
    return _filled(_catalog(lang).gettext(text) if text else "", lang, values)


def translate_in_context(context: str, text: str, lang: str = "en", /, **values: Any) -> str:
    """Like `translate` for an English word that has several translations; the context tells them apart."""
    return _filled(_catalog(lang).pgettext(context, text), lang, values)


def plural(one: str, many: str, count: int, lang: str = "en", /, **values: Any) -> str:
    """Like `translate`, the form chosen by a number, which fills the gap `{count}`.

    >>> plural("{count} joint", "{count} joints", 1), plural("{count} joint", "{count} joints", 3)
    ('1 joint', '3 joints')
    """
    return _filled(_catalog(lang).ngettext(one, many, count), lang, {"count": count, **values})


@dataclass(frozen=True)
class Message:
    """A text that is translated only when somebody reads it; made by `message`."""

    text: str
    values: Mapping[str, Any] = field(default_factory=dict)

    def in_language(self, lang: str) -> str:
        """The text in a language."""
        return translate(self.text, lang, **self.values)

    def filled(self, **values: Any) -> Message:
        """The message with these values in its gaps."""
        return Message(self.text, {**self.values, **values})

    def __str__(self) -> str:
        return self.in_language(LANGUAGES[0])


def message(text: str, /, **values: Any) -> Message:
    """A message that can be kept in a value or a table and translated later.

    >>> str(message("{n} links", n=4))
    '4 links'
    """
    return Message(text, values)


_REASONS = {
    errno.EACCES: message("Permission denied"),
    errno.EISDIR: message("Is a directory"),
    errno.ENAMETOOLONG: message("File name too long"),
    errno.ENOENT: message("No such file or directory"),
    errno.ENOSPC: message("No space left on device"),
    errno.ENOTDIR: message("Not a directory"),
    errno.EROFS: message("Read-only file system"),
}
"""Why files cannot be used, in the words of the C library; what is rarer stays in those of the system."""


def reason_of(error: OSError | UnicodeDecodeError) -> Message | str:
    """Why a file could not be read or written.

    >>> str(reason_of(FileNotFoundError(errno.ENOENT, "")))
    'No such file or directory'
    """
    if isinstance(error, UnicodeDecodeError):
        return message("it is not UTF-8 text")
    return _REASONS.get(error.errno or 0) or error.strerror or str(error)


def joined(parts: Iterable[object], separator: str = ", ") -> Message:
    """Messages, words and numbers, one after the other, as one message.

    >>> str(joined([message("{n} links", n=4), "R", 3.5]))
    '4 links, R, 3.5'
    """
    values = {f"part{k}": part for k, part in enumerate(parts)}
    return Message(separator.replace("{", "{{").replace("}", "}}").join(f"{{{name}}}" for name in values), values)


def error_in_language(error: GrueblerError, lang: str) -> str:
    """What an error says, in a language: one line of bounded length."""
    return shortened(translate(error.text, lang, **error.values))


_AND = message("and")


def listed(items: Iterable[object], lang: str = "en", last: Message = _AND) -> str:
    """Items as a list in a sentence.

    >>> listed("abc"), listed("ab", "de"), listed("a")
    ('a, b and c', 'a und b', 'a')
    """
    words = [item.in_language(lang) if isinstance(item, Readable) else str(item) for item in items]
    return f"{', '.join(words[:-1])} {last.in_language(lang)} {words[-1]}" if len(words) > 1 else "".join(words)


def joined_by_or(items: Sequence[object]) -> Message:
    """Items between which one has to choose, as one message.

    >>> str(joined_by_or([".svg", ".png", ".pdf"]))
    '.svg, .png or .pdf'
    """
    last = joined(items[-1:])
    return message("{items} or {last}", items=joined(items[:-1]), last=last) if len(items) > 1 else last


def joined_by_and(items: Sequence[object]) -> Message:
    """Items that go together, as one message.

    >>> joined_by_and(["a", message("{x} mm", x=1.5), "c"]).in_language("de")
    'a, 1,5 mm und c'
    """
    last = joined(items[-1:])
    return message("{items} and {last}", items=joined(items[:-1]), last=last) if len(items) > 1 else last


_ARITIES = {
    1: message("singular"),
    2: message("binary"),
    3: message("ternary"),
    4: message("quaternary"),
    5: message("quinary"),
    6: message("senary"),
}


def arity(joints: int, lang: str = "en") -> str:
    """What a link with so many joints is called.

    >>> arity(3), arity(2, "de"), arity(9)
    ('ternary', 'binär', '9-joint')
    """
    if joints in _ARITIES:
        return _ARITIES[joints].in_language(lang)
    return translate("{joints}-joint", lang, joints=joints)


class Text(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A text that a data file gives in both languages; texts of the code are messages."""

    en: str
    de: str

    def in_language(self, lang: str) -> str:
        """The text in one language."""
        return self.de if lang == "de" else self.en

    def __str__(self) -> str:
        return self.en


def in_every_language(write: Callable[[str], str]) -> Text:
    """What a function writes in each language, kept as a value: a chain in the symbols of the language, for example.

    >>> in_every_language(lambda lang: arity(3, lang))
    Text(en='ternary', de='ternär')
    """
    return Text(**{lang: write(lang) for lang in LANGUAGES})


def number_separator(lang: str) -> str:
    """What stands between numbers in a list: a semicolon where the comma is the decimal sign.

    >>> number_separator("en"), number_separator("de")
    (', ', '; ')
    """
    return "; " if lang in _COMMA_LANGUAGES else ", "


def decimal_sign_in(numbers: str, lang: str) -> str:
    """A formula, or numbers and their units, with the decimal sign of a language.

    Where that is a comma, a semicolon takes its place between numbers of which one has decimals.

    >>> decimal_sign_in("1.5 mm", "de"), decimal_sign_in("1.5 mm", "en"), decimal_sign_in("(0.5, 3)", "de")
    ('1,5 mm', '1.5 mm', '(0,5; 3)')
    """
    if lang not in _COMMA_LANGUAGES:
        return numbers
    numbers = re.sub(r"(\d\.\d+), (?=[-\d])|(?<=\d), (?=-?\d+\.\d)", r"\1; ", numbers)
    return re.sub(r"(?<=\d)×(?=10)", "·", re.sub(r"(?<=\d)\.(?=\d)", ",", numbers))
