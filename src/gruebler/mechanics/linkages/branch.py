"""Assembly modes as users write them: one kind of value and one parser for all that take a branch."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from gruebler.base.errors import LinkageError

Branch = str | Iterable[str] | None
"""An assembly mode: a text such as ``"+-"`` or ``"+,2,-"``, its labels one by one, or None for that of the reference
pose (without one, all ``+`` and 1). There is a label for each group that can be assembled in several ways, in solving
order: ``+`` or ``-`` for a dyad, the number of the mode from 1 for a larger group."""


def branch_labels(branch: Branch) -> tuple[str, ...] | None:
    """The labels of a branch; None where none is asked for.

    >>> branch_labels("+-"), branch_labels("+, 12,-"), branch_labels(["+", "12"]), branch_labels(None)
    (('+', '-'), ('+', '12', '-'), ('+', '12'), None)
    """
    if branch is None:
        return None
    text = branch if isinstance(branch, str) else ",".join(branch)
    labels = re.findall(r"[+-]|\d+", text)
    if "".join(labels) != re.sub(r"[\s,]", "", text):
        raise LinkageError(
            "branch: expected signs and numbers of modes, such as +- or +,2, but found {branch!r}", branch=text
        )
    return tuple(labels)


def branch_text(labels: Sequence[str]) -> str:
    """The text of labels, as `branch_labels` reads it.

    >>> branch_text(["+", "-"]), branch_text(["+", "2"])
    ('+-', '+,2')
    """
    return "".join(labels) if set(labels) <= {"+", "-"} else ",".join(labels)


def branch_side(branch: Branch) -> int:
    """The side of a linkage with two assembly modes: 1 for ``+`` (and None), -1 for ``-``.

    >>> branch_side("-"), branch_side(None)
    (-1, 1)
    """
    labels = ("+",) if branch is None else branch_labels(branch) if isinstance(branch, str | Iterable) else ()
    if labels not in (("+",), ("-",)):
        raise LinkageError("branch: expected + or -, but found {branch!r}", branch=branch)
    return 1 if labels == ("+",) else -1


def branch_of_side(side: float) -> str:
    """The branch of a side: ``+`` from 0 on, else ``-``."""
    return "+" if side >= 0 else "-"
