"""All exercises: those of the catalog and the worked examples, by their ids or short names."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

from gruebler.base.errors import CatalogError, unknown
from gruebler.files import Exercise, read_exercise
from gruebler.teaching.catalog import catalog_folder, exercises
from gruebler.teaching.catalog.record_folders import RecordFolder
from gruebler.teaching.exercises.generation import generated_from_id, is_generated


@cache
def all_exercises() -> Mapping[str, Exercise]:
    """Worked examples and exercises in the order of the text.

    >>> list(all_exercises())[:2], len(all_exercises())
    (['example-2.3', 'example-2.5'], 40)
    """
    records = {**exercises(), **RecordFolder(catalog_folder() / "solved", read_exercise)}
    return {id: records[id] for id in sorted(records, key=_order)}


def _order(id: str) -> tuple[str, tuple[int, ...], str]:
    """Examples first, then exercises, by their numbers."""
    kind, _, numbers = id.partition("-")
    return kind, tuple(int(digits) for digits in re.findall(r"\d+", numbers)), numbers


def exercise(word: str) -> Exercise:
    """The exercise of an id; ``15`` means ``exercise-15``, ``3.2.1-central`` means ``example-3.2.1-central``.

    The id of a generated task (``grashof-2-17``) generates that task again. `CatalogError` for any other word.

    >>> exercise("15").id, exercise("grashof-1-7").method
    ('exercise-15', 'grashof.condition')
    """
    known = all_exercises()
    for id in (word, f"exercise-{word}", f"example-{word}"):
        if id in known:
            return known[id]
    if is_generated(word):
        return generated_from_id(word)
    raise CatalogError(
        "there is no exercise {word!r}{suggestion}; `gruebler exercise list` shows them, and a fresh "
        "task is named KIND-LEVEL-SEED, such as grashof-1-7",
        **unknown(word, known),
    )
