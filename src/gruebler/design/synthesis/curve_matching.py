"""Curves compared up to a similarity: which of many curves, or of their pieces, are most like a target.

Every curve of a book has the same number of places, evenly along it. docs/theory/synthesis-curves.md has the formula.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

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
    arcs = np.concatenate([np.zeros((len(z), 1)), np.cumsum(np.abs(np.diff(z, axis=1)), axis=1)], axis=1)
    places = np.arange(PLACES) / PLACES
    return np.stack([np.interp(places * row[-1], row, phi) for row in arcs])


def drive_angles(phi: Reals, at: Reals) -> Reals:
    """Drive angles between the places of a curve, on and on over its laps."""
    whole = np.unwrap(np.append(phi, phi[0] + 2 * np.pi))
    laps = np.floor(at / PLACES)
    return np.asarray(np.interp(at - laps * PLACES, np.arange(PLACES + 1), whole) + 2 * np.pi * laps)


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
    matches: list[CurveMatch] = []
    for mirrored in (False, True):
        wanted, near = (np.conj(z), np.conj(places)) if mirrored else (z, places)
        for length in (PLACES,) if closed else _WINDOWS:
            target, parts = resampled(wanted, length if closed else length + 1, closed=closed)
            for back in (False, True):
                rows, along = target, parts
                if back and closed:
                    rows, along = np.roll(target[::-1], 1), (-parts) % 1.0
                elif back:
                    rows, along = target[::-1], 1 - parts
                alike = _matched(
                    book, spectrum, rows, along * length, number, Anchors(points, near), about_origin=about_origin
                )
                matches += (replace(match, mirrored=mirrored) for match in alike)
                if passed is not None:
                    passed()
    matches.sort(key=lambda match: match.gap)
    return matches[:number]


def _matched(
    book: Complexes,
    spectrum: Complexes,
    target: Complexes,
    along: Reals,
    number: int,
    anchors: Anchors,
    *,
    about_origin: bool,
) -> list[CurveMatch]:
    """Those of curves as they are, for one sense."""
    count, (points, places) = len(target), anchors
    weight = _PULL * count / max(1, len(places))
    whole = count + weight * len(places)
    middle = 0j if about_origin else complex((target.sum() + weight * places.sum()) / whole)
    centred, near = target - middle, places - middle
    energy = float(np.sum(np.abs(centred) ** 2) + weight * np.sum(np.abs(near) ** 2))
    padded = np.zeros(PLACES, np.complex128)
    padded[:count] = centred[:PLACES]
    # inner[begin] = sum over j of conj(curve[begin + j]) * target[j], by the theorem of convolution.
    inner = np.conj(np.fft.ifft(spectrum * np.conj(np.fft.fft(padded)), axis=1))
    inner = inner + weight * (np.conj(points) @ near)[:, None]
    around = np.concatenate([book, book[:, :count]], axis=1)
    sums = np.cumsum(np.concatenate([np.zeros((len(around), 1)), around], axis=1), axis=1)
    squares = np.cumsum(np.concatenate([np.zeros((len(around), 1)), np.abs(around) ** 2], axis=1), axis=1)
    begins = np.arange(PLACES)
    total = sums[:, begins + count] - sums[:, begins] + weight * points.sum(axis=1, keepdims=True)
    mean = total / whole * (not about_origin)
    spread = (squares[:, begins + count] - squares[:, begins]).real - whole * np.abs(mean) ** 2
    spread += weight * np.sum(np.abs(points) ** 2, axis=1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        likeness = np.abs(inner) ** 2 / (np.maximum(spread, 1e-12) * energy)
    best = np.argmax(likeness, axis=1)
    rows = np.arange(len(best))
    matches = []
    for n in np.argsort(-likeness[rows, best])[:number]:
        begin = best[n]
        turn = complex(inner[n, begin] / spread[n, begin])
        matches.append(
            CurveMatch(
                gap=1 - float(likeness[n, begin]),
                number=int(n),
                at=begin + along,
                turn=turn,
                shift=middle - turn * complex(mean[n, begin]),
                mirrored=False,
            )
        )
    return matches
