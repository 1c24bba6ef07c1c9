"""Curves compared up to a similarity: which of many curves, or of their pieces, are most like a target.

Every curve of a book has the same number of places, evenly along it. docs/theory/synthesis-curves.md has the formula.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals, compared_by_value

PLACES = 64
"""Places on each curve of a book."""
_PULL = 0.5  # of the weight of all points of the target: that of all anchors
_WINDOWS = (8, 12, 16, 24, 32, 48)  # pieces of a curve, in such places, for open targets


class Anchors(NamedTuple):
    """Points beside a curve that a similarity brings near given places, as the curve to its target."""

    points: Complexes
    """(curves, anchors)"""
    places: Complexes
    """(anchors,)"""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class CurveMatch:
    """A curve of the book and the similarity that puts it onto the target."""

    gap: float
    """What the similarity leaves, relative to the target's spread."""
    number: int
    """Which curve of the book."""
    at: Reals
    """(points,) where each point of the target lies on the curve, in places, more than a lap away from 0 at times."""
    turn: complex
    shift: complex
    """The point w of the curve goes to turn w + shift."""
    mirrored: bool
    """Whether that is then mirrored in the x axis."""


def resampled(z: Complexes, count: int, *, closed: bool) -> tuple[Complexes, Reals]:
    """Points evenly along the curve through points, and the part of the curve at which each given point lies."""
    whole = np.append(z, z[0]) if closed else z
    arcs = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(whole)))])
    parts = arcs / arcs[-1]
    at = np.arange(count) / count if closed else np.linspace(0, 1, count)
    places = np.interp(at, parts, whole.real) + 1j * np.interp(at, parts, whole.imag)
    return places, parts[: len(z)]


def evenly_along(z: Complexes, phi: Reals) -> Reals:
    """(curves, PLACES) drive angles of places evenly along closed curves, given at angles of a whole turn."""
    return _core.spread_evenly(np.ascontiguousarray(z), phi, PLACES)


def drive_angles(phi: Reals, at: Reals) -> Reals:
    """Drive angles (..., points) between the places of curves (..., PLACES), on and on over their laps."""
    whole = np.unwrap(np.concatenate([phi, phi[..., :1] + 2 * np.pi], axis=-1))
    laps = np.floor(at / PLACES)
    within = at - laps * PLACES
    before = np.minimum(within.astype(np.int64), PLACES - 1)
    low, high = (np.take_along_axis(whole, before + k, axis=-1) for k in range(2))
    return np.asarray((high - low) * (within - before) + low + 2 * np.pi * laps)


def passes(*, closed: bool) -> int:
    """How often `best_matches` goes through all curves."""
    return 4 * (1 if closed else len(_WINDOWS))


def best_matches(
    book: Complexes,
    z: Complexes,
    number: int,
    *,
    closed: bool,
    about_origin: bool = False,
    anchors: Anchors | None = None,
    passed: Callable[[], object] | None = None,
) -> list[CurveMatch]:
    """The curves (or pieces of them, for an open target) most like a target, the best first.

    Args:
        book: (curves, PLACES) closed curves.
        z: (points,) the target.
        number: how many are returned.
        closed: whether the target is closed.
        about_origin: whether the similarity leaves the origin where it is.
        anchors: what else is compared.
        passed: called each time that it has gone through all curves.
    """
    spectrum = np.fft.fft(book, axis=1)
    points, places = anchors or Anchors(np.zeros((len(book), 0), np.complex128), np.zeros(0, np.complex128))
    lengths = (PLACES,) if closed else _WINDOWS
    by_length: dict[tuple[bool, int], list[_Matches]] = {}
    for length in lengths:
        pieces = _pieces(book, points, length if closed else length + 1, about_origin=about_origin)
        for mirrored in (False, True):
            wanted, near = (np.conj(z), np.conj(places)) if mirrored else (z, places)
            target, parts = resampled(wanted, pieces.places, closed=closed)
            by_length[mirrored, length] = []
            for back in (False, True):
                rows, along = target, parts
                if back and closed:
                    rows, along = np.roll(target[::-1], 1), (-parts) % 1.0
                elif back:
                    rows, along = target[::-1], 1 - parts
                each = _matched(spectrum, pieces, Anchors(rows, near), along * length, number, mirrored=mirrored)
                by_length[mirrored, length].append(each)
                if passed is not None:
                    passed()
    matches = [each for mirrored in (False, True) for length in lengths for each in by_length[mirrored, length]]
    gap, numbers, at, turn, shift, mirrors = (
        np.concatenate([getattr(each, name) for each in matches])
        for name in ("gap", "number", "at", "turn", "shift", "mirrored")
    )
    return [
        CurveMatch(
            gap=float(gap[k]),
            number=int(numbers[k]),
            at=at[k],
            turn=complex(turn[k]),
            shift=complex(shift[k]),
            mirrored=bool(mirrors[k]),
        )
        for k in np.argsort(gap, kind="stable")[:number]
    ]


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class _Pieces:
    """All pieces of curves with so many places, each with the anchors of its curve."""

    places: int
    anchors: Complexes
    """(curves, anchors)"""
    weight: float
    """Of an anchor, against a place."""
    whole: float
    """The weight of all."""
    mean: Complexes
    """(curves, PLACES) of the piece that begins at each place; 0 if the origin stays where it is."""
    spread: Reals
    """(curves, PLACES)"""
    about_origin: bool


def _pieces(book: Complexes, anchors: Complexes, count: int, *, about_origin: bool) -> _Pieces:
    weight = _PULL * count / max(1, anchors.shape[1])
    whole = count + weight * anchors.shape[1]
    around = np.concatenate([book, book[:, :count]], axis=1)
    sums = np.cumsum(np.concatenate([np.zeros((len(around), 1)), around], axis=1), axis=1)
    squares = np.cumsum(np.concatenate([np.zeros((len(around), 1)), np.abs(around) ** 2], axis=1), axis=1)
    begins = np.arange(PLACES)
    total = sums[:, begins + count] - sums[:, begins] + weight * anchors.sum(axis=1, keepdims=True)
    mean = total / whole * (not about_origin)
    spread = (squares[:, begins + count] - squares[:, begins]).real - whole * np.abs(mean) ** 2
    spread += weight * np.sum(np.abs(anchors) ** 2, axis=1, keepdims=True)
    return _Pieces(
        places=count,
        anchors=anchors,
        weight=weight,
        whole=whole,
        mean=mean,
        spread=spread,
        about_origin=about_origin,
    )


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class _Matches:
    """The best piece of each of some curves: the fields of `CurveMatch`, a row each."""

    gap: Reals
    number: NDArray[np.int64]
    at: Reals
    turn: Complexes
    shift: Complexes
    mirrored: NDArray[np.bool_]


def _matched(
    spectrum: Complexes, pieces: _Pieces, target: Anchors, along: Reals, number: int, *, mirrored: bool
) -> _Matches:
    """Of curves as they are, for one sense; the target's points, and the places of the anchors."""
    rows, places = target
    weight, count = pieces.weight, pieces.places
    middle = 0j if pieces.about_origin else complex((rows.sum() + weight * places.sum()) / pieces.whole)
    centred, near = rows - middle, places - middle
    energy = float(np.sum(np.abs(centred) ** 2) + weight * np.sum(np.abs(near) ** 2))
    padded = np.zeros(PLACES, np.complex128)
    padded[:count] = centred[:PLACES]
    # inner[begin] = sum over j of conj(curve[begin + j]) * target[j], by the theorem of convolution.
    inner = np.conj(np.fft.ifft(spectrum * np.conj(np.fft.fft(padded)), axis=1))
    inner = inner + weight * (np.conj(pieces.anchors) @ near)[:, None]
    with np.errstate(invalid="ignore", divide="ignore"):
        likeness = np.abs(inner) ** 2 / (np.maximum(pieces.spread, 1e-12) * energy)
    best = np.argmax(likeness, axis=1)
    most = likeness[np.arange(len(best)), best]
    curves = np.argsort(-most)[:number]
    begin = best[curves]
    turn = inner[curves, begin] / pieces.spread[curves, begin]
    return _Matches(
        gap=1 - most[curves],
        number=curves,
        at=begin[:, None] + along,
        turn=turn,
        shift=middle - turn * pieces.mean[curves, begin],
        mirrored=np.full(len(curves), mirrored),
    )
