"""The catalog of the library: its folder, its entries, and searches."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from gruebler.base.errors import CatalogError, near_words
from gruebler.base.text import LANGUAGES
from gruebler.files.catalog_records import Entry, Exercise, read_entry, read_exercise
from gruebler.structure.chain.pairs import PAIRS, Pair, pair
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import family
from gruebler.structure.mobility import counted
from gruebler.teaching.catalog.claims import CheckedEntry, WrongClaim, check_claims
from gruebler.teaching.catalog.features import purpose
from gruebler.teaching.catalog.kinds import KINDS, machine_kinds
from gruebler.teaching.catalog.record_folders import RecordFolder, told_once


def catalog_folder() -> Path:
    """The folder of the catalog: inside the installed package, or at the top of a source checkout."""
    package = Path(__file__).resolve().parents[2]
    for folder in (package / "catalogs", package.parents[1] / "catalogs"):
        if folder.is_dir():
            return folder
    raise CatalogError(
        "the catalog is missing: neither {package} nor a source checkout has it", package=package / "catalogs"
    )


@cache
def entries() -> Mapping[str, Entry]:
    """All machines by id, in alphabetical order.

    >>> entries()["vcomp"].name.en
    'Two-cylinder V-compressor'
    """
    return RecordFolder(catalog_folder() / "machines", read_entry)


@cache
def exercises() -> Mapping[str, Exercise]:
    """All exercises by id."""
    return RecordFolder(catalog_folder() / "exercises", _exercise_of_known_machines)


def _exercise_of_known_machines(path: Path) -> Exercise:
    exercise = read_exercise(path)
    for case in exercise.cases:
        if case.machine not in entries():
            raise CatalogError(
                "{exercise}: {case}: there is no machine {machine!r} in the catalog",
                exercise=exercise.id,
                case=case.id,
                machine=case.machine,
            )
    return exercise


def entry(id: str) -> Entry:
    """The machine of this id; `CatalogError` with the nearest ids for any other word."""
    try:
        return entries()[id]
    except KeyError:
        if id in exercises():
            machines = dict.fromkeys(case.machine for case in exercises()[id].cases)
            raise CatalogError(
                "{id!r} is an exercise; the machines in it are {machines}", id=id, machines=", ".join(machines)
            ) from None
        if os.path.isdir(id):  # noqa: PTH112  Path.is_dir refuses long names
            raise CatalogError(
                "{id!r} is a folder; expected a file, a chain or the id of a catalog entry", id=id
            ) from None
        if Path(id).suffix:
            raise CatalogError(
                "{id!r} is neither a file here nor a catalog entry; `gruebler catalog list` shows all entries",
                id=id,
            ) from None
        close = near_words(id, entries(), 3)
        raise CatalogError(
            "the catalog has no entry {id!r}; did you mean {nearest}?"
            if close
            else "the catalog has no entry {id!r}; `gruebler catalog list` shows them all",
            id=id,
            nearest=", ".join(close),
        ) from None


def check_all() -> list[CheckedEntry]:
    """Check every claim of the catalog: the machines, then the exercises' cases."""
    machines = [check_entry(e) for e in entries().values()]
    return machines + [checked_entry for exercise in exercises().values() for checked_entry in check_exercise(exercise)]


def check_entry(record: Entry, origin: str | None = None) -> CheckedEntry:
    """Check every claim of a machine; ``origin`` is its file, by default that of the catalog."""
    where = str(catalog_folder() / "machines" / f"{record.id}.toml") if origin is None else origin
    checked = check_claims(
        record.chain(), record.claims, id=record.id, frame=record.frame, origin=where, linkage=record.placed()
    )
    if not record.claims.says_motion and not record.quantities:
        return checked
    from gruebler.teaching.catalog.motion_claims import (
        wrong_motions,  # they move linkages: loaded where they are needed
    )
    from gruebler.teaching.catalog.motion_quantities import wrong_quantities

    wrong = (*(WrongClaim(*each) for each in wrong_motions(record)), *wrong_quantities(record))
    return replace(checked, wrong=checked.wrong + wrong)


def check_exercise(record: Exercise, origin: str | None = None) -> list[CheckedEntry]:
    """Check every claim of an exercise's cases."""
    where = str(catalog_folder() / "exercises" / f"{record.id}.toml") if origin is None else origin
    checked = []
    for case in record.cases:
        machine = entry(case.machine)
        placed = None if case.claims.mobility is None else machine.placed()
        checked.append(
            check_claims(machine.chain(), case.claims, id=case.id, frame=machine.frame, origin=where, linkage=placed)
        )
    return checked


@dataclass(frozen=True, slots=True, kw_only=True)
class Query:
    """A search; None and empty mean no requirement."""

    words: tuple[str, ...] = ()
    """Each must occur in `searched_text`, in any language; case, accents and hyphens do not matter."""
    links: int | None = None
    joints: int | None = None
    mobility: int | None = None
    """F by the count."""
    pairs: tuple[str, ...] = ()
    """Symbols or names of pairs that must occur."""
    drive: str | None = None
    """Symbol or name of the pair of a driven joint."""

    def finds(self, candidate: Entry) -> bool:
        """Whether the entry satisfies the query."""
        chain = candidate.chain()
        driven = {chain.joints[k].pair for drive in candidate.drives if (k := chain.find_joint(drive)) is not None}
        present = {joint.pair for joint in chain.joints}
        return (
            (self.links is None or chain.n == self.links)
            and (self.joints is None or chain.g == self.joints)
            and (self.mobility is None or counted(chain) == self.mobility)
            and all(_meanings(symbol) & present for symbol in self.pairs)
            and (self.drive is None or bool(_meanings(self.drive) & driven))
            and all(plain_word(word) in searched_text(candidate) for word in self.words)
        )


def _meanings(symbol: str) -> set[Pair]:
    """All pairs that a symbol means in some alphabet, or the one of this name; `PairError` for any other word."""
    return {p for p in PAIRS if symbol in p.symbols.values()} or {pair(symbol)}


_NUMBERS = {
    3: ("three", "drei"),
    4: ("four", "vier"),
    5: ("five", "funf"),
    6: ("six", "sechs"),
    7: ("seven", "sieben"),
    8: ("eight", "acht"),
    9: ("nine", "neun"),
    10: ("ten", "zehn"),
    11: ("eleven", "elf"),
    12: ("twelve", "zwolf"),
}
"""Of links, as linkages are called by them and `plain_word` writes them."""


def plain_word(text: str) -> str:
    """A text as it is looked for: small letters without accents, words without hyphens and apostrophes.

    >>> plain_word("Six-Bar"), plain_word("Fünfgelenk"), plain_word("Hart's")
    ('sixbar', 'funfgelenk', 'harts')
    """
    letters = unicodedata.normalize("NFKD", text.casefold())
    return re.sub(r"[-\u2010\u2011–'’]", "", "".join(sign for sign in letters if not unicodedata.combining(sign)))


@told_once
def searched_text(candidate: Entry) -> str:
    """Everything in which a word is looked for, as `plain_word` writes it.

    Id, names, remark, source, names of links, what the mechanism is for, its family, its kinds, and what a linkage is
    called by the number of its links, in every language.
    """
    remark = candidate.remark
    chain = candidate.chain()
    mechanism = Mechanism(chain, candidate.frame or chain.links[0])
    use = purpose(mechanism, candidate.outputs)
    parts = [candidate.id, candidate.name.en, candidate.name.de, candidate.source]
    parts += [*candidate.links, *candidate.links.values()]
    parts += [remark.en, remark.de] if remark else []
    parts += [KINDS[kind][0].in_language(lang) for kind in machine_kinds(candidate) for lang in LANGUAGES]
    parts += [use.in_language(lang) for lang in LANGUAGES]
    parts += [family(mechanism, lang) or "" for lang in LANGUAGES]
    if chain.n in _NUMBERS and all(joint.pair.is_basic for joint in chain.joints):
        for english, german in (_NUMBERS[chain.n], (str(chain.n), str(chain.n))):
            parts += [f"{english}-bar", f"{german}gelenkgetriebe {german}gliedrig"]
    return plain_word("\n".join(parts))


def search(query: Query) -> list[Entry]:
    """The machines that satisfy a query: first those in whose name or id a word begins with each of its words, by id.

    >>> [e.id for e in search(Query(words=("Kompressor",), pairs=("P",)))]
    ['compressor', 'vcomp', 'wobble_plate']
    """
    fitting = (e for e in entries().values() if query.finds(e))
    return sorted(fitting, key=lambda each: not _is_called(each, query.words))


def _is_called(candidate: Entry, words: tuple[str, ...]) -> bool:
    """Whether words of its id and names begin with these.

    >>> _is_called(entries()["vcomp"], ("Two", "V-compr")), _is_called(entries()["vcomp"], ("press",))
    (True, False)
    """
    called = re.split(r"[\s_]+", "\n".join(searched_text(candidate).split("\n", 3)[:3]))
    return all(any(name.startswith(plain_word(word)) for name in called) for word in words)
