"""`python -m tests.torture`: damaged inputs, interrupts and kills, with a table."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

from tests.torture.inputs import GROUPS, case, prepare, try_all, try_one
from tests.torture.interrupts import interrupt_all
from tests.torture.kills import kill_all


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.torture", description=__doc__)
    parser.add_argument("--kills", type=int, default=30, metavar="N", help="kills of enumerations (default: 30)")
    parser.add_argument("--inputs", type=int, default=500, metavar="N", help="damaged inputs (default: 500)")
    parser.add_argument("--interrupts", type=int, default=20, metavar="N", help="interrupts at the start (default: 20)")
    parser.add_argument("--seed", type=int, default=13, metavar="S", help="another seed gives others (default: 13)")
    parser.add_argument("--group", action="append", choices=GROUPS, help="only these groups of inputs; repeatable")
    parser.add_argument("--only", metavar="GROUP/NUMBER", help="one input again, shown")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="torture-") as name:
        folder = Path(name).resolve()
        (folder / "inputs").mkdir()
        if arguments.only:
            return _one(arguments.only, arguments.seed, folder / "inputs")
        faults = _inputs(arguments, folder / "inputs") if arguments.inputs or arguments.group else 0
        if arguments.interrupts:
            (folder / "interrupts").mkdir()
            for what, number in sorted(
                interrupt_all(arguments.interrupts, arguments.seed, folder / "interrupts").items()
            ):
                print(f"interrupts, {what}: {number}")
        if arguments.kills:
            (folder / "kills").mkdir()
            for what, number in sorted(kill_all(arguments.kills, arguments.seed, folder / "kills").items()):
                print(f"{what}: {number}")
    return int(faults > 0)


def _one(word: str, seed: int, folder: Path) -> int:
    group, _, number = word.rpartition("/")
    prepare(folder)
    one = case(group, int(number), seed)
    print(*one.arguments, sep="\n")
    for name, content in one.files.items():
        print(f"--- {name}", content.decode(errors="backslashreplace"), sep="\n")
    outcome, fault = try_one(one, folder)
    print(f"--- status {outcome.status}, {outcome.seconds:.2f} s, {outcome.memory / 1e6:.0f} MB", outcome.err, sep="\n")
    print(fault or "no fault")
    return int(fault is not None)


def _inputs(arguments: argparse.Namespace, folder: Path) -> int:
    groups = arguments.group or GROUPS
    rows = defaultdict(list)
    faults = 0
    for group, number, one, outcome, fault in try_all(arguments.inputs, arguments.seed, folder, groups):
        rows[group].append((outcome, fault))
        if fault is not None:
            faults += 1
            print(f"{group}/{number}: {fault}\n    {' '.join(one.arguments)[:200]!r}", file=sys.stderr, flush=True)
    print("| inputs | number | answered | refused | faults | longest message | most CPU | most memory |")
    print("|---|---|---|---|---|---|---|---|")
    for group in groups:
        found = [outcome for outcome, _ in rows[group]]
        refused = [outcome for outcome in found if outcome.status == 2]
        print(
            f"| {group} | {len(found)} | {sum(one.status in (0, 1) for one in found)} | {len(refused)} "
            f"| {sum(fault is not None for _, fault in rows[group])} "
            f"| {max((len(one.err) for one in refused), default=0)} characters "
            f"| {max(one.seconds for one in found):.1f} s | {max(one.memory for one in found) / 1e6:.0f} MB |"
        )
    return faults


if __name__ == "__main__":
    sys.exit(main())
