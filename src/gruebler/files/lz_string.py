"""The LZ-string compression of texts in addresses: LZ78 with codes of growing width, six bits in a character.

A code is the number of a text seen before, or 0 or 1 for a new character of 8 or 16 bits that follows, or 2 for the
end; bits come with the lowest first. Each code enters one further text: the last one with the first character of this
one. A code has as many bits as the largest number that may come. Source: pieroxy, lz-string 1.5.0 (MIT).
"""

from __future__ import annotations

from gruebler.base.errors import GrueblerError

_DIGITS = {
    letter: value for value, letter in enumerate("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-$")
}
_BITS = 6
_NEW_CHARACTER = (8, 16)  # bits, by code
_END = 2


def decompressed(text: str, longest: int) -> str:
    """The text of `compressToEncodedURIComponent`; at most ``longest`` characters are built.

    Raises `GrueblerError` for text that is cut off, is not compressed, or is longer. The time is linear in its length.

    >>> decompressed("OYUwhgTgzgBAtiKALIA", 100)
    'gears mesh'
    """
    bits = _Bits(text)
    texts: list[str] = ["", "", ""]
    pieces: list[str] = []
    length = 0
    last = ""
    while True:
        code = bits.take(len(texts).bit_length())  # it may be the number of the text that it enters itself
        if code == _END:
            return "".join(pieces)
        if code < _END:
            texts.append(chr(bits.take(_NEW_CHARACTER[code])))
            code = len(texts) - 1
        if code < len(texts):
            phrase = texts[code]
        elif code == len(texts) and last:
            phrase = last + last[0]
        else:
            raise GrueblerError("the compressed text of the address is damaged")
        if last:
            texts.append(last + phrase[0])
        length += len(phrase)
        if length > longest:
            raise GrueblerError("the compressed text of the address has more than {most:,} characters", most=longest)
        pieces.append(phrase)
        last = phrase


class _Bits:
    """Numbers of any number of bits, the lowest bit first, out of characters whose highest bit comes first."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._next = 0
        self._value = 0
        self._left = 0

    def take(self, count: int) -> int:
        number = 0
        for place in range(count):
            if not self._left:
                digit = _DIGITS.get(self._text[self._next : self._next + 1])
                if digit is None:
                    raise GrueblerError("the compressed text of the address is damaged")
                self._value, self._left = digit, _BITS
                self._next += 1
            self._left -= 1
            number |= (self._value >> self._left & 1) << place
        return number
