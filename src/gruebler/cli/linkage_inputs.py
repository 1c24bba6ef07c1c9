"""What a word stands for: the file of a linkage, a catalog entry, or lengths such as four-bar:25,70,40,70."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, translate
from gruebler.cli.left_out import say_left_out
from gruebler.cli.parser import Parser
from gruebler.cli.point_inputs import point_of
from gruebler.mechanics.fourbar.length_texts import LENGTH_FORMS, LENGTH_KINDS, ClosedForm, size_of
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain

if TYPE_CHECKING:
    from gruebler.mechanics.forces import Loads


def with_points(linkage: Linkage, texts: Collection[str]) -> Linkage:
    """The linkage with each LINK:X,Y among the texts as a point of that name; `LinkageError` for an unknown point."""
    added = {text: (point.link, point.x, point.y) for text in texts if isinstance(point := point_of(text), LinkPoint)}
    linkage = linkage.with_points(added) if added else linkage
    for text in texts:
        linkage.points_named(text)
    return linkage


def linkage_of_lengths(size: ClosedForm, lang: str = "en", *, unit: str = "") -> Linkage:
    """The linkage of given lengths, which have no unit; its links by their names in a language.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> linkage_of_lengths(FourBar(25, 70, 40, 70), "de").mechanism.chain.links
    ('Gestell', 'Kurbel', 'Koppel', 'Schwinge')
    """
    linkage = size.linkage(unit=unit)
    return linkage.renamed({link: translate(link, lang) for link in linkage.mechanism.chain.links})


def linkage_of_word(word: str, lang: str = "en", *, unit: str = "") -> tuple[Linkage, tuple[float, float] | None]:
    """The linkage of a word, and the drive values between which a catalog entry shows it.

    The links of lengths and of catalog entries have their names in the language. Lengths are in ``unit``,
    which files need.

    >>> linkage_of_word("slider-crank:25,70")[0].length("coupler", 1, 2)
    70.0
    """
    if (size := size_of(word)) is not None:
        return linkage_of_lengths(size, lang, unit=unit), None
    kind, colon, _ = word.partition(":")
    path = Path(word)
    foreign = value_of_another_program(word, lang)
    if isinstance(foreign, Linkage):
        return foreign, None
    if foreign is not None:
        raise GrueblerError("{path}: has chains without dimensions; expected a linkage", path=path)
    if path.suffix.lower() in (".toml", ".json") or len(path.parts) > 1 or path.is_file():
        from gruebler.files.linkages import read_linkage

        return read_linkage(path), None
    if "(" in word:
        raise GrueblerError(
            "{word!r} has no dimensions, which `gruebler realise` finds; give a file, a catalog entry or {forms}",
            word=word[:40],
            forms=LENGTH_FORMS,
        )
    from gruebler.base.errors import nearest
    from gruebler.teaching.catalog import entries, entry

    if word not in entries() and colon:
        raise GrueblerError(
            "{word!r}: expected {forms}{suggestion}",
            word=word,
            forms=LENGTH_FORMS,
            suggestion=nearest(kind, LENGTH_KINDS),
        )
    record = entry(word).in_language(lang)
    if record.dimensions is None:
        raise GrueblerError(
            "{word!r} has the screws of its joints in one position, not the dimensions of its links: `gruebler check "
            "{word} --explain` shows how it moves"
            if not record.in_space
            else "{word!r} does not move in a plane, and this command takes linkages in the plane alone: `gruebler "
            "analyse {word}` shows how it moves",
            word=word,
        )
    return record.linkage(), record.dimensions.range


class SpatialWord(NamedTuple):
    """A linkage given by the screws of its joints."""

    linkage: SpatialLinkage
    range: tuple[float, float] | None
    """Drive values between which a catalog entry shows it, in radians or the unit."""


def spatial_of_word(word: str, lang: str = "en") -> SpatialWord | None:
    """The linkage in space or on the sphere, or one given by screws in a file; None for every other word."""
    from gruebler.files.values import is_of_another_program

    path = Path(word)
    if path.suffix.lower() in (".toml", ".json") and path.is_file() and not is_of_another_program(path):
        from gruebler.files.screws import read_any_linkage

        value = read_any_linkage(path)
        return SpatialWord(value, None) if isinstance(value, SpatialLinkage) else None
    if "(" in word or ":" in word or path.is_file():
        return None
    from gruebler.teaching.catalog import entries

    record = entries().get(word)
    if record is None or not record.in_space:
        return None
    placed = record.in_language(lang).placed()
    assert isinstance(placed, SpatialLinkage)
    return SpatialWord(placed, record.between)


class Loaded(NamedTuple):
    """A linkage with what acts on it."""

    linkage: Linkage
    loads: Loads
    speed: float | None
    """At which its drive usually runs, in radians or the unit a second."""
    range: tuple[float, float] | None
    """Drive values between which a catalog entry shows it, in degrees or the unit."""


def add_loaded(command: Parser) -> None:
    """The argument for a linkage with loads, which `loaded_linkage` reads."""
    command.take(
        """
        linkage FILE|ID  a .toml or .json file of a linkage with a table [loads], or a catalog entry with loads
        """
    )


def loaded_linkage(word: str, lang: str = "en") -> Loaded:
    """The linkage and the loads of a file or a catalog entry; `GrueblerError` if there are none.

    The links of catalog entries have their names in the language.
    """
    from gruebler.teaching.catalog import entries

    loaded = linkage_with_loads(word, lang)
    if acts(loaded.loads):
        return loaded
    if not _is_file(word):
        raise GrueblerError(
            "{word!r} has no masses and no loads; the table [loads] of a linkage file has some, and these catalog "
            "entries: {loaded}",
            word=word,
            loaded=", ".join(each.id for each in entries().values() if each.loads is not None),
        )
    raise GrueblerError(
        "{path}: has no masses and no loads; a table [loads] has them, such as {example}",
        path=word,
        example='bodies = { crank = { mass = "250 g", bar = [[0, 0], [25, 0]] } }',
    )


def linkage_with_loads(word: str, lang: str = "en") -> Loaded:
    """The linkage of a word as of `linkage_of_word`, with the loads of its file or catalog entry, if there are some."""
    from gruebler.files.linkages import read_loaded
    from gruebler.files.values import is_of_another_program
    from gruebler.mechanics.forces import Loads
    from gruebler.teaching.catalog import entries

    if _is_file(word) and not is_of_another_program(Path(word)):
        return Loaded(*read_loaded(word), None)
    linkage, between = linkage_of_word(word, lang)
    record = None if _is_file(word) else entries().get(word)
    if record is None or record.loads is None:
        return Loaded(linkage, Loads(), None, between)
    return Loaded(*record.in_language(lang).loaded(), between)


def acts(loads: Loads) -> bool:
    """Whether there are masses, forces, moments or springs among loads."""
    return bool(loads.bodies or loads.masses or loads.forces or loads.moments or loads.springs or loads.torsion_springs)


def _is_file(word: str) -> bool:
    path = Path(word)
    return path.is_file() or path.suffix.lower() in (".toml", ".json")


def loads_and_speed(word: str, lang: str = "en") -> tuple[Loads, float]:
    """The loads of a file or a catalog entry, and the usual speed of its drive, else 0; errors as `loaded_linkage`."""
    loaded = loaded_linkage(word, lang)
    return loaded.loads, loaded.speed or 0.0


def value_of_another_program(word: str, lang: str = "en") -> Linkage | Chain | list[Chain] | None:
    """What a file of another program holds; None if the word is no name of one.

    What is not read of it is said on standard error.
    """
    from gruebler.files.values import is_of_another_program, read

    path = Path(word)
    if "(" in word or not is_of_another_program(path):
        return None
    left_out: list[Message] = []
    value = read(path, left_out=left_out)
    say_left_out(left_out, lang)
    assert isinstance(value, Linkage | Chain | list)
    return value
