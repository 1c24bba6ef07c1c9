"""The errors of this library.

Every message says what was expected, what was found and, where there is one, the way out. A wrong call
raises; a failure (a budget spent, a proof not found) is a result and never one of these.
"""

import functools
import re
import reprlib
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from difflib import get_close_matches
from typing import Any, ParamSpec, Protocol, TypeVar
from unicodedata import category

_P = ParamSpec("_P")
_R = TypeVar("_R")

LONGEST = 1000
"""Characters of a message; 300 of them at most without a space."""
_WORD = 300


class Template(Protocol):
    """A text with gaps and the values that fill them: `text.Message`."""

    @property
    def text(self) -> str:
        """The English text."""

    @property
    def values(self) -> Mapping[str, Any]:
        """What fills the gaps, by their names."""


class GrueblerError(ValueError):
    """The base class of all errors of this library.

    It carries an English text with gaps and the values that fill them (or a message that has both), so that
    `text.error_in_language` can say it in another language. What it says is one line of bounded length, however long
    the input is that it quotes. Errors are equal that are of one kind and say the same.

    >>> str(LinkageError("joint {joint!r} has no radius", joint="R(0-1)"))
    "joint 'R(0-1)' has no radius"
    >>> text = str(NotationError("{text!r} is not a chain", text="x" * 9000))
    >>> len(text), "… (9,002 characters) …" in text, text[-20:]
    (315, True, "xxxx' is not a chain")

    See Also:
        `UnitWarning`
    """

    def __init__(self, text: str | Template = "", /, **values: Any) -> None:
        if not isinstance(text, str):
            values = {**text.values, **values}
            text = text.text
        super().__init__(shortened(text.format(**values) if values else text))
        self.text = text
        self.values = values

    def __eq__(self, other: object) -> bool:
        return other.__class__ is self.__class__ and (str(self), self.text) == (str(other), getattr(other, "text", ""))

    def __hash__(self) -> int:
        return hash((self.__class__, str(self)))

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), self.text, self.values)


@contextmanager
def naming(place: object, kind: type[GrueblerError]) -> Iterator[None]:
    """What goes wrong within is said of a place: a file, a line, a key.

    >>> with naming("a.toml", LinkageError):
    ...     raise GrueblerError("no joint")
    Traceback (most recent call last):
    gruebler.base.errors.LinkageError: a.toml: no joint
    """
    try:
        yield
    except GrueblerError as error:
        raise kind("{place}: {error}", place=place, error=error) from None


def _again(kind: type[GrueblerError], text: str, values: dict[str, Any]) -> GrueblerError:
    """The error as it was, on the other side of a process boundary."""
    return kind(text, **values)


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


class RunError(GrueblerError):
    """A run that cannot begin or go on: workers that keep dying, a directory of another task, an unwritable file."""


class SynthesisError(GrueblerError):
    """A task of dimensional synthesis that contradicts itself or cannot be read."""


class TransformationError(GrueblerError):
    """A transformation that cannot be done there: what was to be removed is not such, or the places do not fit."""


class UnitWarning(UserWarning):
    """Angles, which are in radians everywhere, look as if they were degrees; `gruebler.base.angles` says when.

    See Also:
        `from_degrees`, `GrueblerError`

    Theory:
        docs/theory/kinematics.md
    """


def to_be_read(value: object) -> str:
    """The call that was meant where a text was given for a value: ``gr.read('wiper')``; empty for other things.

    >>> to_be_read("wiper"), to_be_read(5)
    ("gr.read('wiper')", '')
    """
    return f"gr.read({reprlib.repr(value)})" if isinstance(value, str) else ""


class AssemblyWarning(UserWarning):
    """A motion has no row, because the linkage cannot be assembled at the first one; its ``stop`` says why."""


_heard: ContextVar[bool] = ContextVar("heard", default=True)


def warn(text: object, kind: type[UserWarning]) -> None:
    """A warning at the line of the user, unless a function that is `unwarned` gives it."""
    if _heard.get():
        warnings.warn(str(text), kind, stacklevel=level_of_user())


def unwarned(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """The function without its warnings: for the library itself, which looks at what comes back."""

    @functools.wraps(function)
    def quiet(*args: _P.args, **named: _P.kwargs) -> _R:
        before = _heard.set(False)
        try:
            return function(*args, **named)
        finally:
            _heard.reset(before)

    return quiet


def level_of_user() -> int:
    """The ``stacklevel`` with which a warning stands at the line of the user: behind all frames of this library.

    Call it where the warning is given.
    """
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "gruebler":
        level, frame = level + 1, frame.f_back
    return level


def shortened(text: str) -> str:
    r"""One line of at most `LONGEST` visible characters: what is longer loses its middle, words first.

    >>> len(shortened("a" * 10**6)), shortened("two\n lines"), shortened("red: \x1b[31m")
    (300, 'two lines', 'red: \\x1b[31m')
    """
    if "\n" in text:
        text = re.sub(r"\s*\n\s*", " ", text.strip())
    text = visible(text)
    if len(text) > _WORD:
        text = re.sub(rf"\S{{{_WORD + 1},}}", lambda word: _without_middle(word[0], _WORD), text)
    return _without_middle(text, LONGEST)


def visible(text: str, keep: str = "") -> str:
    r"""The text with control characters as escapes, but those to keep: what a file says cannot steer the terminal.

    Control characters are those of the categories Cc, Cf and Cs of Unicode, which also turn the direction of writing.

    >>> visible("\x1b]0;title\x07", "\n"), visible("a\u202eb"), visible("Kürbel\n", "\n")
    ('\\x1b]0;title\\x07', 'a\\u202eb', 'Kürbel\n')
    """
    if text.translate(dict.fromkeys(map(ord, keep))).isprintable():
        return text
    return "".join(
        repr(letter)[1:-1] if letter not in keep and category(letter) in ("Cc", "Cf", "Cs") else letter
        for letter in text
    )


def _without_middle(text: str, most: int) -> str:
    """The beginning and a third as much of the end, and how much it was."""
    if len(text) <= most:
        return text
    middle = f"… ({len(text):,} characters) …"
    end = (most - len(middle)) // 4
    return text[: most - len(middle) - end] + middle + text[-end:]


def expect(value: object, wanted: type) -> None:
    """Nothing if a value is of a class; otherwise `GrueblerError`, which names the attribute of the value that is.

    >>> expect(3, str)
    Traceback (most recent call last):
    gruebler.base.errors.GrueblerError: expected str, but found int
    """
    if isinstance(value, wanted):
        return
    names = {"wanted": wanted.__name__, "found": type(value).__name__}
    attribute = wanted.__name__.lower()
    if isinstance(getattr(value, attribute, None), wanted):
        raise GrueblerError("expected {wanted}, but found {found}: take its {attribute}", attribute=attribute, **names)
    raise GrueblerError("expected {wanted}, but found {found}", **names)


class Suggestion(str):
    """A remark in an English message that offers a word; `text` translates it."""

    word: str


def near_words(word: str, known: Iterable[str], most: int = 1) -> list[str]:
    """The known words that a wrong word may stand for, the nearest first.

    At most a third of the letters, or one, are wrong, missing, too many or exchanged with the next; or the words begin
    alike, for three letters at least and two thirds of the shorter one.

    >>> near_words("cranck", ["frame", "crank"]), near_words("dead", ["dead-centres"]), near_words("foo", ["hood"])
    (['crank'], ['dead-centres'], [])
    """
    word = word[:50]
    close = get_close_matches(word, list(known), n=3 * most, cutoff=0.4)
    return [each for each in close if _is_near(word, each)][:most]


def _is_near(word: str, known: str) -> bool:
    shorter = min(len(word), len(known))
    alike = next((k for k in range(shorter) if word[k] != known[k]), shorter)
    if alike > 2 and 3 * alike >= 2 * shorter:
        return True
    return _slips(word, known[:60]) <= max(1, max(len(word), len(known)) // 3)


def _slips(word: str, other: str) -> int:
    """How many letters have to be changed, put in, left out or exchanged with the next (Damerau, Levenshtein)."""
    before: list[int] = []
    row = list(range(len(other) + 1))
    for i, letter in enumerate(word, 1):
        following = [i]
        for j, own in enumerate(other, 1):
            slips = min(following[-1] + 1, row[j] + 1, row[j - 1] + (letter != own))
            if i > 1 and j > 1 and letter == other[j - 2] and word[i - 2] == own:
                slips = min(slips, before[j - 2] + 1)
            following.append(slips)
        before, row = row, following
    return row[-1]


def check_method(method: str, known: Sequence[str], error: type[GrueblerError]) -> None:
    """Refuse the name of a method that is not known, with those that are."""
    if method not in known:
        raise error("there is no method {word!r}{suggestion}; there are {known}", **unknown(method, known))


def unknown(word: object, known: Iterable[str]) -> dict[str, Any]:
    """What fills the gaps ``word``, ``suggestion`` and ``known`` of a message about a word that is not known.

    >>> "no unit {word!r}{suggestion} among {known}".format(**unknown("mn", ["mm", "inch"]))
    "no unit 'mn' (did you mean 'mm'?) among mm, inch"
    """
    words = list(known)
    return {"word": word, "suggestion": nearest(str(word), words), "known": ", ".join(words)}


def nearest(word: str, known: Iterable[str]) -> str:
    """A remark for behind a wrong word, which offers the known word nearest to it; empty if none is near.

    >>> nearest("cranck", ["frame", "crank"])
    " (did you mean 'crank'?)"
    """
    close = near_words(word, known)
    if not close:
        return ""
    suggestion = Suggestion(f" (did you mean {close[0]!r}?)")
    suggestion.word = close[0]
    return suggestion
