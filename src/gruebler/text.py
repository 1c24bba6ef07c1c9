"""Texts in two languages, and numbers as each of them writes them."""

from __future__ import annotations

import re

import msgspec

__all__ = ["Text", "decimal_sign_in"]


class Text(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A text in both languages."""

    en: str
    de: str

    def in_language(self, lang: str) -> str:
        """The text in one language."""
        return self.de if lang == "de" else self.en


def decimal_sign_in(numbers: str, lang: str) -> str:
    """Numbers and their units with the decimal sign of a language.

    >>> decimal_sign_in("1.5 mm", "de"), decimal_sign_in("1.5 mm", "en")
    ('1,5 mm', '1.5 mm')
    """
    return re.sub(r"(?<=\d)\.(?=\d)", ",", numbers) if lang == "de" else numbers
