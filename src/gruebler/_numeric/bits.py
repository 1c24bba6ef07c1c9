"""The two bit operations that Python has and numba's integers lack, as single machine instructions."""

from collections.abc import Callable
from typing import Any, cast

from numba import types
from numba.extending import intrinsic

__all__ = ["lowest", "popcount"]


def _popcount(_typing: Any, word: Any) -> Any:
    def emit(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return builder.ctpop(arguments[0])

    return (types.int64(word), emit) if word == types.int64 else None


def _lowest(_typing: Any, word: Any) -> Any:
    def emit(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], context.get_constant(types.boolean, 1))

    return (types.int64(word), emit) if word == types.int64 else None


popcount = cast(Callable[[int], int], intrinsic(_popcount))
"""The number of ones in an int64; inside kernels only."""

lowest = cast(Callable[[int], int], intrinsic(_lowest))
"""The place of the lowest one in an int64 that is not 0; inside kernels only."""
