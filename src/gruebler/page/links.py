"""A linkage as the part of an address behind #: version, packed document, checksum, each behind a point.

The page writes and reads the same (explorer/src/link.ts).
"""

from __future__ import annotations

import base64
import zlib
from typing import Any

import msgspec

from gruebler.base.errors import GrueblerError

VERSION = "1"
_LONGEST = 200_000  # characters; the document of a linkage of ten links has 2,000
_LARGEST = 2_000_000  # bytes unpacked


class SharedLinkage(msgspec.Struct):
    """What a link carries."""

    document: dict[str, Any]
    name: str = ""
    source: str = ""
    drive: float = 0.0


def read_link(text: str) -> SharedLinkage:
    """What a link carries, given as the whole address or as what stands behind #.

    Raises `GrueblerError` for a link of a newer version, a damaged one, and one that is too long.
    """
    version, _, rest = text.rpartition("#")[2].partition(".")
    data, _, checksum = rest.partition(".")
    if version.isdecimal() and version != VERSION:
        raise GrueblerError(
            "the link has version {found}, newer than {known}: it needs a newer gruebler", found=version, known=VERSION
        )
    if version != VERSION or not data or not checksum or len(text) > _LONGEST:
        raise GrueblerError("the link is not complete: expected #1.DATA.CHECKSUM")
    damaged = GrueblerError("the link is damaged: its checksum does not match")
    try:
        packed = base64.b64decode(data + "=" * (-len(data) % 4), altchars=b"-_", validate=True)
        if f"{zlib.crc32(packed):08x}" != checksum:
            raise damaged
        unpacker = zlib.decompressobj(wbits=-15)
        content = unpacker.decompress(packed, _LARGEST)
        if unpacker.unconsumed_tail:
            raise GrueblerError("the link is too long")
        return msgspec.json.decode(content, type=SharedLinkage)
    except (ValueError, zlib.error, msgspec.DecodeError, RecursionError) as error:
        if isinstance(error, GrueblerError):
            raise
        raise damaged from None
