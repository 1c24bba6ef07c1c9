"""What share of the mechanisms of four, six and eight links gets dimensions with which it moves."""

import time
from collections.abc import Iterable

from gruebler import Mechanism, Requirements, chains, driven_mechanisms, inversions, variants
from gruebler.design.realisation import Realisation, realise, with_drives
from gruebler.mechanics.kinematics import move

HEADER = ("", "mechanisms", "move", "full turn", "least quality", "worst closure", "tries", "time")


def shares(title: str, mechanisms: Iterable[Mechanism]) -> list[Realisation]:
    start = time.perf_counter()
    all_found = [realise(mechanism) for mechanism in mechanisms]
    took = time.perf_counter() - start
    moving = [found for found in all_found if found.found]
    closure = max((move(found.linkage, found.path()).closure_error for found in moving), default=0.0)
    count = max(1, len(all_found))
    print(
        f"{title:52}{len(all_found):>11}{len(moving) / count:>7.0%}"
        f"{sum(found.full for found in moving) / count:>10.0%}{min((f.quality for f in moving), default=0):>14.2f}"
        f"{closure:>14.0e}{sum(f.tries for f in all_found):>9,}{took:>8.1f} s",
        flush=True,
    )
    return all_found


def driven(all_chains: Iterable, kind: str) -> list[Mechanism]:
    """Those with one drive of a kind at the frame, `T` sliding or `R` turning, that fixes the motion."""
    found = (d.mechanism for chain in all_chains for d in driven_mechanisms(chain, fixed_only=True))
    return [m for m in found if m.drives[0].direction.startswith(kind)]


def main() -> None:
    print(
        f"{HEADER[0]:52}{HEADER[1]:>11}{HEADER[2]:>7}{HEADER[3]:>10}{HEADER[4]:>14}{HEADER[5]:>14}{HEADER[6]:>9}{HEADER[7]:>10}"
    )
    realise(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), budget=10)  # kernels compiled and loaded
    for links in (4, 6, 8):
        inverted = [with_drives(m) for chain in chains(links) for m in inversions(chain)]
        shares(f"inversions of {links} links, one drive each", inverted)
    for links in (4, 6):
        shares(f"{links} links, every drive at the frame", driven(chains(links), "R"))
    for links in (4, 6):
        sliding = list(variants(Requirements(links, prismatic=1)))
        shares(f"{links} links, one slide, turning drive at the frame", driven(sliding, "R"))
        shares(f"{links} links, one slide, driven slide at the frame", driven(sliding, "T"))
    moving = [
        d.mechanism
        for chain in chains(6)
        for d in driven_mechanisms(chain, at_frame=False, fixed_only=True)
        if d.mechanism.frame not in d.mechanism.drives[0].between
    ]
    shares("6 links, drive between moving links", moving)


if __name__ == "__main__":
    main()
