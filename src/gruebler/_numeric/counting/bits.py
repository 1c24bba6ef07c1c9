"""The two bit operations that numba's integers lack: single machine instructions where they are compiled."""

from typing import Any

from gruebler._numeric.compiling import instead

_WORD = (1 << 64) - 1


def _instruction(emit: Any) -> Any:
    """The form that numba knows of a function from int64 to int64 that `emit` writes."""
    from numba import types
    from numba.extending import intrinsic

    def instruction(_typing: Any, word: Any) -> Any:
        return (types.int64(word), emit) if word == types.int64 else None

    return intrinsic(instruction)


def _popcount() -> Any:
    return _instruction(lambda _context, builder, _signature, arguments: builder.ctpop(arguments[0]))


def _lowest() -> Any:
    from numba import types

    def emit(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], context.get_constant(types.boolean, 1))

    return _instruction(emit)


@instead(_popcount)
def popcount(word: int) -> int:
    """The number of ones in an int64.

    >>> popcount(6), popcount(-1)
    (2, 64)
    """
    return (int(word) & _WORD).bit_count()


@instead(_lowest)
def lowest(word: int) -> int:
    """The place of the lowest one in an int64 that is not 0.

    >>> lowest(12)
    2
    """
    word = int(word)
    return (word & -word).bit_length() - 1
