"""Whole families of mechanisms: inversions, decompositions, variants."""

import time
from collections.abc import Callable

from gruebler import Requirements, chains, decompose, driven_mechanisms, inversions, variants


def timed(title: str, call: Callable[[], int]) -> None:
    start = time.perf_counter()
    number = call()
    print(f"{title:58}{number:>8}{time.perf_counter() - start:>9.2f} s")


def main() -> None:
    four = next(chains(4))
    decompose(next(driven_mechanisms(four)).mechanism)  # kernels compiled and loaded
    ten = list(chains(10))
    timed("inversions of the ten-link chains", lambda: sum(len(inversions(chain)) for chain in ten))
    driven = [d.mechanism for chain in ten for d in driven_mechanisms(chain)]
    timed("driven ten-link mechanisms", lambda: sum(1 for chain in ten for _ in driven_mechanisms(chain)))
    timed("... taken apart into Assur groups", lambda: sum(decompose(m).complete for m in driven))
    timed(
        "one-slider variants of the eight-link chains", lambda: sum(1 for _ in variants(Requirements(8, prismatic=1)))
    )


if __name__ == "__main__":
    main()
