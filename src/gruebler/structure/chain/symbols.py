"""The pairs that the joint symbols of one text mean, all read in one alphabet."""

from __future__ import annotations

from collections.abc import Iterable

from gruebler.base.errors import PairError, unknown
from gruebler.base.text import Message, joined, joined_by_or, message
from gruebler.structure.chain.pairs import BY_FULL_NAME, PAIRS, Alphabet, Pair, pair
from gruebler.structure.chain.spaces import Space


def read_symbols(symbols: Iterable[str], space: Space) -> dict[str, Pair]:
    """The pair that each symbol of one text means, with all symbols read in one alphabet.

    Full names, English or German, are valid in either alphabet. A set of symbols is accepted if only one
    alphabet has it, or if both give it the same meaning; a set that mixes alphabets, or that has two valid
    readings, raises an error that states both readings.

    >>> read_symbols(["D", "S"], Space.PLANAR)
    {'D': <pair revolute>, 'S': <pair prismatic>}
    >>> read_symbols(["S"], Space.SPATIAL)
    Traceback (most recent call last):
        ...
    gruebler.base.errors.PairError: 'S' is ambiguous: prismatic in the German alphabet, spherical in the
    international one; write the full name (prismatic or spherical) or add a joint that only one alphabet has
    """
    distinct_symbols = list(dict.fromkeys(symbols))
    named = {s: BY_FULL_NAME[s.casefold()] for s in distinct_symbols if s.casefold() in BY_FULL_NAME}
    letters = [s for s in distinct_symbols if s not in named]
    _refuse_unknown(letters)
    readings = {a: r for a in Alphabet if (r := _reading(letters, a, space)) is not None}
    if not readings:
        raise _mixed(letters)
    sound = {a: r for a, r in readings.items() if all(len(meanings) > 0 for meanings in r.values())}
    if not sound:
        raise _impossible(readings, space)
    distinct: list[dict[str, tuple[Pair, ...]]] = []
    for reading in sound.values():
        if reading not in distinct:
            distinct.append(reading)
    if len(distinct) > 1:
        raise _two_alphabets(*distinct)
    for symbol, meanings in distinct[0].items():
        if len(meanings) > 1:
            raise PairError(
                "{symbol!r} is ambiguous: {meanings}; write the full name",
                symbol=symbol,
                meanings=joined_by_or([f"{p.name} ({p.german})" for p in meanings]),
            )
    return named | {symbol: meanings[0] for symbol, meanings in distinct[0].items()}


def _meanings(symbol: str, alphabet: Alphabet) -> tuple[Pair, ...]:
    return tuple(p for p in PAIRS if p.symbols.get(alphabet) == symbol)


def _reading(letters: list[str], alphabet: Alphabet, space: Space) -> dict[str, tuple[Pair, ...]] | None:
    """The pairs of this space that each symbol may mean; None if the alphabet lacks one of the symbols."""
    if not all(_meanings(s, alphabet) for s in letters):
        return None
    return {s: tuple(p for p in _meanings(s, alphabet) if space in p.freedoms) for s in letters}


def _refuse_unknown(letters: list[str]) -> None:
    known = {s for p in PAIRS for s in p.symbols.values()}
    for symbol in letters:
        if symbol not in known:
            raise PairError(
                "unknown joint symbol {word!r}{suggestion}; the symbols are {international} (international) and "
                "{german} (German), or the full name of a pair",
                international=", ".join(sorted({p.symbol() for p in PAIRS if Alphabet.INTERNATIONAL in p.symbols})),
                german=", ".join(dict.fromkeys(p.symbols[Alphabet.GERMAN] for p in PAIRS)),
                **unknown(symbol, (*known, *BY_FULL_NAME)),
            )


def _mixed(letters: list[str]) -> PairError:
    german, international = (
        joined(_symbol_meaning(s, _meanings(s, alphabet)) for s in letters)
        for alphabet in (Alphabet.GERMAN, Alphabet.INTERNATIONAL)
    )
    return PairError(
        "the symbols mix two alphabets (German: {german}; international: {international}); write all joints in one of "
        "them",
        german=german,
        international=international,
    )


def _symbol_meaning(symbol: str, pairs: tuple[Pair, ...]) -> Message:
    if not pairs:
        return message("{symbol} is unknown", symbol=symbol)
    return message("{symbol} = {pairs}", symbol=symbol, pairs=joined_by_or([p.title for p in pairs]))


def _impossible(readings: dict[Alphabet, dict[str, tuple[Pair, ...]]], space: Space) -> PairError:
    alphabet, reading = next(iter(readings.items()))
    symbol = next(s for s, meanings in reading.items() if not meanings)
    meaning = _meanings(symbol, alphabet)[0]
    others = {
        p.name: p.symbol(alphabet)
        for a in Alphabet
        if a not in readings
        for p in _meanings(symbol, a)
        if space in p.freedoms
    }
    other_alphabet = message("; if {name} is meant, as {symbol!r} means in the other alphabet, write {right!r}")
    hints = [
        other_alphabet.filled(name=pair(name).title, symbol=symbol, right=replacement)
        for name, replacement in others.items()
    ]
    freedom = len(next(iter(meaning.freedoms.values())))
    return PairError(
        "{symbol!r} is the {name} pair (f = {freedom}), which {space} chains do not have: "
        "their joints have at most f = {greatest_freedom} and are {pairs}{hints}",
        symbol=symbol,
        name=meaning.title,
        freedom=freedom,
        space=space.adjective,
        greatest_freedom=space.greatest_freedom,
        pairs=joined(
            p.title if p.symbol(alphabet) == p.name else joined([p.symbol(alphabet), " (", p.title, ")"], "")
            for p in PAIRS
            if space in p.freedoms
        ),
        hints=joined(hints, ""),
    )


def _two_alphabets(german: dict[str, tuple[Pair, ...]], international: dict[str, tuple[Pair, ...]]) -> PairError:
    symbol = next(s for s in german if german[s] != international[s])
    return PairError(
        "{symbol!r} is ambiguous: {german} in the German alphabet, {international} in the international one; write "
        "the full name ({german} or {international}) or add a joint that only one alphabet has",
        symbol=symbol,
        german=joined_by_or([p.title for p in german[symbol]]),
        international=joined_by_or([p.title for p in international[symbol]]),
    )
