"""Linkages in space along their drives: microseconds of the processor for a pose, the whole call of `move`."""

import time
from collections.abc import Callable

import numpy as np

from gruebler.mechanics.space import move
from gruebler.teaching.catalog import entry

ROWS = 3601
MACHINES = {  # what each drive goes through, in radians and in the linkage's unit
    "RSSR (`wiper_rssr`)": ("wiper_rssr", [2 * np.pi]),
    "universal joint": ("universal_joint", [2 * np.pi]),
    "Bennett": ("bennett", [2 * np.pi]),
    "Schatz's six links": ("schatz", [2 * np.pi]),
    "double wishbone": ("susp_spatial", [0.25]),
    "five-link suspension": ("susp_5link_lift", [60.0]),
    "Gough's platform, six drives": ("gough", [9.0, -7.0, 5.0, 8.0, -6.0, 4.0]),
    "bevel differential, two drives": ("diff_bevel", [2 * np.pi, 3.0]),
}


def microseconds(call: Callable[[], object], runs: int = 9) -> float:
    """The least of some runs, for one pose."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    return min(times) / ROWS * 1e6


def main() -> None:
    print(f"{'microseconds for one pose':34} {'position':>9} {'order 2':>9} {'order 3':>9}")
    for name, (machine, reach) in MACHINES.items():
        linkage = entry(machine).placed()
        path = np.linspace(0, 1, ROWS)[:, None] * np.resize(reach, len(linkage.mechanism.drives))
        assert move(linkage, path).complete, name
        times = [microseconds(lambda linkage=linkage, path=path, k=k: move(linkage, path, order=k)) for k in (0, 2, 3)]
        print(f"{name:34} " + " ".join(f"{each:9.2f}" for each in times))


if __name__ == "__main__":
    main()
