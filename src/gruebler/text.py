"""Texts in two languages, and numbers as each of them writes them."""

from __future__ import annotations

import re

import msgspec

__all__ = ["Text", "in_language"]


class Text(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A text in both languages."""

    en: str
    de: str

    def said(self, lang: str) -> str:
        """The text in one language."""
        return self.de if lang == "de" else self.en


def in_language(numbers: str, lang: str) -> str:
    """Numbers and their units with the decimal sign of a language.

    >>> in_language("1.5 mm", "de"), in_language("1.5 mm", "en")
    ('1,5 mm', '1.5 mm')
    """
    return re.sub(r"(?<=\d)\.(?=\d)", ",", numbers) if lang == "de" else numbers
