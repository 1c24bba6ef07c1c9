"""What a word stands for at the front door: a file, a machine of the catalog, lengths, a chain as text."""

from __future__ import annotations

import os
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, nearest
from gruebler.base.text import Message
from gruebler.files import values
from gruebler.mechanics.fourbar.length_texts import LENGTH_FORMS, LENGTH_KINDS, size_of

if TYPE_CHECKING:
    from gruebler.files.documents import Value
    from gruebler.structure.mechanism import Mechanism


@door
def read(
    path: str | PathLike[str], *, format_name: str | None = None, left_out: list[Message] | None = None
) -> Value | Mechanism:
    """The value that a file, a machine of the catalog, lengths or the text of a chain stand for.

    Args:
        path: a file, whose ending says the format (JSON of other programs is recognised); or the id of a catalog entry
            such as ``wiper``; or lengths such as ``four-bar:25,70,40,70``; or the text of a chain, mechanism or train
            (``sun:24 planet:18 ring:-60 on arm``). A file that is there comes first.
        format_name: the format of a file, if its name does not say it: one of `gruebler.files.formats.FORMATS`.
        left_out: gets a message for each thing in the file that the value does not have; without it such things are
            warnings, `FormatWarning`.

    Returns:
        A `Linkage`, `Chain`, `Mechanism`, list of chains, task, `TrainReading` or spatial linkage. A catalog entry
        gives its linkage, or its mechanism or chain where it has no dimensions.

    Raises:
        GrueblerError: the file or word and what does not fit.

    Cost:
        Below 1 ms for texts and small files; the first catalog entry some 100 ms.

    Example:
        >>> read("four-bar:25,70,40,70").length("coupler", 1, 2)
        70.0
        >>> print(read("R(0-1) R(1-2) R(2-0)"))
        R(0-1) R(1-2) R(2-0)

    See Also:
        `write`, `Chain.parse`, `FourBar`

    Theory:
        docs/theory/formats.md
    """
    if isinstance(path, str) and not path.strip():
        raise GrueblerError("no file is named; expected a file, a catalog entry, lengths or a chain, not an empty text")
    if isinstance(path, str) and format_name is None and not _is_file(path):
        return _of_word(path)
    return values.read(path, format_name=format_name, left_out=left_out)


def _is_file(word: str) -> bool:
    """Whether a word is the name of a file: one that is there, or by its ending or folder."""
    there = os.path.isfile(word)  # noqa: PTH113  Path.is_file refuses long texts
    if there or "(" in word or ":" in word or size_of(word) is not None:
        return there
    path = Path(word)
    return path.suffix != "" or len(path.parts) != 1


def _of_word(word: str) -> Value | Mechanism:
    from gruebler.machines.gears import read_train
    from gruebler.structure.chain import Chain
    from gruebler.structure.mechanism import Mechanism
    from gruebler.teaching.catalog.loader import entries

    if "(" in word:
        return Mechanism.parse(word) if ";" in word else Chain.parse(word)
    if (size := size_of(word)) is not None:
        return size.linkage()
    known = entries()
    if word not in known and ":" in word and " " in word:
        return read_train(word)
    if word not in known:
        values.refuse_folder(Path(word))
        kind = word.partition(":")[0]
        raise GrueblerError(
            "{word!r} is no file and no entry of the catalog{suggestion}; lengths are written {forms}",
            word=word,
            suggestion=nearest(kind, [*known, *(LENGTH_KINDS if kind not in LENGTH_KINDS else ())]),
            forms=LENGTH_FORMS,
        )
    record = known[word]
    if record.dimensions is not None:
        return record.linkage()
    if (linkage := record.placed()) is not None:
        return linkage
    chain = record.chain()
    return chain if record.frame is None else Mechanism(chain, record.frame, record.drives)
