"""A request processed piece by piece: with workers, progress and a directory for finished pieces."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import astuple, dataclass
from pathlib import Path

from gruebler.base.atomic_files import temporary_directory
from gruebler.structure.enumeration.assortment import loop_count
from gruebler.structure.enumeration.checkpoint import PieceFiles, checkpoint_files
from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.pieces import PieceTally
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.work_units import (
    PieceCounter,
    PieceLister,
    PieceListing,
    Work,
    add_tallies,
    work_units,
)
from gruebler.structure.enumeration.worker_pool import Progress, ProgressCounter, run_work

FORMATS = ("text", "graph6", "json")

# Work of a piece, see `pieces.WorkPiece`: milliseconds to count up to 7 loops, a quarter of a second to 9, a second
# beyond; some megabytes to list. Pieces of 0.15 s cost 6 % more processor time by Dask: docs/cluster.md.
_COUNTED = {7: 5_000_000, 9: 400_000_000, 10: 4_000_000_000}  # by the most loops
_LISTED = {"graph6": 1_000_000, "text": 200_000, "json": 100_000}


def run_count(
    request: Request,
    *,
    orbits: bool = False,
    listed: bool = False,
    executor: Executor | Callable[[], Executor] | None = None,
    checkpoint: Path | None = None,
    progress: Callable[[Progress], None] | None = None,
    expected: int | None = None,
) -> ChainCount:
    """Count the requested chains.

    Args:
        request: the request.
        orbits: whether to count inversions, driven mechanisms and joint orbits too.
        listed: whether every chain is built, also where its number alone is found faster.
        executor: see `worker_pool.run_work`.
        checkpoint: a directory for finished pieces; a run with the same request resumes there.
        progress: called after every piece.
        expected: the number of chains, if it is known or estimated, for the progress.

    Raises `RunError` where workers or the directory fail, and `GrueblerError` for more loops than the kernels can
    process.
    """
    watch = ProgressCounter(progress, expected)
    store = _store(checkpoint, request, {"count": True, "orbits": orbits})

    def known(number: int) -> list[PieceTally] | None:
        head = store.head(number) if store is not None else None
        try:
            piece_tallies = [
                PieceTally(
                    kind=kind,
                    assortment=tuple(sizes),
                    chains=chains,
                    inversions=inversions,
                    joint_orbits=joint_orbits,
                    drives=drives,
                )
                for kind, sizes, chains, inversions, joint_orbits, drives in (head or {})["tallies"]
            ]
        except (KeyError, TypeError, ValueError):  # none, or not the head of a counted piece
            return None
        watch.add(sum(tally.chains for tally in piece_tallies), fresh=False)
        return piece_tallies

    def finished(number: int, tallies: list[PieceTally]) -> None:
        if store is not None:
            store.save(number, {"tallies": [astuple(tally) for tally in tallies]})
        watch.add(sum(tally.chains for tally in tallies), fresh=True)

    loops = loop_count(request.links, request.mobility) or 0
    size = next((size for most, size in _COUNTED.items() if loops <= most), 0)  # of more loops there are no pieces
    results = run_work(
        PieceCounter(request, orbits, listed), work_units(request, size=size), executor, known=known, finished=finished
    )
    count = add_tallies(request, orbits, results)
    if store is not None:
        store.tidy()
    return count


def run_list(
    request: Request,
    form: str,
    *,
    executor: Executor | Callable[[], Executor] | None = None,
    checkpoint: Path | None = None,
    progress: Callable[[Progress], None] | None = None,
    expected: int | None = None,
) -> Generator[PieceListing, None, None]:
    """The requested chains, written out in a format piece by piece; arguments as for `run_count`.

    Raises as `run_count`, during the iteration.
    """
    watch = ProgressCounter(progress, expected)
    store = _store(checkpoint, request, {"format": form})
    lister = PieceLister(request, form)
    work = work_units(request, size=_LISTED[form])
    if store is not None:
        yield from _filed(lister, work, executor, store, watch)
        store.tidy()
    elif executor is not None:
        with temporary_directory() as directory:
            yield from _filed(lister, work, executor, PieceFiles(directory, durable=False), watch)
    else:
        for piece in work:
            piece_listings = lister(piece)
            watch.add(sum(listing.chains for listing in piece_listings), fresh=True)
            yield from piece_listings


_Head = list[tuple[str, int, int]]
"""Class, number of chains and number of bytes of each listing of a piece."""


@dataclass(frozen=True, slots=True)
class _ListToFile:
    """Lists a piece in a worker: the text goes into a file, only its head is returned."""

    lister: PieceLister
    files: PieceFiles

    def __call__(self, numbered: tuple[int, Work]) -> _Head:
        number, work = numbered
        piece_listings = self.lister(work)
        head = [(listing.kind, listing.chains, len(listing.text)) for listing in piece_listings]
        self.files.save(number, {"listings": head}, b"".join(listing.text for listing in piece_listings))
        return head


def _filed(
    lister: PieceLister,
    work: Iterable[Work],
    executor: Executor | Callable[[], Executor] | None,
    files: PieceFiles,
    watch: ProgressCounter,
) -> Iterator[PieceListing]:
    def known(number: int) -> _Head | None:
        try:
            head = [(kind, chains, length) for kind, chains, length in (files.head(number) or {})["listings"]]
        except (KeyError, TypeError, ValueError):  # none, or not the head of a listed piece
            return None
        watch.add(sum(chains for _, chains, _ in head), fresh=False)
        return head

    def finished(_: int, head: _Head) -> None:
        watch.add(sum(chains for _, chains, _ in head), fresh=True)

    heads = run_work(_ListToFile(lister, files), enumerate(work), executor, known=known, finished=finished)
    for number, head in enumerate(heads):
        body = files.body(number)
        for kind, chains, length in head:
            yield PieceListing(kind, chains, body[:length])
            body = body[length:]
        if not files.durable:
            files.remove(number)


def _store(checkpoint: Path | None, request: Request, settings: dict[str, object]) -> PieceFiles | None:
    from gruebler import __version__

    return None if checkpoint is None else checkpoint_files(checkpoint, request.to_json() | settings, __version__)
