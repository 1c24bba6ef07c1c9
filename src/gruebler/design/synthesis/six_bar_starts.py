"""Complete start sets for six-bars through eight pairs of angles: computed once, kept in the user's cache.

docs/theory/synthesis-functions.md; why they are no data of the package is told in docs/decisions/README.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np

from gruebler.base.arrays import Complexes, compared_by_value
from gruebler.base.atomic_files import atomic_file
from gruebler.base.private_folder import goes_on_from, private_folder
from gruebler.design.synthesis.alt_burmester import Problem, sharpened
from gruebler.design.synthesis.results import Progress
from gruebler.design.synthesis.six_bar_monodromy import UNUSABLE, Search, on_special_plane, trace

LISTED = {"Watt II": 19_414, "Stephenson III": 53_980, "Stephenson II": 72_430}
"""How many six-bars through eight pairs there are in a plane: progress is counted by it."""
LINEAR = 1e-6
"""A sum that is as linear as that is of all."""
FEW = 500
"""Fewer solutions than these may be closed under their ways without being all."""
_SEED = 3
_MOST_WAYS = 12  # between four tasks; what is not complete after these is given as it is
_SAVED_EVERY = 10.0  # seconds


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class StartSet:
    """A generic task of eight pairs with an arm of given length, and its finite solutions."""

    parameters: Complexes
    """complex[4, 8] as `_core.track` takes it."""
    z: Complexes
    """(solutions, 8)"""
    listed: int
    """How many were listed on a general plane, of which these are those that stay finite."""
    residual: float
    """What the trace test of that list leaves of the change of its sum."""

    alike: bool
    """Whether all tasks of the search have as many: a sum hardly tells of a solution that moves almost along a line."""
    damaged: Path | None = None
    """A file of an interrupted search that was of no use, so that the search began anew."""

    @property
    def complete(self) -> bool:
        """Whether the trace test and the number of each task say so."""
        return self.alike and self.residual < LINEAR


def eight_pairs(family: str) -> Problem:
    """Six-bars of a family through eight pairs, the length of an arm given.

    >>> eight_pairs("Watt II").points
    7
    """
    return Problem(name="eight pairs", poses=0, points=7, classes=LISTED[family], members=1, family=family)


def start_set(family: str, *, threads: int | None = None, progress: Progress | None = None) -> StartSet:
    """The start set of a family, computed at the first call and kept in the user's cache folder.

    Interrupted, it goes on from what was found up to ten seconds before. Cost: at first 150 s of processor time for
    Watt II, 400 s for Stephenson III; then 0.1 s.
    """
    folder, problem = private_folder(), eight_pairs(family)
    name = f"six_bars_{family.replace(' ', '_')}"
    kept = None if folder is None else folder / f"{name}.npz"
    if kept is not None and (stored := _stored(problem, kept)) is not None:
        return stored
    unfinished = None if folder is None else folder / f"{name}_search.npz"
    with goes_on_from(unfinished):
        starts = _listed(problem, unfinished, threads, progress)
    if kept is not None and unfinished is not None:
        save_start_set(starts, kept)
        unfinished.unlink(missing_ok=True)
    return starts


def save_start_set(starts: StartSet, file: Path) -> None:
    """The file appears whole."""
    rows: dict[str, Any] = {name: getattr(starts, name) for name in ("parameters", "z", "listed", "residual", "alike")}
    with atomic_file(file, durable=False) as stream:
        np.savez(stream, **rows)


def _stored(problem: Problem, file: Path) -> StartSet | None:
    """What is kept, if every row of it is a solution; None if there is nothing of use."""
    try:
        with np.load(file) as kept:
            parameters, z = kept["parameters"], kept["z"]
            if not sharpened(problem, z, parameters).all():
                return None
            listed, residual, alike = int(kept["listed"]), float(kept["residual"]), bool(kept["alike"])
            return StartSet(parameters=parameters, z=z, listed=listed, residual=residual, alike=alike)
    except UNUSABLE:
        return None


def _listed(problem: Problem, file: Path | None, threads: int | None, progress: Progress | None) -> StartSet:
    search, damaged = Search(problem, _SEED, threads), None
    if file is not None and file.exists():
        try:
            search.load(file)
        except UNUSABLE:
            damaged = file
            file.unlink()
    saved = monotonic()
    while True:
        while search.step():
            if progress is not None:
                followed = search.followed
                progress(followed, max(followed + 1, problem.classes * len(search.ways)))
            if file is not None and monotonic() - saved > _SAVED_EVERY:
                saved = monotonic()
                search.save(file)
        if len(search.found[0]) < FEW:
            search.begin_again()
            continue
        residual = trace(search).residual
        if (residual < LINEAR and search.alike) or len(search.ways) >= _MOST_WAYS:
            break
        search.add_way(*search.ways[len(search.ways) % 6][:2])
    if file is not None:
        search.save(file)
    parameters, z = on_special_plane(search)
    if progress is not None:
        progress(search.followed, search.followed)
    return StartSet(
        parameters=parameters,
        z=z,
        listed=len(search.found[0]),
        residual=residual,
        alike=search.alike,
        damaged=damaged,
    )
