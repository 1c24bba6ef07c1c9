"""What a word on the command line stands for: a text, a code, a graph6 code, a family, or an entry of the catalog."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.cli.linkage_inputs import value_of_another_program
from gruebler.files.structures import chain_of_text, is_code, is_structure_text
from gruebler.files.values import is_of_another_program
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import of_family
from gruebler.teaching.catalog import entry


def _of_file(word: str, lang: str = "en") -> Linkage | SpatialLinkage | Chain | None:
    """What a file holds, with the dimensions of a linkage, the screws of its joints or a chain of another program."""
    path = Path(word)
    foreign = value_of_another_program(word, lang)
    if isinstance(foreign, list):
        if len(foreign) != 1:
            raise GrueblerError("{path}: expected one chain, but found {count}", path=path, count=len(foreign))
        return foreign[0]
    if foreign is not None:
        return foreign
    if is_structure_text(word) or not path.suffix or not path.is_file():
        return None
    if path.suffix.lower() not in (".toml", ".json"):
        raise GrueblerError(
            "{path}: expected a .toml or .json file of a linkage, not {suffix}", path=path, suffix=path.suffix
        )
    from gruebler.files.screws import read_any_linkage

    return read_any_linkage(path)


def chain_from_word(word: str, space: str | None = None, lang: str = "en") -> Chain:
    """The chain of a text, a code (its marks left out), a graph6 code, a linkage file, a family or a catalog entry."""
    if (value := _of_file(word, lang)) is not None:
        return value if isinstance(value, Chain) else value.mechanism.chain
    if (named := of_family(word)) is not None:
        return named.chain
    return chain_of_text(word, space) if is_structure_text(word) else entry(word).in_language(lang).chain()


def mechanism_of(word: str, frame: str | None, drives: Sequence[str], lang: str = "en") -> Mechanism:
    """The mechanism of a text or code with its marks, a file, a family or an entry; frame and drives given here win."""
    if (value := _of_file(word, lang)) is not None:
        mechanism = Mechanism(value, value.links[0]) if isinstance(value, Chain) else value.mechanism
    elif (named := of_family(word)) is not None:
        mechanism = named
    elif not is_structure_text(word):
        record = entry(word).in_language(lang)
        chain = record.chain()
        mechanism = Mechanism(chain, record.frame or chain.links[0], record.drives)
    elif "(" in word and not (is_code(word) and ";frame=" not in word):
        mechanism = Mechanism.parse(word)
    else:
        chain = chain_from_word(word)
        mechanism = Mechanism(chain, chain.links[0])
    return Mechanism(mechanism.chain, mechanism.frame if frame is None else frame, drives or mechanism.drives)


def outputs_of(word: str, lang: str = "en") -> tuple[str, ...]:
    """The output links that a text's mark, a linkage file or a catalog entry names."""
    if not is_structure_text(word) and is_of_another_program(Path(word)):
        return ()  # no other format has them
    if (value := _of_file(word, lang)) is not None:
        return value.outputs if isinstance(value, Linkage) else ()
    if not is_structure_text(word):
        return entry(word).in_language(lang).outputs
    if is_code(word) or ";" not in word:
        return ()
    output = Mechanism.parse_with_output(word)[1]
    return () if output is None else (output,)


def assortment_of(text: str | None) -> tuple[int, ...] | None:
    """The numbers of an --assortment option; None if it is not given.

    >>> assortment_of("4,2")
    (4, 2)
    """
    if text is None:
        return None
    try:
        return tuple(int(part) for part in text.split(","))
    except ValueError:
        raise GrueblerError(
            "--assortment {text!r}: expected the numbers of binary, ternary, ... links such as 4,4", text=text
        ) from None
