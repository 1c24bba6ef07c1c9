"""Whether a chain grows from a single loop by dyads."""

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import popcount
from gruebler.structure.atlas.chain_memory import Int64


@njit(cache=True)
def _closed(joints: int, alive: int, members: Int64) -> bool:
    """Whether these links are connected and each carries two joints at least, joints of one link left out."""
    once, twice, start = 0, 0, 0
    for j in range(joints):
        here = members[j] & alive
        if here & (here - 1):
            twice |= once & here
            once |= here
            start = here
    if twice != alive:
        return False
    reached = start
    growing = True
    while growing:
        growing = False
        for j in range(joints):
            here = members[j] & alive
            if here & reached and here & ~reached:
                reached |= here
                growing = True
    return reached == alive


@njit(cache=True)
def grows_by_dyads(n: int, joints: int, loops: int, mobility: int, members: Int64, sets: Int64) -> int:
    """Whether dyads can be taken away, one after another, until a single loop is left; -1 if that is too much.

    All orders are tried; where F = 1 they lead to the same end, so that one order is enough.
    """
    sets[0, 0] = (1 << n) - 1
    count = 1
    for level in range(loops - 1):
        now, then = level & 1, 1 - (level & 1)
        fresh = 0
        for s in range(count):
            alive = sets[now, s]
            for j in range(joints):
                here = members[j] & alive
                if popcount(here) != 2:
                    continue
                both = 0  # joints of the two links besides this one
                ends = 0
                for i in range(joints):
                    other = members[i] & alive
                    if i != j and other & here and other & (other - 1):
                        both += 1
                        ends |= other & here
                        if other & here == here:
                            both = 3
                if both != 2 or ends != here:
                    continue
                left = alive & ~here
                if not _closed(joints, left, members):
                    continue
                seen = False
                for i in range(fresh):
                    if sets[then, i] == left:
                        seen = True
                        break
                if seen:
                    continue
                if fresh == sets.shape[1]:
                    return -1
                sets[then, fresh] = left
                fresh += 1
                if mobility <= 1:
                    break
            if mobility <= 1 and fresh:
                break
        count = fresh
        if count == 0:
            return 0
    return 1
