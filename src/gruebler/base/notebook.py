"""How values show themselves: in one line, in a notebook as a picture, a motion as a table.

`gruebler/__init__.py` puts the functions of higher rooms here, so that no value imports them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields
from html import escape
from itertools import islice
from typing import Any, TypeVar

_Class = TypeVar("_Class", bound=type)

svg_of: Callable[[object], str] | None = None
"""Makes the SVG of a chain, mechanism, linkage or motion; None until the front door has set it."""

table_of: Callable[..., Any] | None = None
"""Makes the table of a motion, or of forces in it; None until the front door has set it."""


class Drawn:
    """A value that a notebook shows as its picture."""

    __slots__ = ()

    def _repr_svg_(self) -> str | None:
        return svg_of(self) if svg_of else None


def brief(cls: _Class) -> _Class:
    """A dataclass (with ``repr=False``) of many values, whose `repr` is one line: arrays as their shapes and ends.

    One with a method ``explain`` is `explained` by it.

    >>> from dataclasses import dataclass
    >>> @brief
    ... @dataclass(repr=False)
    ... class Path:
    ...     name: str
    ...     numbers: list[int]
    >>> Path("a", list(range(1000)))
    <Path name='a', numbers=list of 1000>
    """

    def shown(self: Any) -> str:
        values = ((field.name, getattr(self, field.name)) for field in fields(self) if field.repr)
        return f"<{type(self).__name__} {', '.join(f'{name}={_in_brief(value)}' for name, value in values)}>"

    cls.__repr__ = shown  # type: ignore[assignment,method-assign]
    return explained(cls) if hasattr(cls, "explain") else cls


def explained(cls: _Class) -> _Class:
    """A class of which ``print`` shows what its method ``explain`` says in English, a notebook too unless it draws it.

    >>> class Stroke:
    ...     def explain(self, lang="en"):
    ...         return "H < 40"
    >>> print(explained(Stroke)(), Stroke()._repr_html_())
    H < 40 <pre>H &lt; 40</pre>
    """

    def told(self: Any) -> str:
        return str(self.explain())

    cls.__str__ = told  # type: ignore[assignment,method-assign]
    if not any(hasattr(cls, f"_repr_{form}_") for form in ("svg", "html", "mimebundle")):
        cls._repr_html_ = lambda self: f"<pre>{escape(told(self))}</pre>"  # type: ignore[attr-defined]
    return cls


_WIDE = 60  # characters of a value in such a line


def _in_brief(value: object) -> str:
    if hasattr(value, "shape"):
        ends = f" {value.flat[0]:.4g}…{value.flat[-1]:.4g}" if value.size else ""  # type: ignore[attr-defined]
        return f"array{value.shape}{ends}"
    if isinstance(value, list | tuple | dict | set | frozenset) and len(value) > 3:
        return f"{type(value).__name__} of {len(value)}"
    text = " ".join(repr(value).split())
    half = _WIDE // 2
    return text if len(text) <= _WIDE else f"{text[: half - 1]}…{text[-half:]}"


ROWS_SHOWN = 20
"""So many rows of a table are shown in a notebook or printed."""


def html_table(headers: Sequence[str], rows: Iterable[Sequence[str]], size: int) -> str:
    """A table for a notebook: its first rows, and how many there are.

    >>> html_table(["x"], [["1 < 2"]], 1)
    '<table><tr><th>x</th></tr><tr><td>1 &lt; 2</td></tr></table>'
    """
    lines = ["".join(f"<th>{escape(each)}</th>" for each in headers)]
    lines += ["".join(f"<td>{escape(each)}</td>" for each in row) for row in islice(rows, ROWS_SHOWN)]
    more = f"<p>{ROWS_SHOWN} of {size} rows</p>" if size > ROWS_SHOWN else ""
    return f"<table>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>{more}"


def text_table(headers: Sequence[str], rows: Iterable[Sequence[str]], size: int) -> str:
    """A table as aligned lines: its first rows, and how many there are.

    >>> print(text_table(["x", "name"], [["1", "crank"], ["22", "rocker"]], 2))
    x   name
    1   crank
    22  rocker
    """
    columns = list(zip(headers, *islice(rows, ROWS_SHOWN), strict=True))
    widths = [max(map(len, column)) for column in columns]
    lines = ["  ".join(map(str.ljust, line, widths)).rstrip() for line in zip(*columns, strict=True)]
    return "\n".join([*lines, f"({ROWS_SHOWN} of {size} rows)"] if size > ROWS_SHOWN else lines)
