"""What can be wrong with a question, each kind with a name of its own.

Every message says what was expected, what was found and, where there is one, the way out. A wrong call
raises; an honest failure (a budget spent, a proof not found) is a result and never one of these.
"""

from collections.abc import Iterable
from difflib import get_close_matches


class GrueblerError(ValueError):
    """The common parent: catching it catches every refusal of this library, and nothing else.

    Sentences that users of the command line meet often are there in German too.
    """

    def __init__(self, text: str = "", de: str | None = None) -> None:
        super().__init__(text)
        self.de = de

    def said(self, lang: str) -> str:
        """The sentence in a language, in English where there is no other.

        >>> LinkageError("it cannot move", "es lässt sich nicht bewegen").said("de")
        'es lässt sich nicht bewegen'
        """
        return self.de if lang == "de" and self.de is not None else str(self)


class PairError(GrueblerError):
    """A kind of joint that is unknown, ambiguous, or not possible in the space."""


class NotationError(GrueblerError):
    """A text, code or JSON document that does not describe a chain."""


class ChainError(GrueblerError):
    """Links and joints that do not make a sound chain."""


class CatalogError(GrueblerError):
    """A catalog file or key that cannot be used; the message names both."""


class LinkageError(GrueblerError):
    """Dimensions that do not make a sound linkage, or a question that its dimensions do not answer."""


class SynthesisError(GrueblerError):
    """A task of dimensional synthesis that contradicts itself or cannot be read."""


def nearest(word: str, known: Iterable[str]) -> str:
    """The end of a message that offers the known word nearest to a wrong one, or nothing.

    >>> nearest("cranck", ["frame", "crank"])
    "; did you mean 'crank'?"
    """
    close = get_close_matches(word, list(known), n=1, cutoff=0.5)
    return f"; did you mean {close[0]!r}?" if close else ""
