"""The two bit operations that Python has and numba's integers lack, as single machine instructions."""

from typing import Any

from numba import types
from numba.extending import intrinsic

__all__ = ["lowest", "popcount"]


@intrinsic  # type: ignore[untyped-decorator, unused-ignore]
def popcount(typing_context: Any, word: Any) -> Any:
    """The number of ones in a word of 64 bits, as an int64."""

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.ctpop(arguments[0])

    return (types.int64(word), emit) if word == types.int64 else None


@intrinsic  # type: ignore[untyped-decorator, unused-ignore]
def lowest(typing_context: Any, word: Any) -> Any:
    """The place of the lowest one in a word of 64 bits that is not 0, as an int64."""

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], context.get_constant(types.boolean, 1))

    return (types.int64(word), emit) if word == types.int64 else None
